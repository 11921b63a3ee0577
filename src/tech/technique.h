/*
 * technique.h: a technique as the program knows it: its rows, its settings, what it uploads.
 *
 * One technique is one file of src/tech: citation, images, pass tables, record functions, settings.
 * It owns nothing and holds no writable data. src/tech/techniques.h lists them all; nothing else
 * has to be told of a new one.
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

/* What decides which rows a plan has. */
struct technique_choice {
    const struct settings *settings;
    enum technique_purpose purpose;
    const struct technique *rung; /* of a picture without a pool; else it may be NULL */
    bool is_convex;               /* the object is known to be convex */
    bool has_pool;                /* the scene is a pool of water */
    bool has_cube;                /* the scene has an environment cube of its own */
};

/* When in a frame a part of a technique is drawn. Within a phase the order of the list counts. */
enum technique_phase {
    PHASE_LIGHT,       /* light maps */
    PHASE_ENVIRONMENT, /* the environment cube */
    PHASE_SURFACES,    /* first surfaces */
    PHASE_DEPTHS,      /* depths inside the object */
    PHASE_NORMALS,     /* normals of the object's faces */
    PHASE_REFRACTION,  /* the refractive object or the water */
    PHASE_INCLUSIONS,  /* what is inside the object, each into its own image */
    PHASE_COMPOSITE,   /* the inclusions, blended over the picture */
    PHASE_BACKGROUND,  /* what the object does not hide */
    PHASE_LAYERS,      /* the rung's layers */
    PHASE_FINISH,      /* what is drawn over the finished picture: frost, free cracks */
    PHASE_DISPLAY,     /* tone mapping */
    PHASE_COUNT,
};

/* Which scenes have a part. */
enum technique_scene {
    SCENE_OF_OBJECT, /* those without a pool */
    SCENE_OF_POOL,
    SCENE_OF_ANY,
};

/* Returns a part's rows; without passes the part is off. Tables that depend on the choice are made
 * with the builder (src/tech/row_builder.h) and live as long as it does. */
typedef struct rg_technique technique_rows_fn(const struct technique_choice *choice,
                                              struct row_builder *builder);

struct technique_part {
    enum technique_phase phase;
    enum technique_scene scene;
    uint32_t purposes;         /* bit of each enum technique_purpose; 0: pictures alone */
    struct rg_technique graph; /* rows that are there while the technique is on; or: */
    technique_rows_fn *rows;
};

/* A rung of refraction, as --refraction names it. */
struct technique_rung {
    const char *name;                /* NULL: the technique is no rung */
    const struct refract_rung *rows; /* src/tech/refract.h; NULL: it is traced, not drawn */
    float reach; /* where it looks for the object's faces: radii of the bounding sphere; 0: 1 */
};

/* A buffer that the host fills in every frame, if the plan has it. */
struct technique_upload {
    const struct rg_buffer *buffer; /* RG_MEMORY_UPLOAD; NULL ends the list */
    void (*write)(void *memory, const struct frame_view *view, const struct globals *globals);
};

/* Texels of an image that comes from the scene. */
struct technique_texels {
    const void *texels;     /* NULL: the scene has none, and one texel is imported in its place */
    uint32_t width, height; /* of the first mip level */
    uint32_t layers;        /* 0 means 1 */
    bool all_mips;          /* `texels` has all mip levels, largest first; else they are made */
    bool no_mips;           /* there is only the first level */
};

/* An image that comes from the scene, imported into the plan unless the plan draws it. */
struct technique_import {
    const struct rg_image *image; /* NULL ends the list */
    struct technique_texels (*find)(const struct scene *scene);
    const void *fallback; /* its one texel where the scene has none; NULL: no image at all */
};

enum {
    TECHNIQUE_PART_COUNT = 4,
    TECHNIQUE_GROUP_COUNT = 2,
};

struct technique {
    const char *name;
    const char *help; /* one line, no full stop */
    const struct setting_group *settings[TECHNIQUE_GROUP_COUNT];
    /* Whether the feature is on; it is not where the first row of its settings is 0. NULL: it is no
     * feature that can be switched. */
    bool (*is_on)(const struct settings *settings);
    bool is_traced;    /* the reference models the feature */
    bool relights;     /* while it is on, surroundings look different in every frame */
    const char *title; /* of the feature, where it is named to people; NULL: `name` */
    struct technique_part parts[TECHNIQUE_PART_COUNT];
    struct technique_rung rung;
    const struct frame_layer *layers;                      /* ends at a row of zeros; may be NULL */
    const struct technique_upload *uploads;                /* may be NULL */
    const struct technique_import *imports;                /* may be NULL */
    const struct mesh *(*mesh)(const struct scene *scene); /* of frame_draw_mesh() */
    /* Fills the technique's members of struct globals; may be NULL. */
    void (*write_globals)(const struct frame_view *view, struct globals *globals);
    /* Fills its specialization constants, by their ids (shaders/constants.h); may be NULL. */
    void (*write_constants)(const struct settings *settings, uint32_t *values);
};

#endif
