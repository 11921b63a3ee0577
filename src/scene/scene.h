/* scene.h: scene of refractive objects, their surroundings and a background. scene_finish() frees
 * all members. A zeroed scene is valid. */
#ifndef FIRN_SCENE_SCENE_H
#define FIRN_SCENE_SCENE_H

#include "src/scene/ao_occluders.h"
#include "src/scene/bvh/bvh.h"
#include "src/scene/coincident_shells.h"
#include "src/scene/environment/environment.h"
#include "src/scene/generate/generate.h"
#include "src/scene/geometry/framing.h"
#include "src/scene/geometry/object_transform.h"
#include "src/scene/ice_bump_map.h"
#include "src/scene/import/model.h"
#include "src/scene/import/sandboxed_load.h"
#include "src/scene/material_override.h"
#include "src/scene/medium_density.h"
#include "src/scene/melt/melt.h"
#include "src/scene/model_transform.h"
#include "src/scene/stage/stage.h"

enum scene_background_kind {
    SCENE_SKY,
    SCENE_COLOR,
    SCENE_ENVIRONMENT,
};

struct scene_background {
    enum scene_background_kind kind;
    bool is_hidden;   /* true: alpha 0, also as seen through glass; lighting is unaffected */
    bool is_backdrop; /* true if primary rays that hit nothing return `color` */
    vec3s color;      /* linear radiance, for SCENE_COLOR or the backdrop */
    struct environment environment;
    struct environment cube; /* environment cube from a file; may be empty */
    uint16_t *prefiltered;   /* prefiltered `environment`; NULL if not needed */
};

/* GPU tables of surface materials; NULL if no material needs them. */
struct scene_tables {
    vec4s *materials;
    vec4s *punctual_lights; /* NULL if no surface is lit by one */
    vec4s *vertex_extras;   /* gpu_material_table.h; NULL for none */
    uint16_t *brdf;         /* GGX split-sum table (image_based_lighting.h) */
};

/* Inclusions in the object's space; each may be empty. */
struct scene_inclusions {
    struct mesh cracks;
    struct mesh air;              /* planes of air bubbles */
    struct air_layers air_layers; /* textures of the air planes */
    struct bubbles bubbles;
    struct scattering_media media; /* scattering media, in the space of the objects' mesh */
};

/* Data read from files; members are NULL or empty for data that is generated. */
struct scene_files {
    float *heights, *smoothness; /* bump map input, for bump_maps_params */
    float *air_opacity;          /* bubble opacity, for generate_air */
    struct mesh crack_sheet;     /* mesh of a crack, scaled to the unit ball */
};

struct scene {
    struct model model;                /* loaded model, with ranked objects (medium priorities) */
    double file_origin[3];             /* model.origin before the model transform */
    struct coincident_shells contacts; /* contacts between the objects' surfaces */
    struct scene_background background;
    struct scene_tables tables;
    struct scene_inclusions inclusions;
    struct bump_maps bump;  /* bump map of the object's surface; may be empty */
    struct box box;         /* bounding box of the object or pool */
    struct box framing_box; /* bounding box at time 0, for the default camera */
    struct box stage_box;   /* bounding box at time 0 of what stands on the stage */
    /* what the default camera of a model file frames, at time 0; empty for built-in scenes */
    struct framing framing;
    float time; /* animation time, seconds */
    /* vertex positions of the previous frame, objects first; NULL if no vertex has moved */
    vec4s *previous_positions;
    struct box floating_ice; /* bounding box of floating ice in the pool; may be empty */
    struct scene_files files;
    struct melted melted; /* result of melting; zeroed if nothing has melted */
    struct ao ao;         /* ambient occlusion occluders, in object space */
    struct bvh *bvh;      /* BVH of all triangles; empty before scene_build_bvh() */
    /* rest pose (time 0) of an animated scene; NULL for a static scene */
    struct bvh_rest_pose *rest;
    struct mesh_order sorted; /* triangle order of the surroundings; only in animated scenes */
    float model_ior;          /* refractive index given by the model; 0 if it has none */
    bool has_pool;            /* the scene is a pool, which may contain an object */
    bool is_animated;         /* geometry changes with time: the model is animated, or ice melts */
    bool is_convex;           /* object is convex (mesh_is_convex()) */
    float depth_complexity; /* maximum mesh_depth_complexity() of the objects; 0 for many objects */
};

/* Cracks inside the object. */
struct scene_cracks {
    uint32_t count; /* number of cracks; 0 for none */
    uint32_t seed;
    float size;       /* size relative to the default size */
    const char *file; /* model file of a crack, read by scene_load(); NULL for generated cracks */
};

/* Image files to use instead of generated bump maps and air textures; NULL for none. */
struct scene_image_files {
    const char *heights, *smoothness, *air;
};

enum {
    SCENE_CRACK_TRIANGLES = 65536, /* maximum triangle count of a crack's model file */
};

/* Data that replaces files; callbacks may be NULL. Each logs its errors. */
struct scene_source {
    /* makes the model instead of reading the file scene_params.name */
    enum status (*make_model)(void *user, struct model *model, enum model_role default_role);
    /* changes the loaded model's materials */
    enum status (*change_materials)(void *user, struct model *model);
    /* makes the environment instead of reading the file scene_params.environment */
    enum status (*make_environment)(void *user, struct environment *environment);
    void *user;
};

struct loaded_files;

struct scene_params {
    const char *name;           /* name of a built-in scene or asset, or path of a model file */
    const char *surroundings;   /* model file of surroundings, or NULL for the scene's default */
    const char *environment;    /* background image or environment cube, by name or path; or NULL */
    float environment_turn;     /* rotation of a background image, turns */
    float environment_exposure; /* exposure of the image file, stops */
    /* previous pose of the scene, or NULL. The new scene takes over its environment, lighting,
     * `files` and `rest`, and does not load them again. */
    struct scene *previous_pose;
    const struct model_transform *model_transform; /* NULL for the identity */
    struct model_pose pose; /* animation pose; scene_load() sets `objects`, `origin` */
    const struct material_override *material_overrides;
    uint32_t material_override_count;
    const struct object_transform *object_transforms; /* applied after model_transform */
    uint32_t object_transform_count;
    const vec3s *background;      /* background colour; NULL for the sky */
    bool is_backdrop;             /* see scene_background.is_backdrop */
    bool is_hidden;               /* see scene_background.is_hidden */
    struct stage_params stage;    /* floor to add below the model */
    bool is_one_object;           /* true to treat an opaque model as one refractive object */
    uint32_t object_triangles;    /* triangle count of a built-in object; 0 for its default */
    uint32_t landscape_triangles; /* triangle count of the landscape; 0 for the default */
    bool flat;                    /* true for a level floor instead of the landscape */
    uint32_t orbiting_ball_count; /* number of balls that orbit the object */
    struct melting melting;
    struct generate_air air;         /* air planes; count 0 for none */
    bool has_scattering_medium;      /* true if the settings make the first object scatter light */
    bool scatters_evenly;            /* true if that medium has the same density everywhere */
    struct generate_bubbles bubbles; /* bubbles; count 0 for none */
    const struct bump_maps_params *bump; /* parameters of the surface's bump map; NULL for none */
    struct scene_cracks cracks;
    struct scene_image_files image_files;
    const struct reader_params *decode; /* sandboxed file reader; NULL to read in this process */
    const struct scene_source *source;  /* data instead of files; NULL for none */
    struct loaded_files *files;         /* where to keep what files hold; NULL for nowhere */
    struct generate_pool pool;          /* pool of the scene `pool` */
    /* true to set only the sizes of bump maps and air textures; scene_fill() makes their texels */
    bool defers_texels;
    /* Callback after the object is loaded; may be NULL. It may adapt the inclusion parameters and
     * `bump` to the object's materials. */
    void (*on_object_loaded)(void *user, const struct scene *scene, struct scene_params *params);
    void *user;
};

/* Built-in scene. */
struct scene_builtin {
    const char *name;
    bool (*generate)(struct mesh *mesh, uint32_t triangles); /* NULL for a pool of water */
    /* generates surroundings; NULL for the landscape */
    bool (*surround)(struct mesh *mesh, struct box object);
    uint32_t triangles; /* default triangle count of the object */
    const char *help;
};

extern const struct scene_builtin scene_builtins[]; /* terminated by a zero entry */

/* Returns the built-in scene of this name, or NULL. */
const struct scene_builtin *scene_find_builtin(const char *name);

/* Returns true if a built-in scene or an asset has this name. */
bool scene_is_known(const char *name);

/* Returns true if an environment, but no scene, has this name. `valley` names a scene, too. */
bool scene_is_environment(const char *name);

/* Returns the name of scene `index` (built-in scenes before assets), or NULL beyond the last. */
const char *scene_name(uint32_t index);

/* Loads or generates a scene. On failure, zeroes *scene, logs an error and returns STATUS_NO_INPUT,
 * STATUS_DATA, STATUS_USAGE (the ice does not fit in the pool) or STATUS_TRY_AGAIN. */
MUST_USE enum status scene_load(struct scene *scene, const struct scene_params *given);

/* Generates the texels that scene_load() skipped because of params.defers_texels. Meanwhile, other
 * threads may read the rest of the scene. Returns NULL on success. If out of memory, logs nothing
 * and returns the name of the missing data, such as "air". */
MUST_USE const char *scene_fill(struct scene *scene, const struct scene_params *params);

/* Generates the object's inclusions and bump map; called by scene_load(). */
MUST_USE enum status scene_fill_object(struct scene *scene, const struct scene_params *params);

/* Replaces the cracks of a scene. Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status scene_generate_cracks(struct scene *scene, const struct scene_cracks *cracks);

/* Builds the BVH of a loaded scene, unless it exists. If `is_cached`, caches large static BVHs in
 * files. Not thread-safe. Logs errors and returns STATUS_DATA or STATUS_TRY_AGAIN. */
MUST_USE enum status scene_build_bvh(const struct scene *scene, bool is_cached);

/* Rebuilds the GPU tables of materials after changes of their numbers. Priorities, flags,
 * scattering, and whether a material is transmissive or thin must be unchanged. Logs errors and
 * returns STATUS_TRY_AGAIN; the scene may then only be finished. */
MUST_USE enum status scene_update_materials(struct scene *scene, const struct scene_params *params);

void scene_finish(struct scene *scene);

/* Returns true if an object is not fully transmissive. Its surface is then lit. */
bool scene_has_lit_object(const struct scene *scene);

/* Returns true if an object tints transmitted light, is not fully transmissive, or has textures
 * that affect transmission. Such a scene has a material table (tables.materials). */
bool scene_has_textured_objects(const struct scene *scene);

/* Returns the distance of the near plane, metres. There is no far plane. */
float scene_near_plane(const struct scene *scene);

#endif
