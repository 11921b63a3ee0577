/*
 * frame.h: what techniques share: the data of a frame that their functions read, images, samplers.
 */
#ifndef FIRN_TECH_FRAME_H
#define FIRN_TECH_FRAME_H

#include "graph/rg_cmd.h"
#include "shaders/background.h"
#include "shaders/globals.h"
#include "src/scene/camera.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"
#include "src/tech/layer.h"

struct technique;
struct window_frame;

/* What a frame shows, and how; for functions that compute uniform data. */
struct frame_view {
    const struct scene *scene;
    const struct settings *settings;
    struct camera camera;
    float time;             /* seconds */
    uint32_t width, height; /* pixels */
    vec2s jitter;           /* of the sample, pixels */
    vec2s light_jitter;     /* of the sample's photons, each in [-0.5, 0.5) */
    uint32_t face_size;     /* of the cube around the object, texels */
    vec2s tile;             /* of an interleaved tile: offset of its pixels, in pixels of the
                               picture, from the middle of each block of all tiles' pixels */
    uint32_t sample;        /* of the picture, from 0 */
    float lod_bias;         /* of an interleaved tile: -log2 of the distance of its pixels in the
                               picture; else 0 */
    mat4s clip_from_world_earlier; /* of the frame before */
};

/* Returns the time of the frame before, seconds, at least 0. */
float frame_time_before(const struct settings *settings, float time);

/* Computes the poses of the objects, which turn about `center`, and of what moves around them. */
void frame_turn(const struct frame_view *view, vec3s center, float time, mat4s *world_from_object,
                mat4s *world_from_movers);

/* The rows that draw one of several refractive objects, and which one in this frame. */
struct frame_object {
    const struct rg_pass *rows;
    size_t row_count;
    uint32_t first_index, index_count; /* its triangles in the mesh of all objects */
    VkRect2D area, lookup_area;        /* as those of struct rg_frame */
    VkRect2D reach;                    /* pixels of the view that its rays may look up */
    uint32_t layer;                    /* objects of a layer cannot look each other up */
    const struct frame_object *next;   /* of its layer: drawn by the same passes; NULL: none */
    VkRect2D drawn; /* by its rows: the reach of its layer; nothing if another's rows draw it */
};

/* What a frame draws of what is kept from frame to frame: src/frame/cube.h. */
struct frame_due {
    uint32_t faces; /* a bit for each of the cube's */
    bool light;     /* that comes through objects, if any does */
};

/*
 * What a record function may read: the struct that graph/rg.h leaves to the program. The renderer
 * fills it once a frame.
 */
struct rg_frame {
    const struct settings *settings;
    const struct scene *scene;
    struct rg_mesh object;              /* all refractive objects */
    const struct frame_object *objects; /* empty if there is one object, or none */
    size_t object_count;
    struct rg_mesh surroundings;  /* may be empty */
    const struct rg_mesh *meshes; /* of the techniques, for frame_draw_mesh() */
    VkRect2D object_area;         /* pixels of the view that contain the whole object */
    VkRect2D lookup_area;         /* pixels of the view in which shaders look up its faces */
    VkRect2D foot_area;           /* pixels in which ground at its foot may mirror it */
    struct background_push view;
    float time;                      /* seconds */
    vec2s light_jitter;              /* as in struct frame_view */
    struct background_push faces[6]; /* of the cube around the object, Vulkan's order */
    struct frame_due due;
    bool stays;                        /* on the device: it is shown, and not read back */
    const struct window_frame *window; /* src/view/present.h; NULL: there is no window */
};

/* The layout of struct mesh_vertex (shaders/mesh.h). */
extern const struct rg_vertex_layout frame_mesh_layout;

/* The uniform buffer of struct globals (shaders/globals.h), and the use with which most rows
 * begin. */
extern const struct rg_buffer frame_globals;
#define FRAME_USE_GLOBALS \
    { \
        .buffer = &frame_globals, .access = RG_UNIFORM, .binding = GLOBALS_BINDING \
    }

/* FRAME_READ is a use of an image whose texels shaders fetch; FRAME_SAMPLE takes further fields of
 * struct rg_use, such as the sampler. */
#define FRAME_READ(read_image, at) \
    { \
        .image = &(read_image), .access = RG_SAMPLED, .binding = (at) \
    }
#define FRAME_SAMPLE(sampled_image, at, ...) \
    { \
        .image = &(sampled_image), .access = RG_SAMPLED, .binding = (at), __VA_ARGS__ \
    }

/* The results of a frame. */
extern const struct rg_image frame_color;   /* linear radiance, alpha 1 */
extern const struct rg_image frame_depth;   /* reversed: 1 near, 0 infinitely far */
extern const struct rg_image frame_display; /* for the eye: 8 bits, sRGB-encoded */

/* The environment cube: linear radiance; alpha: 1 / distance, 1 / metre; and the depths of its
 * faces, whose size is a setting. frame_env_cube_baked is the one for files; its faces have the
 * view's size. */
extern const struct rg_image frame_env_cube, frame_env_cube_depth, frame_env_cube_baked;

/* The mean of many samples, which the renderer writes: texels of frame_color, rows tight. */
extern const struct rg_buffer frame_samples;

/* Imported images of the scene. */
extern const struct rg_image frame_environment; /* equirectangular; 1x1 if the scene has none */
extern const struct rg_image frame_textures;    /* surroundings' textures; 1x1 if it has none */
extern const struct rg_image frame_numbers;     /* those of what is no colour, likewise */
extern const struct rg_image frame_materials;   /* shaders/material.h; 1x1 if nothing has any */
/* The lights of files (shaders/lit.h); 1x1 if there are none. */
extern const struct rg_image frame_lights;
/* Of the surroundings' vertices (shaders/mesh.h); 1x1 if they have none. */
extern const struct rg_image frame_extras;
/* Tables of light on surfaces (shaders/lit.h); 1x1 if nothing needs them. */
extern const struct rg_image frame_surface_light, frame_surface_split;

/* Samplers. The settings and the device limit the anisotropy. */
#define FRAME_ANISOTROPY 16.0f
extern const struct rg_sampler frame_linear;              /* clamped, one mip */
extern const struct rg_sampler frame_environment_sampler; /* wraps around, all mips */
extern const struct rg_sampler frame_texture_sampler;     /* repeats, all mips, anisotropic */

/* The pixels of the view that contain the row's object. */
VkRect2D frame_object_area(const struct rg_cmd *cmd, const struct rg_frame *frame);

/* The refractive object of the scene that a row draws; the scene must have listed its objects. */
const struct object *frame_object_of(const struct rg_cmd *cmd, const struct rg_frame *frame);

/* The area of a row that draws one of several objects, and the row of the next one of its layer. */
VkRect2D frame_object_drawn(const struct rg_cmd *cmd, const struct rg_frame *frame);
const struct rg_pass *frame_object_more(const struct rg_pass *row, const struct rg_frame *frame);

/* Record functions of rows without push constants: they draw the row's object, a triangle that
 * covers the picture (screen.vert), and that triangle within lookup_area. */
void frame_draw_object(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_screen(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_lookup_area(struct rg_cmd *cmd, const struct rg_frame *frame);

/* Draws the mesh that the technique's `mesh` function returned. */
void frame_draw_mesh(struct rg_cmd *cmd, const struct rg_frame *frame,
                     const struct technique *technique);

enum {
    FRAME_SMOOTH_COUNT = 3
};

/* What shaders/trace_smooth.glsl writes if a choice smooths: light, and the share of samples that
 * gather it; the share of all; the place. None of them is a layer of --aov. */
extern const struct frame_layer frame_smooth_layers[FRAME_SMOOTH_COUNT];

#endif
