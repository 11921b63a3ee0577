/*
 * scene.h: a scene: an object, its surroundings, a background.
 *
 * Ownership: a scene owns its members; scene_finish() frees them; a {0} scene is fine.
 */
#ifndef FIRN_SCENE_SCENE_H
#define FIRN_SCENE_SCENE_H

#include "src/scene/bump_maps.h"
#include "src/scene/clouds.h"
#include "src/scene/contact.h"
#include "src/scene/environment.h"
#include "src/scene/generate/generate.h"
#include "src/scene/import/decode.h"
#include "src/scene/import/model.h"
#include "src/scene/melt.h"
#include "src/scene/node_material.h"
#include "src/scene/place.h"
#include "src/scene/tree.h"

enum scene_background {
    SCENE_SKY,
    SCENE_COLOR,
    SCENE_ENVIRONMENT,
};

/* What is read from files in place of what is made; empty: it is made. */
struct scene_files {
    float *heights, *smoothness; /* of bump_maps_params */
    float *air_cover;            /* of generate_air */
    struct mesh crack_sheet;     /* a crack, in the unit ball */
};

struct scene {
    struct model model; /* its objects have ranks */
    enum scene_background background;
    vec3s background_color; /* SCENE_COLOR; linear radiance */
    bool is_hidden;         /* pictures have alpha 0 in place of the background, which still lights
                               surfaces and is seen through and in them */
    struct environment environment;
    vec4s *material_rows;    /* material_rows.h; NULL: all surroundings are unlit, or matt and under
                                the built-in sky */
    vec4s *light_rows;       /* light.h; NULL: no light is on any surface */
    vec4s *extra_rows;       /* material_rows.h, of the surroundings; NULL: they have no extras */
    uint16_t *surface_split; /* surface_light.h; there if material_rows are */
    uint16_t *surface_light; /* surface_light.h; NULL: nothing is lit by `environment` */
    struct environment cube; /* replaces the environment cube that env_cube draws; may be {0} */
    struct bump_maps bump;   /* of the object's surface; {0}: none */
    struct box box;          /* of the object, or of the pool */
    struct box framed; /* what a camera that nobody places shows: `box`, of an animated model that
                        * at time 0 */
    float time;        /* that an animated scene is posed for, seconds */
    vec4s *earlier;    /* positions of the vertices in the frame before, in rows of
                     * FIRST_SURFACE_WIDTH: objects, then surroundings; NULL: as they are */
    uint32_t earlier_rows;
    struct box floe;              /* of the object in the pool; {0}: there is none */
    struct box around;            /* for refract.lookup=box: the box that a model names, or that of
                                   * the surroundings without moving objects; {0}: none */
    struct mesh cracks;           /* in the object's space; may be empty */
    struct mesh air;              /* planes of air in the object's space; may be empty */
    struct air_layers air_layers; /* textures of the planes of air */
    struct scene_files files;
    struct melted melted;     /* what has melted of the ice; {0}: nothing */
    struct clouds clouds;     /* in the space of the mesh of all objects */
    struct contact contact;   /* bodies around the objects, in their space */
    struct bubbles bubbles;   /* in the object's space */
    struct tree *tree;        /* of the model's triangles; empty until scene_need_tree() */
    struct tree_rest *rest;   /* of a scene that is animated, at time 0; NULL: it is not */
    struct mesh_order sorted; /* of the surroundings, if the scene is animated */
    float settled_ior;        /* the value of refract.ior that comes from the model; 0: none */
    bool has_pool;            /* the scene is a pool, with the object, if any, in it */
    bool is_animated;         /* its shapes change in time: the model is animated, or ice melts */
    bool is_convex;           /* the object is known to be convex: mesh_is_convex() */
    float fold;               /* of the object of which it is greatest: mesh_fold() */
};

/* Cracks inside the object. */
struct scene_cracks {
    uint32_t count; /* 0: none */
    uint32_t seed;
    float size;       /* relative to the usual one */
    bool cut;         /* clip them to the object, which must be closed */
    const char *file; /* model of a crack, read by scene_load(); NULL: they are made */
};

/* Pictures in place of what is made of the object's surface, and of the air in it; NULL: none. */
struct scene_pictures {
    const char *heights, *smoothness, *air;
};

enum {
    SCENE_CRACK_TRIANGLES = 65536, /* of a file's crack, at most */
};

struct scene_params {
    const char *name;         /* of a built-in scene or an asset, or a model file */
    const char *surroundings; /* model file; NULL: the landscape, if the sky is there too */
    const char *environment;  /* asset, or image file of the background or of a cube; NULL: none */
    float environment_turn;   /* of a picture of the background: environment.turn */
    float environment_exposure; /* of the file, stops */
    struct scene *before; /* another pose of the same scene, which gives away its environment, the
                             light of it, `files`, and `rest`; NULL: they are read */
    const struct place *place; /* of the model file; NULL: as it is */
    struct model_pose pose;    /* of the model file; its objects are those of: */
    const struct node_material *node_materials;
    uint32_t node_material_count;
    const vec3s *background;      /* colour; NULL: the sky */
    bool is_hidden;               /* scene.is_hidden */
    bool is_one_object;           /* a model file is, if nothing in it is transmissive */
    uint32_t object_triangles;    /* of a built-in object; 0: its default */
    uint32_t landscape_triangles; /* 0: default */
    bool flat;                    /* a level floor instead of the landscape */
    uint32_t mover_count;         /* objects that move around the object */
    struct melting melting;
    struct generate_air air;             /* count 0: none */
    bool has_cloud;                      /* the first object has one, as settings say */
    struct generate_bubbles bubbles;     /* count 0: none */
    const struct bump_maps_params *bump; /* of the object's surface; NULL: none */
    struct scene_cracks cracks;
    struct scene_pictures pictures;
    const struct reader_params
        *decode;               /* how a child process reads the files; NULL: this one does */
    struct generate_pool pool; /* of the scene `pool` */
    bool later; /* leave the texels of bumps and air to scene_fill(); their sizes are known */
    /* Called once the object is loaded: may change what depends on its materials, the inclusions
     * and `bump`. May be NULL. */
    void (*settle)(void *user, const struct scene *scene, struct scene_params *params);
    void *user;
};

/* A built-in scene. */
struct scene_builtin {
    const char *name;
    bool (*generate)(struct mesh *mesh, uint32_t triangles); /* NULL: a pool of water */
    bool (*surround)(struct mesh *mesh, struct box object);  /* NULL: the landscape */
    uint32_t triangles;                                      /* default, of the object */
    const char *help;
};

extern const struct scene_builtin scene_builtins[]; /* ends at a row of zeros */

/* Returns the built-in scene of this name, or NULL. */
const struct scene_builtin *scene_find_builtin(const char *name);

/* Returns whether the name is that of a built-in scene or an asset, so not of a file. */
bool scene_is_known(const char *name);

/* Returns whether the name is that of an environment that comes with the program, and of no scene:
 * `valley` is both, but `sky` is the environment alone. */
bool scene_is_environment(const char *name);

/* Returns the name of one of the built-in scenes, then of the assets, or NULL beyond the last. */
const char *scene_name(uint32_t index);

/* Loads or generates a scene. Logs and returns STATUS_NO_INPUT, STATUS_DATA, STATUS_USAGE (the ice
 * does not fit in the pool) or STATUS_TRY_AGAIN; *scene is then {0}. */
MUST_USE enum status scene_load(struct scene *scene, const struct scene_params *params);

/*
 * Makes what params.later has left out, while other threads may read the rest. Returns NULL, or the
 * name of the part for which memory was short ("air"). Does not log, since another thread may have
 * an error to report: the caller decides which of the two is printed.
 */
MUST_USE const char *scene_fill(struct scene *scene, const struct scene_params *params);

/* Makes the inclusions and the surface of the object: a part of scene_load(). */
MUST_USE enum status scene_fill_object(struct scene *scene, const struct scene_params *params);

/* Replaces the cracks of a scene; scene_load() makes them, too. Logs and returns STATUS_TRY_AGAIN
 * when out of memory. */
MUST_USE enum status scene_make_cracks(struct scene *scene, const struct scene_cracks *cracks);

/* Builds the scene's tree, unless that has been done; the scene must have been loaded. Shapes of
 * large trees that do not change in time may come from files of earlier runs (`is_cached`). Only
 * one thread may call it at the same time. Logs and returns STATUS_DATA or STATUS_TRY_AGAIN. */
MUST_USE enum status scene_need_tree(const struct scene *scene, bool is_cached);

void scene_finish(struct scene *scene);

/* Returns whether light falls on an object's surface itself, which is not wholly transmissive. */
bool scene_has_lit_object(const struct scene *scene);

/* Returns whether objects tint the light that passes them, are not wholly transmissive, or have
 * textures that change how light passes; then there are material rows. */
bool scene_has_dress(const struct scene *scene);

/* Returns the distance of the near plane for pictures of a scene, metres; there is no far plane. */
float scene_near_plane(const struct scene *scene);

#endif
