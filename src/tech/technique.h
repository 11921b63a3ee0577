/*
 * technique.h: interface of a rendering technique: its passes, settings and uploads.
 *
 * A technique is one file of src/tech: citation, images, pass tables, record functions, settings.
 * It owns nothing and has no writable data. A new technique is added to the list in the root
 * meson.build (see techniques.h) and nowhere else.
 */
#ifndef FIRN_TECH_TECHNIQUE_H
#define FIRN_TECH_TECHNIQUE_H

#include "graph/rg.h"
#include "src/settings/settings.h"
#include "src/tech/layer.h"

struct frame_view;
struct globals;
struct mesh;
struct refract_shaders;
struct pass_builder;
struct scene;
struct technique;

/* What a compiled plan renders. */
enum technique_purpose {
    TECHNIQUE_IMAGE,   /* one sample of an image */
    TECHNIQUE_CAPTURE, /* the environment cube, captured once before all images */
    TECHNIQUE_BAKE,    /* the environment cube, for writing to a file */
    TECHNIQUE_RESOLVE, /* the display image of the mean of many samples */
};

/* State that determines which passes a plan has. */
struct technique_choice {
    const struct settings *settings;
    enum technique_purpose purpose;
    /* refraction model; may be NULL in a pool and for purposes other than images */
    const struct technique *refraction;
    bool is_convex;     /* the object is known to be convex */
    bool has_pool;      /* the scene is a pool of water */
    bool has_materials; /* surroundings have materials (scene.material_table) */
    bool has_extras;    /* surroundings have scene.vertex_extra_table */
    bool has_mirrors;   /* surroundings have reflective surfaces */
    bool has_cube;      /* the scene has its own environment cube */
    bool keeps_depth;   /* the objects are redrawn over a finished image, whose depth is kept */
    bool is_limited; /* passes are limited to the area in which rays look up one of the objects */
    bool disperses;  /* some medium is dispersive: one path per colour channel */
    bool is_beyond;  /* the object may extend beyond the image */
    uint32_t object_count; /* number of refractive objects, each with its own passes; 0 means 1 */
    bool has_rays;         /* the device has ray queries */
    bool has_fast_rays;    /* ray queries are in hardware, not emulated on a CPU */
    /* Set by refraction_model.choose: */
    bool is_textured;   /* objects have textured or tinted surfaces */
    bool renders_media; /* a raster refraction model renders scattering media */
    bool is_wide;       /* maps extend beyond the image (ice_normal.h) */
    bool is_nested;     /* objects are rendered together with those nested in them (ice_nested.h) */
    bool hits_surroundings; /* rays hit the triangles of the surroundings */
    bool has_diffuse_light; /* ray-traced lighting of surroundings, all over the image */
    bool
        /* traced lighting is denoised if the request allows it (renderer_requests.c) */
        is_lighting_denoised;
    bool queries; /* rays use hardware acceleration structures */
};

/* Order of the parts of a frame. Parts of the same phase are drawn in the order of techniques.h. */
enum technique_phase {
    PHASE_LIGHT,       /* shadow and caustic maps */
    PHASE_ENVIRONMENT, /* the environment cube */
    PHASE_SURFACES,    /* layers of the first visible surface */
    PHASE_DEPTHS,      /* depth maps inside the object */
    PHASE_NORMALS,     /* G-buffers of the object's faces */
    PHASE_REFRACTION,  /* the refractive object or the water */
    PHASE_INCLUSIONS,  /* inclusions of the object, each in its own image */
    PHASE_COMPOSITE,   /* composites the inclusions over the image */
    PHASE_BACKGROUND,  /* surroundings and sky, where the object does not hide them */
    PHASE_LAYERS,      /* the refraction model's layers */
    PHASE_FACES,       /* layers of several objects' faces, once their maps are free */
    PHASE_FINISH,      /* drawn over the finished image: frost, free cracks */
    PHASE_DISPLAY,     /* tone mapping */
    PHASE_COUNT,
};

/* Kinds of scene in which a part is drawn. */
enum technique_scene {
    SCENE_OF_OBJECT, /* scenes without a pool */
    SCENE_OF_POOL,
    SCENE_OF_ANY,
};

/* Returns a part's passes, or none if the part is off. Tables that depend on the choice are
 * allocated from the builder (src/tech/pass_builder.h), which owns them. */
typedef struct rg_technique technique_passes_fn(const struct technique_choice *choice,
                                                struct pass_builder *builder);

struct technique_part {
    enum technique_phase phase;
    enum technique_scene scene;
    uint32_t purposes;         /* bit mask of enum technique_purpose; 0 means pictures only */
    struct rg_technique graph; /* the passes if the technique is on; ignored if `rows` is set */
    technique_passes_fn *rows; /* may be NULL */
};

/* A refraction model, as --refraction names it. */
struct refraction_model {
    const char *name; /* NULL if the technique is not a refraction model */
    const struct refract_shaders
        *rows;   /* src/tech/refract/refract.h; NULL if the CPU reference renders it */
    float reach; /* radius of face lookups in bounding radii; 0 means 1 */
    /* Shades a full-screen triangle where ice_normal.front shows the object, instead of drawing
     * front faces (shaders/refract/refract_fullscreen.glsl): for models with expensive fragment
     * shaders. */
    bool by_pixel;
    bool follows_paper; /* automatic settings resolve to the paper's values, not to exact ones */
    bool is_whole;      /* its passes draw all refractive objects at once */
    bool traces_bvh;    /* it traces rays through the BVH (scene.tree) */
    /* Return true if refracted rays intersect cracks (air gaps) and bubbles; NULL: never. */
    bool (*refracts_cracks)(const struct settings *settings);
    bool (*refracts_bubbles)(const struct settings *settings);
    /* Sets the members of an otherwise complete choice that depend on the model; may be NULL. */
    void (*choose)(struct technique_choice *choice, const struct scene *scene);
    /* Turns a pass of ice_caustics.c into one that traces photons through the scene's triangles,
     * for choices that hit surroundings. `own` lists the pass's further uses and ends at {0};
     * targets and record function are kept. NULL: photons are rasterised. */
    void (*trace_photons)(struct rg_pass *row, const struct technique_choice *choice,
                          struct pass_builder *builder, const struct rg_use *own);
};

/* A buffer that the host fills in every frame whose plan contains it. */
struct technique_upload {
    const struct rg_buffer *buffer; /* RG_MEMORY_UPLOAD; NULL ends the list */
    /* Writes the mapped memory of the buffer. */
    void (*write)(void *memory, const struct frame_view *view, const struct globals *globals);
};

/* Texels of an image of the scene; borrowed. */
struct technique_texels {
    const void *texels;     /* NULL if the scene has none; then the fallback is imported */
    uint32_t width, height; /* size of the first mip level; never 0 */
    uint32_t layers;        /* array layers; 0 means 1 */
    bool all_mips; /* `texels` has all mip levels, largest first; otherwise they are generated */
    bool no_mips;  /* the image has only the first mip level */
};

/* Content of a buffer of the scene; borrowed. */
struct technique_bytes {
    const void *bytes; /* NULL if the scene has none: zeros of the declared size */
    size_t size;
};

/* An image or texel buffer of the scene, imported unless the plan draws it. One with neither ends
 * the list. */
struct technique_import {
    const struct rg_image *image;
    struct technique_texels (*find)(const struct scene *scene);
    const void *fallback; /* one texel, for scenes without texels; NULL: nothing is imported */
    const struct rg_buffer *buffer; /* instead of `image`; a storage buffer if it has no format */
    struct technique_bytes (*find_bytes)(const struct scene *scene, const struct rg_buffer *buffer);
    bool is_structure; /* the buffer holds the acceleration structures of the scene's BVH */
};

/* Inputs of a scene's plans and specialisation constants. */
struct technique_inputs {
    const struct scene *scene;
    const struct settings *settings;    /* as settled by frame_resolve_settings() */
    const struct technique *refraction; /* refraction model; NULL: one that traces no rays */
};

enum {
    TECHNIQUE_PART_COUNT = 4,
    TECHNIQUE_GROUP_COUNT = 2,
};

struct technique {
    const char *name;
    const char *help; /* one line, no full stop */
    const struct setting_group *settings[TECHNIQUE_GROUP_COUNT];
    /* Returns true if the feature is on; its first setting 0 switches it off. NULL: always on. */
    bool (*is_on)(const struct settings *settings);
    bool is_traced;   /* the CPU reference models the feature */
    bool is_ice_only; /* only ice has the feature by default */
    bool is_hit; /* ray-traced models intersect the feature themselves; it has no passes then */
    /* Returns true if the feature makes objects of a scene transmit or block light
     * (src/frame/env_cube_updates.h); NULL: never. */
    bool (*relights)(const struct scene *scene);
    const char *title; /* display name of the feature; NULL: `name` */
    struct technique_part parts[TECHNIQUE_PART_COUNT];
    struct refraction_model refraction;
    const struct frame_layer *layers;       /* ends at an entry of zeros; may be NULL */
    const struct technique_upload *uploads; /* may be NULL */
    const struct technique_import *imports; /* may be NULL */
    /* Returns the mesh that frame_draw_mesh() draws; may be NULL. */
    const struct mesh *(*mesh)(const struct scene *scene);
    /* Overwrites settings of the technique that the scene determines; may be NULL. */
    void (*follow_scene)(struct settings *settings, const struct scene *scene);
    /* Replaces `auto` values by those of a refraction model or NULL; the hook may be NULL. */
    void (*settle)(struct settings *settings, const struct technique *refraction);
    /* Writes the technique's members of struct globals; may be NULL. */
    void (*write_globals)(const struct frame_view *view, struct globals *globals);
    /* Writes the technique's specialisation constants, by identifier
     * (shaders/specialization_constants.h); or NULL. */
    void (*write_constants)(const struct technique_inputs *subject, uint32_t *values);
};

#endif
