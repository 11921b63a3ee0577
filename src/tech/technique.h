/*
 * technique.h: interface of a rendering technique: its passes, settings and uploads.
 *
 * A technique is one file of src/tech: citation, images, pass tables, record functions, settings.
 * It owns nothing and has no writable data. A new technique is added to the list `techniques` in
 * the root meson.build and nowhere else; docs/how-to/adding-a-technique.md shows how.
 */
#ifndef FIRN_TECH_TECHNIQUE_H
#define FIRN_TECH_TECHNIQUE_H

#include "graph/rg.h"
#include "src/settings/settings.h"
#include "src/tech/aov_layer.h"

struct frame_view;
struct globals;
struct mesh;
struct refract_shaders;
struct pass_arena;
struct scene;
struct technique;

enum {
    TECHNIQUE_LAYER_MAX = 64 /* maximum number of layers of all techniques */
};

/* The image that a compiled plan renders. */
enum technique_purpose {
    TECHNIQUE_IMAGE,   /* one sample of an image */
    TECHNIQUE_CAPTURE, /* environment cube, captured once */
    TECHNIQUE_RESOLVE, /* tone-mapped mean of many samples */
};

/* State that determines which passes and specialisation constants a plan has. */
struct technique_config {
    const struct settings *settings;
    const struct scene *scene; /* may be zeroed */
    enum technique_purpose purpose;
    /* refraction model; may be NULL in a pool and for purposes other than images */
    const struct technique *refraction;
    bool keeps_depth;      /* objects are redrawn on finished images */
    bool is_limited;       /* draw only the pixels that rays read */
    bool may_exceed_image; /* the object may exceed the image */
    bool has_fast_queries; /* the device's ray queries are not emulated */
    /* images of layers that are requested or that techniques read; the list ends at NULL */
    const struct rg_image *wanted[2 * TECHNIQUE_LAYER_MAX + 1];
    /* Set or changed by refraction_model.choose: */
    uint32_t object_count; /* number of refractive objects with own passes; 0 counts as 1 */
    bool is_wide;          /* maps extend beyond the image (ice_gbuffer.h) */
    bool is_nested;        /* nested objects are rendered together (ice_nested.h) */
    bool denoises_light; /* traced lighting is denoised; initially true if the request allows it */
    bool uses_queries;   /* rays use ray queries; initially true if the device has them */
};

/* Returns true if an image belongs to a requested layer, or to one that a technique reads. */
bool technique_wants(const struct technique_config *config, const struct rg_image *image);

/* Order of the pass groups in a frame. Groups of one phase follow the order of techniques.h. */
enum technique_phase {
    PHASE_LIGHT,       /* shadow and caustic maps */
    PHASE_ENVIRONMENT, /* the environment cube */
    PHASE_SURFACES,    /* layers of the first visible surface */
    PHASE_DEPTHS,      /* depth maps inside the object */
    PHASE_NORMALS,     /* G-buffers of the object's faces */
    PHASE_REFRACTION,  /* the refractive object or the water */
    PHASE_INCLUSIONS,  /* inclusions, each in its own image */
    PHASE_COMPOSITE,   /* composites the inclusions over the image */
    PHASE_BACKGROUND,  /* surroundings and sky behind the object */
    PHASE_LAYERS,      /* layers of models that do not pack them */
    PHASE_FACES,       /* face layers of several objects */
    PHASE_UNPACK,      /* layers that the refraction's passes have packed */
    PHASE_FINISH,      /* drawn last: frost, unclipped cracks */
    PHASE_DISPLAY,     /* tone mapping */
    PHASE_COUNT,
};

/* Kinds of scene in which a pass group is drawn. */
enum technique_scene {
    SCENE_OF_OBJECT, /* scenes without a pool */
    SCENE_OF_POOL,
    SCENE_OF_ANY,
};

/* Returns the passes of a pass group. Returns no passes if the technique is off. If tables depend
 * on `config`, `builder` allocates and owns them (src/tech/pass_arena.h). */
typedef struct rg_technique technique_passes_fn(const struct technique_config *config,
                                                struct pass_arena *builder);

struct technique_pass_group {
    enum technique_phase phase;
    enum technique_scene scene;
    uint32_t purposes;                /* enum technique_purpose bits; 0: images */
    struct rg_technique graph;        /* static passes, without `make_passes` */
    technique_passes_fn *make_passes; /* may be NULL */
    /* Optional. Returns false if an enabled technique has no static passes in this plan. */
    bool (*is_drawn)(const struct technique_config *config);
};

/* A refraction model, which --refraction selects by name. */
struct refraction_model {
    const char *name;                      /* NULL: not a refraction model */
    const struct refract_shaders *shaders; /* NULL for the CPU reference */
    float reach; /* maximum distance of lookups from the centre, bounding radii; 0 means 1 */
    /* True if the model shades a full-screen triangle instead of front faces
     * (shaders/refract/refract_deferred_front_face.glsl), for slow fragment shaders. */
    bool shades_fullscreen;
    bool packs_layers; /* the pass that draws the image also writes the model's layers, packed */
    bool traces_bvh;   /* traces rays through scene->bvh; one pass draws all objects */
    /* Optional, for traces_bvh. Returns false if rays that leave the objects look up the
     * environment cube instead of hitting the surroundings. */
    bool (*hits_surroundings)(const struct technique_config *config);
    /* Returns true if refracted rays can hit air-filled cracks. NULL means that they never can. */
    bool (*refracts_cracks)(const struct settings *settings);
    /* Optional. Sets the members of `config` that depend on the model, once all others are set. */
    void (*choose)(struct technique_config *config);
    /* Makes `pass`, a photon pass of ice_caustics.c, trace through the scene's triangles. Adds
     * the uses `own`; {0} ends this list. Returns false if rays hit no surroundings. */
    bool (*trace_photons)(struct rg_pass *pass, const struct technique_config *config,
                          struct pass_arena *builder, const struct rg_use *own);
};

/* A buffer that the host fills in every frame whose plan contains it. */
struct technique_upload {
    const struct rg_buffer *buffer; /* RG_MEMORY_UPLOAD; NULL ends the list */
    /* Writes the buffer's mapped memory. */
    void (*write)(void *memory, const struct frame_view *view, const struct globals *globals);
};

/* Texels of a scene's image; the scene owns them. */
struct technique_texels {
    const void *texels;     /* NULL imports the fallback */
    uint32_t width, height; /* first mip level; never 0 */
    uint32_t layers;        /* array layers; 0 means 1 */
    /* True if `texels` includes all mip levels, largest first. False generates them. */
    bool all_mips;
    bool no_mips; /* only one mip level */
};

/* Content of a scene's buffer; the scene owns it. */
struct technique_bytes {
    const void *bytes; /* NULL imports zeros */
    size_t size;
};

/* Image or buffer of the scene, imported unless the plan's passes write it. {0} ends a list. */
struct technique_import {
    const struct rg_image *image;
    struct technique_texels (*find)(const struct scene *scene);
    const void *fallback;           /* one texel; NULL: not imported */
    const struct rg_buffer *buffer; /* instead of `image`; formatless: storage buffer */
    struct technique_bytes (*find_bytes)(const struct scene *scene, const struct rg_buffer *buffer);
    bool is_structure; /* acceleration structures of the BVH */
};

enum {
    TECHNIQUE_PASS_GROUP_COUNT = 4,
};

struct technique {
    const char *name;
    const char *help;                     /* one line, no full stop */
    const struct setting_group *settings; /* main group; may be NULL */
    /* Returns true if the technique is on, false if its first setting is 0. NULL if always on. */
    bool (*is_on)(const struct settings *settings);
    bool is_traced;   /* the CPU reference models the feature */
    bool is_ice_only; /* by default, only ice has it */
    bool is_hit;      /* is_hit: ray tracing models intersect the feature; its passes are skipped */
    /* Returns true if the technique makes objects transmit or block light. NULL if it does not. */
    bool (*affects_light)(const struct scene *scene);
    const char *title; /* display name; NULL: `name` */
    struct technique_pass_group pass_groups[TECHNIQUE_PASS_GROUP_COUNT];
    struct refraction_model refraction;
    const struct rg_image *reads_layer; /* layer image that passes read while is_on(), or NULL */
    const struct frame_layer *layers;   /* ends at {0}; may be NULL */
    const struct technique_upload *uploads; /* may be NULL */
    const struct technique_import *imports; /* may be NULL */
    /* Optional. Returns the mesh that frame_draw_mesh() draws. */
    const struct mesh *(*mesh)(const struct scene *scene);
    /* Optional. Replaces the technique's settings that depend on the scene. */
    void (*follow_scene)(struct settings *settings, const struct scene *scene);
    /* Optional. Resolves `auto` settings; `refraction` is NULL if no refraction model is used. */
    void (*resolve_auto)(struct settings *settings, const struct technique *refraction);
    /* Optional. Writes the technique's members of struct globals. */
    void (*write_globals)(const struct frame_view *view, struct globals *globals);
    /* Optional. Writes the technique's specialisation constants to values[CONSTANT_...]. Of
     * `config`, only scene, refraction, and settings from frame_resolve_settings() are set. */
    void (*write_constants)(const struct technique_config *config, uint32_t *values);
};

/* Returns true if the refraction model traces rays to the triangles of the surroundings. */
static inline bool technique_hits_surroundings(const struct technique_config *config)
{
    const struct refraction_model *model =
        config->refraction ? &config->refraction->refraction : NULL;
    return model && model->traces_bvh &&
           (!model->hits_surroundings || model->hits_surroundings(config));
}

#endif
