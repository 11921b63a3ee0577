/*
 * frame.h: state of a frame that all techniques read, and the images and samplers they share.
 */
#ifndef FIRN_TECH_FRAME_H
#define FIRN_TECH_FRAME_H

#include "graph/rg_cmd.h"
#include "shaders/globals.h"
#include "shaders/surroundings/surroundings.h"
#include "src/scene/camera.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"
#include "src/tech/layer.h"

struct technique;
struct window_frame;

/* Scene, settings and camera of a frame, from which techniques compute uniform data. */
struct frame_view {
    const struct scene *scene;
    const struct settings *settings;
    struct camera camera;
    float time;             /* animation time, seconds */
    uint32_t width, height; /* image size in pixels */
    vec2s jitter;           /* subpixel offset of the sample, pixels */
    vec2s light_jitter;     /* offset of the sample's photons, each in [-0.5, 0.5) */
    uint32_t face_size;     /* size of the environment cube's faces, texels */
    /* of an interleaved tile: offset of its pixels from the block's middle, image pixels */
    vec2s tile;
    uint32_t sample; /* index of the sample in the image, from 0 */
    float lod_bias;  /* mip level bias of a tile, -log2 of its pixel spacing; otherwise 0 */
    mat4s previous_clip_from_world; /* of the previous frame */
};

/* Returns the time of the previous frame in seconds, at least 0. */
float frame_time_before(const struct settings *settings, float time);

/* Computes the rotations of the objects about `center` and of what orbits them. */
void frame_rotations(const struct frame_view *view, vec3s center, float time,
                     mat4s *world_from_object, mat4s *world_from_movers);

/* One of several refractive objects and the passes that draw it in this frame. */
struct frame_object {
    const struct rg_pass *rows;
    size_t row_count;
    uint32_t first_index, index_count; /* the object's triangles in the mesh of all objects */
    VkRect2D area, lookup_area;        /* as in struct rg_frame */
    VkRect2D reach;                    /* pixels of the view that the object's rays may look up */
    uint32_t layer;                    /* layer: objects that do not look up each other's images */
    const struct frame_object *next;   /* next of the layer, with the same passes; NULL if last */
    /* drawn area: reach of its layer; empty if another's passes draw it */
    VkRect2D drawn;
};

/* Cached results that a frame has to redraw (src/frame/env_cube_updates.h). */
struct frame_updates {
    uint32_t faces; /* bit mask of the environment cube's faces */
    bool light;     /* the maps of light that objects transmit */
};

/*
 * State that record functions may read; graph/rg.h declares the struct, programs define it. The
 * renderer fills it once per frame.
 */
struct rg_frame {
    const struct settings *settings;
    const struct scene *scene;
    struct rg_mesh object;              /* mesh of all refractive objects */
    const struct frame_object *objects; /* empty if there are fewer than two objects */
    size_t object_count;
    struct rg_mesh surroundings;  /* mesh of the surroundings; may be empty */
    const struct rg_mesh *meshes; /* meshes by technique, for frame_draw_mesh() */
    VkRect2D object_area;         /* pixels of the view that contain the whole object */
    VkRect2D lookup_area; /* pixels of the view in which shaders look up the object's faces */
    VkRect2D ground_area; /* pixels of the view in which the ground may reflect the object */
    struct surroundings_push view;
    float time;         /* animation time, seconds */
    vec2s light_jitter; /* as in struct frame_view */
    struct surroundings_push
        faces[6]; /* views of the environment cube's faces, in Vulkan's order */
    struct frame_updates due;
    bool stays; /* the frame is presented from device memory and not read back */
    const struct window_frame *window; /* src/view/present.h; NULL if there is no window */
};

/* Vertex layout of struct mesh_vertex (shaders/mesh_layout.h). */
extern const struct rg_vertex_layout frame_mesh_layout;

/* Uniform buffer of struct globals (shaders/globals.h), and the use that most passes start with. */
extern const struct rg_buffer frame_globals;
#define FRAME_USE_GLOBALS \
    { \
        .buffer = &frame_globals, .access = RG_UNIFORM, .binding = GLOBALS_BINDING \
    }

/* Uses of an image: FRAME_READ for texel fetches; FRAME_SAMPLE takes more fields, as a sampler. */
#define FRAME_READ(read_image, at) \
    { \
        .image = &(read_image), .access = RG_SAMPLED, .binding = (at) \
    }
#define FRAME_SAMPLE(sampled_image, at, ...) \
    { \
        .image = &(sampled_image), .access = RG_SAMPLED, .binding = (at), __VA_ARGS__ \
    }

/* The images that a frame produces. */
extern const struct rg_image frame_color;   /* linear radiance, alpha 1 */
extern const struct rg_image frame_depth;   /* reversed depth: 1 near, 0 infinitely far */
extern const struct rg_image frame_display; /* display image: 8 bits, sRGB-encoded */

/* Environment cube: rgb: linear radiance; a: 1 / distance in metres. Its depth buffers have the
 * size given by a setting. frame_env_cube_baked is written to files, with faces of the view's size.
 */
extern const struct rg_image frame_env_cube, frame_env_cube_depth, frame_env_cube_baked;

/* Mean of many samples, written by the renderer: tightly packed rows of frame_color's texels. */
extern const struct rg_buffer frame_samples;

/* Images imported from the scene. */
extern const struct rg_image frame_environment; /* equirectangular; 1x1 if there is none */
extern const struct rg_image frame_textures;    /* colour textures; 1x1 if there are none */
extern const struct rg_image frame_numbers;     /* non-colour textures; 1x1 if there are none */
extern const struct rg_image frame_materials; /* shaders/material_layout.h; 1x1 without materials */
/* Punctual lights of scene files (shaders/brdf.h); 1x1 if there are none. */
extern const struct rg_image frame_lights;
/* Optional vertex attributes of the surroundings (shaders/mesh_layout.h); 1x1 if there are none. */
extern const struct rg_image frame_extras;
/* Prefiltered environment light and split-sum table (shaders/brdf.h); 1x1 if unused. */
extern const struct rg_image frame_surface_light, frame_surface_split;

/* Samplers; settings and device limit the anisotropy. */
#define FRAME_ANISOTROPY 16.0f
extern const struct rg_sampler frame_linear;              /* bilinear, clamped, one mip level */
extern const struct rg_sampler frame_environment_sampler; /* wraps around horizontally, trilinear */
extern const struct rg_sampler frame_texture_sampler;     /* repeats, trilinear, anisotropic */

/* Returns the area of the view, in pixels, that contains the pass's object. */
VkRect2D frame_object_area(const struct rg_cmd *cmd, const struct rg_frame *frame);

/* Returns the refractive object that a pass draws; the scene must have listed its objects. */
const struct object *frame_object_of(const struct rg_cmd *cmd, const struct rg_frame *frame);

/* Return the area in which a pass draws one of several objects, and the pass of the next object of
 * its layer. */
VkRect2D frame_object_drawn(const struct rg_cmd *cmd, const struct rg_frame *frame);
const struct rg_pass *frame_object_more(const struct rg_pass *row, const struct rg_frame *frame);

/* Record functions of passes without push constants: draw the pass's object; a full-screen triangle
 * (fullscreen.vert); that triangle within lookup_area. */
void frame_draw_object(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_screen(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_lookup_area(struct rg_cmd *cmd, const struct rg_frame *frame);

/* Draws the mesh that the technique's `mesh` function has returned. */
void frame_draw_mesh(struct rg_cmd *cmd, const struct rg_frame *frame,
                     const struct technique *technique);

enum {
    FRAME_DENOISE_COUNT = 3
};

/* Outputs of shaders/trace_denoise.glsl for the denoise pass: light and the fraction of
 * samples that gathered it, throughput, position. They are not offered as layers of --aov. */
extern const struct frame_layer frame_denoise_layers[FRAME_DENOISE_COUNT];

#endif
