/*
 * frame.h: what techniques share: what their functions may read of a frame, images, samplers.
 */
#ifndef FIRN_TECH_FRAME_H
#define FIRN_TECH_FRAME_H

#include "graph/rg_cmd.h"
#include "shaders/background.h"
#include "shaders/globals.h"
#include "src/scene/camera.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

struct technique;
struct window_frame;

/* What a frame shows, and how. */
struct frame_view {
    const struct scene *scene;
    const struct settings *settings;
    struct camera camera;
    float time;             /* seconds */
    uint32_t width, height; /* pixels */
    vec2s jitter;           /* of the sample, pixels */
    uint32_t face_size;     /* of the cube around the object, texels */
    vec2s tile;             /* where the tile's pixels are, in pixels: from the middle of those
                               that all tiles have at one place */
    float lod_bias;         /* log2 of the distance of neighbours, in pixels, times -1 */
};

/*
 * What a record function may read; the tag that graph/rg.h leaves to the program. Filled by the
 * renderer, once a frame.
 */
struct rg_frame {
    const struct settings *settings;
    const struct scene *scene;
    struct rg_mesh object;        /* the refractive one */
    struct rg_mesh surroundings;  /* may be empty */
    const struct rg_mesh *meshes; /* of techniques: frame_draw_mesh() */
    VkRect2D object_area;         /* pixels of the view; all of the object lies in it */
    VkRect2D lookup_area;         /* the same, and wherever else shaders look for its faces */
    struct background_push view;
    vec2s jitter;                      /* of the sample, pixels */
    struct background_push faces[6];   /* of the cube around the object, Vulkan's order */
    uint32_t faces_due;                /* those that are drawn, a bit each */
    const struct window_frame *window; /* src/view/present.h; NULL: there is no window */
};

/* struct mesh_vertex as shaders/mesh.h has it. */
extern const struct rg_vertex_layout frame_mesh_layout;

/* struct globals (shaders/globals.h), and the use of it that most rows begin with. */
extern const struct rg_buffer frame_globals;
#define FRAME_USE_GLOBALS \
    { \
        .buffer = &frame_globals, .access = RG_UNIFORM, .binding = GLOBALS_BINDING \
    }

/* The use of an image whose texels shaders read; the same, then other fields of struct rg_use. */
#define FRAME_READ(read_image, at) \
    { \
        .image = &(read_image), .access = RG_SAMPLED, .binding = (at) \
    }
#define FRAME_SAMPLE(sampled_image, at, ...) \
    { \
        .image = &(sampled_image), .access = RG_SAMPLED, .binding = (at), __VA_ARGS__ \
    }

/* What frames are drawn for. */
extern const struct rg_image frame_color;   /* linear radiance, alpha 1 */
extern const struct rg_image frame_depth;   /* reversed: 1 near, 0 infinitely far */
extern const struct rg_image frame_display; /* for the eye: 8 bits, sRGB-encoded */

enum {
    FRAME_FACE_SIZE = 512 /* texels along the sides of an environment cube's face */
};

/* The environment cube: linear radiance; a: 1 / distance, 1 / metre. The other one is for files,
 * its faces as large as the view. */
extern const struct rg_image frame_env_cube, frame_env_cube_baked;

/* The mean of many samples, from the renderer: half RGBA, rows tight, as frame_color. */
extern const struct rg_buffer frame_samples;

/* Pictures that come from the scene, imported: */
extern const struct rg_image frame_environment; /* equirectangular; 1x1 if there is none */
extern const struct rg_image frame_textures;    /* of the surroundings, an array; the same */

/* Samplers. What is anisotropic is so as far as the settings and the device let it. */
#define FRAME_ANISOTROPY 16.0f
extern const struct rg_sampler frame_linear;              /* clamped, one mip */
extern const struct rg_sampler frame_environment_sampler; /* wraps around, all mips */
extern const struct rg_sampler frame_texture_sampler;     /* repeats, all mips, anisotropic */

/* Record functions of rows that push nothing: the object; a triangle that covers the picture
 * (screen.vert), or as much of it as shaders look for the object's faces in. */
void frame_draw_object(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_screen(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_lookup_area(struct rg_cmd *cmd, const struct rg_frame *frame);

/* Draws the mesh that a technique has uploaded. */
void frame_draw_mesh(struct rg_cmd *cmd, const struct rg_frame *frame,
                     const struct technique *technique);

#endif
