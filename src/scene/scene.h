/*
 * scene.h: what there is to draw: an object, its surroundings, a background.
 *
 * Ownership: scene_finish() frees what a scene holds; a {0} scene is fine.
 */
#ifndef FIRN_SCENE_SCENE_H
#define FIRN_SCENE_SCENE_H

#include "src/scene/bump_maps.h"
#include "src/scene/environment.h"
#include "src/scene/generate/generate.h"
#include "src/scene/import/decode.h"
#include "src/scene/import/model.h"

enum scene_background {
    SCENE_SKY,
    SCENE_COLOR,
    SCENE_ENVIRONMENT,
};

struct scene {
    struct model model;
    enum scene_background background;
    vec3s background_color; /* SCENE_COLOR; linear radiance */
    struct environment environment;
    struct environment cube;      /* in place of what env_cube draws if that is not dynamic */
    struct bump_maps bump;        /* of the object's surface; {0}: none */
    struct box box;               /* of the object, or of the pool */
    struct box floe;              /* of the object in the pool; {0}: there is none */
    struct box around;            /* that a model names, or of the surroundings but for what moves;
                                   * {0}: there are none */
    struct mesh cracks;           /* in the object's space; may be empty */
    struct mesh air;              /* in the object's space, as are the bubbles; may be empty */
    struct air_layers air_layers; /* on it */
    struct bubbles bubbles;
    bool has_pool;  /* with the object in it, if there is one */
    bool is_convex; /* the object, surely: mesh_is_convex() */
};

/* Cracks inside the object. */
struct scene_cracks {
    uint32_t count; /* 0: none */
    uint32_t seed;
    bool cut; /* nothing of them reaches out of the object, which must be closed */
};

struct scene_params {
    const char *name;                /* of a built-in scene, or a model file */
    const char *surroundings;        /* model file; NULL: the landscape, if the sky is there too */
    const char *environment;         /* picture file: background, or cube; NULL: none */
    const vec3s *background;         /* NULL: the sky */
    uint32_t object_triangles;       /* of a built-in object; 0: its default */
    uint32_t landscape_triangles;    /* 0: default */
    bool flat;                       /* a level floor in the landscape's place */
    uint32_t mover_count;            /* objects that move around it */
    struct generate_air air;         /* count 0: none */
    struct generate_bubbles bubbles; /* the same */
    const struct bump_maps_params *bump; /* of the object's surface; NULL: none */
    struct scene_cracks cracks;
    const struct decode_params *decode; /* who reads the files; NULL: this process */
    struct generate_pool pool;          /* of the scene that is one */
    bool later; /* leaves the bump maps and the pictures of air to scene_fill() */
};

/* A scene known by name. */
struct scene_builtin {
    const char *name;
    bool (*generate)(struct mesh *mesh, uint32_t triangles); /* NULL: a pool of water is there */
    bool (*surround)(struct mesh *mesh, struct box object);  /* NULL: the landscape does it */
    uint32_t triangles;                                      /* of the object, by default */
    const char *help;
};

extern const struct scene_builtin scene_builtins[]; /* ends at a row of zeros */

/* Logs and returns STATUS_NO_INPUT, STATUS_DATA, STATUS_USAGE (ice that finds no room in the pool)
 * or STATUS_TRY_AGAIN; *scene is then {0}. */
MUST_USE enum status scene_load(struct scene *scene, const struct scene_params *params);

/*
 * Makes what `later` has left out, while other threads may read the rest. Returns NULL, or what
 * there was no memory for ("air"). Does not log, since another thread may have an error to report:
 * the caller decides which of the two is printed.
 */
MUST_USE const char *scene_fill(struct scene *scene, const struct scene_params *params);

/* Replaces the cracks of a scene; done by scene_load() too. Logs and returns STATUS_TRY_AGAIN when
 * memory is short. */
MUST_USE enum status scene_make_cracks(struct scene *scene, const struct scene_cracks *cracks);

void scene_finish(struct scene *scene);

/* Metres from the eye to the near plane of pictures of a scene; there is no far plane. */
float scene_near_plane(const struct scene *scene);

#endif
