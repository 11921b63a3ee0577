/*
 * technique.h: a technique: its rows, its settings, its uploads.
 *
 * One technique is one file of src/tech: citation, images, pass tables, record functions, settings.
 * It owns nothing and has no writable data. A new technique is added to the list in
 * src/tech/meson.build (techniques.h) and nowhere else.
 */
#ifndef FIRN_TECH_TECHNIQUE_H
#define FIRN_TECH_TECHNIQUE_H

#include "graph/rg.h"
#include "src/settings/settings.h"
#include "src/tech/layer.h"

struct frame_view;
struct globals;
struct mesh;
struct refract_rung;
struct row_builder;
struct scene;
struct technique;

/* What a plan is for. */
enum technique_purpose {
    TECHNIQUE_PICTURE, /* one sample of a picture */
    TECHNIQUE_CAPTURE, /* the environment cube, drawn once before all pictures */
    TECHNIQUE_BAKE,    /* the environment cube, to be written to a file */
    TECHNIQUE_RESOLVE, /* the display picture of the mean of many samples */
};

/* The data that decide which rows a plan has. */
struct technique_choice {
    const struct settings *settings;
    enum technique_purpose purpose;
    const struct technique
        *rung;             /* NULL is allowed in a pool and for other purposes than pictures */
    bool is_convex;        /* the object is known to be convex */
    bool has_pool;         /* the scene is a pool of water */
    bool has_materials;    /* surroundings have materials (scene.material_rows) */
    bool has_extras;       /* surroundings have scene.extra_rows */
    bool has_mirrors;      /* and surfaces that mirror */
    bool has_cube;         /* the scene has an environment cube of its own */
    bool keeps_depth;      /* the objects are drawn again, over the finished picture */
    bool is_limited;       /* rows draw where rays look up one of the objects, and no farther */
    bool disperses;        /* a medium does: each colour has a path of its own */
    bool is_beyond;        /* the object may reach beyond the edges of the picture */
    uint32_t object_count; /* refractive objects, each drawn by rows of its own; 0 means 1 */
    bool has_rays;         /* the device has ray queries */
    bool has_fast_rays;    /* in hardware, not by the processor that would do the same without */
    /* Of the rung (technique_rung.choose): */
    bool is_dressed;          /* it draws tints and textures of objects */
    bool is_cloudy;           /* it draws clouds in objects, though it meets no tree */
    bool is_wide;             /* its maps reach beyond the picture (ice_normal.h) */
    bool is_nested;           /* objects are drawn with those within them, as one (ice_nested.h) */
    bool meets_surroundings;  /* its rays meet the surroundings' triangles */
    bool lights_surroundings; /* and light them: then they are shaded, too, all over the picture */
    bool smooths;             /* that light is smoothed, if the picture can be: request.c */
    bool queries;             /* its rays go through acceleration structures */
};

/* When in a frame a part of a technique is drawn. Within a phase the parts are drawn in the order
 * of techniques.h. */
enum technique_phase {
    PHASE_LIGHT,       /* light maps */
    PHASE_ENVIRONMENT, /* the environment cube */
    PHASE_SURFACES,    /* first surfaces */
    PHASE_DEPTHS,      /* depths inside the object */
    PHASE_NORMALS,     /* normals of the object's faces */
    PHASE_REFRACTION,  /* the refractive object or the water */
    PHASE_INCLUSIONS,  /* inclusions of the object, each into its own image */
    PHASE_COMPOSITE,   /* blends the inclusions over the picture */
    PHASE_BACKGROUND,  /* surroundings and sky, where the object does not hide them */
    PHASE_LAYERS,      /* the rung's layers */
    PHASE_FACES,       /* layers of faces of several objects, whose maps no rung needs any more */
    PHASE_FINISH,      /* drawn over the finished picture: frost, free cracks */
    PHASE_DISPLAY,     /* tone mapping */
    PHASE_COUNT,
};

/* For which scenes a part is drawn. */
enum technique_scene {
    SCENE_OF_OBJECT, /* scenes without a pool */
    SCENE_OF_POOL,
    SCENE_OF_ANY,
};

/* Returns a part's rows, or no passes if the part is off. Tables that depend on the choice are made
 * with the builder (src/tech/row_builder.h), which owns them. */
typedef struct rg_technique technique_rows_fn(const struct technique_choice *choice,
                                              struct row_builder *builder);

struct technique_part {
    enum technique_phase phase;
    enum technique_scene scene;
    uint32_t purposes;         /* a bit for each enum technique_purpose; 0: pictures alone */
    struct rg_technique graph; /* the rows if the technique is on; unused if `rows` is set */
    technique_rows_fn *rows;   /* may be NULL */
};

/* A rung of refraction, as --refraction names it. */
struct technique_rung {
    const char *name;                /* NULL: the technique is no rung */
    const struct refract_rung *rows; /* src/tech/refract.h; NULL: the rung is traced, not drawn */
    float reach; /* radius within which it looks up faces, in bounding radii; 0 means 1 */
    /* Shades the pixels in which ice_normal.front shows the object, with or without bumps, instead
     * of drawing its front faces (shaders/refract_seen.glsl): for rungs with costly fragments. */
    bool by_pixel;
    bool is_as_printed; /* automatic settings have the paper's values, in place of exact ones */
    bool is_whole;      /* its rows draw all refractive objects at once */
    bool meets_tree;    /* it reads the tree of the scene's triangles (scene.tree) */
    /* Return whether cracks that are gaps, and bubbles, are seen along rays that the surface has
     * bent; NULL: they are not. */
    bool (*bends_cracks)(const struct settings *settings);
    bool (*bends_bubbles)(const struct settings *settings);
    /* Sets what a choice, of which the rest is known, has of its rung; may be NULL. */
    void (*choose)(struct technique_choice *choice, const struct scene *scene);
    /* Makes a row of ice_caustics.c that of photons which go through the triangles of the whole
     * scene, for choices that meet surroundings. `own` are its further uses, which end at {0}; its
     * targets and its record function stay. NULL: photons are drawn. */
    void (*trace_photons)(struct rg_pass *row, const struct technique_choice *choice,
                          struct row_builder *builder, const struct rg_use *own);
};

/* A buffer that the host fills in every frame whose plan has it. */
struct technique_upload {
    const struct rg_buffer *buffer; /* RG_MEMORY_UPLOAD; NULL ends the list */
    /* Fills the mapped memory of the buffer. */
    void (*write)(void *memory, const struct frame_view *view, const struct globals *globals);
};

/* Texels of an image of the scene; borrowed. */
struct technique_texels {
    const void *texels;     /* NULL: the scene has none, and the fallback is imported */
    uint32_t width, height; /* of the first mip level; not 0: a plan counts on them */
    uint32_t layers;        /* 0 means 1 */
    bool all_mips; /* `texels` has all mip levels, largest first; else they are generated */
    bool no_mips;  /* the image has only the first level */
};

/* The content of a buffer of the scene; borrowed. */
struct technique_bytes {
    const void *bytes; /* NULL: the scene has none, and the import has zeros of its declared size */
    size_t size;
};

/* An image of the scene, which is imported into the plan unless the plan draws it, or a buffer of
 * texels. A row without both ends the list. */
struct technique_import {
    const struct rg_image *image;
    struct technique_texels (*find)(const struct scene *scene);
    const void *fallback; /* one texel, for scenes without texels; NULL: no image is imported */
    const struct rg_buffer *buffer; /* instead of `image`; without a format: a storage buffer */
    struct technique_bytes (*find_bytes)(const struct scene *scene, const struct rg_buffer *buffer);
    bool is_structure; /* the buffer has the acceleration structures of the scene's tree instead */
};

/* What the plans and the constants of a scene's frames depend on. */
struct technique_subject {
    const struct scene *scene;
    const struct settings *settings; /* of frame_settle() */
    const struct technique *rung;    /* NULL: one that meets no tree */
};

enum {
    TECHNIQUE_PART_COUNT = 4,
    TECHNIQUE_GROUP_COUNT = 2,
};

struct technique {
    const char *name;
    const char *help; /* one line, no full stop */
    const struct setting_group *settings[TECHNIQUE_GROUP_COUNT];
    /* Returns whether the feature is on; 0 in the first row of its settings must switch it off.
     * NULL: the feature cannot be switched off. */
    bool (*is_on)(const struct settings *settings);
    bool is_traced; /* the reference models the feature */
    bool is_of_ice; /* only ice has the feature, unless it is asked for */
    bool is_met;    /* rungs that meet the scene's tree meet the feature: it has no rows then */
    /* Returns whether, while it is on, light comes through the objects of a scene, or they hide it
     * (src/frame/cube.h); NULL: neither. */
    bool (*relights)(const struct scene *scene);
    const char *title; /* name of the feature for people; NULL: `name` */
    struct technique_part parts[TECHNIQUE_PART_COUNT];
    struct technique_rung rung;
    const struct frame_layer *layers;       /* ends at a row of zeros; may be NULL */
    const struct technique_upload *uploads; /* may be NULL */
    const struct technique_import *imports; /* may be NULL */
    /* Returns the mesh that frame_draw_mesh() draws; may be NULL. */
    const struct mesh *(*mesh)(const struct scene *scene);
    /* Puts what the scene decides in place of the technique's settings; may be NULL. */
    void (*follow_scene)(struct settings *settings, const struct scene *scene);
    /* Puts the rung's own values in place of `auto`; `rung` may be NULL. The hook may be NULL. */
    void (*settle)(struct settings *settings, const struct technique *rung);
    /* Fills the technique's members of struct globals; may be NULL. */
    void (*write_globals)(const struct frame_view *view, struct globals *globals);
    /* Fills the technique's specialization constants, indexed by their ids (shaders/constants.h);
     * may be NULL. */
    void (*write_constants)(const struct technique_subject *subject, uint32_t *values);
};

#endif
