/* frame_resources.h: frame state read by all techniques, and the images and samplers they share. */
#ifndef FIRN_TECH_FRAME_RESOURCES_H
#define FIRN_TECH_FRAME_RESOURCES_H

#include "graph/rg_cmd.h"
#include "shaders/globals.h"
#include "shaders/surroundings/surroundings.h"
#include "src/scene/camera.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"
#include "src/tech/aov_layer.h"

struct technique;
struct window_frame;

/* Scene, settings and camera of a frame, from which techniques compute uniform data. */
struct frame_view {
    const struct scene *scene;
    const struct settings *settings;
    struct camera camera;
    float time;             /* animation time, seconds */
    uint32_t width, height; /* image size in pixels */
    /* offset of the sample from the centre of its pixel, or of the block of interleaved tiles */
    vec2s jitter;
    vec2s light_jitter; /* photon jitter, in [-0.5, 0.5) */
    uint32_t face_size; /* environment cube face size, texels */
    uint32_t sample;    /* sample index, from 0 */
    float lod_bias;     /* mip bias of an interleaved tile (-log2 of its pixel spacing) */
    mat4s previous_clip_from_world; /* of the previous frame */
};

/* Returns the time of the previous frame in seconds, at least 0. */
float frame_time_before(const struct settings *settings, float time);

/* Computes, for a time in seconds, the rotations of objects and of bodies that orbit `center`. */
void frame_rotations(const struct frame_view *view, vec3s center, float time,
                     mat4s *world_from_object, mat4s *world_from_movers);

/* A refractive object of a scene with several objects, and the passes that draw the object. */
struct frame_object {
    const struct rg_pass *passes;
    size_t pass_count;
    uint32_t first_index, index_count; /* index range of the object's triangles */
    VkRect2D area, lookup_area;        /* as in struct rg_frame */
    VkRect2D reach;                    /* pixels that its rays may read */
    uint32_t layer;                    /* index of the group of objects that the same passes draw */
    /* next: following object of the group; NULL for the last one */
    const struct frame_object *next;
    /* Area that the object's passes draw. If a group of objects shares passes, the first object has
     * the bounding rectangle of all `reach` areas. The group's other areas are empty. */
    VkRect2D drawn;
};

/* Cached images that a frame has to redraw (src/render/frame/env_cube_updates.h). */
struct frame_updates {
    bool cube;  /* all faces of the environment cube */
    bool light; /* caustic and shadow maps */
};

/* Data of one frame, which the renderer sets and the record functions of passes read. */
struct rg_frame {
    const struct settings *settings;
    const struct scene *scene;
    struct rg_mesh object;              /* mesh of all refractive objects */
    const struct frame_object *objects; /* empty for fewer than two objects */
    size_t object_count;
    struct rg_mesh surroundings;  /* surroundings mesh; may be empty */
    const struct rg_mesh *meshes; /* meshes by technique, for frame_draw_mesh() */
    VkRect2D object_area;         /* pixels that contain the object */
    VkRect2D lookup_area;         /* pixels where shaders look up faces */
    VkRect2D ground_area;         /* pixels where ground reflects the object */
    struct surroundings_push view;
    float time;                        /* animation time, seconds */
    vec2s light_jitter;                /* as in struct frame_view */
    struct surroundings_push faces[6]; /* cube face views, Vulkan's order */
    struct frame_updates due;
    bool skips_readback;               /* not copied to the host */
    const struct window_frame *window; /* NULL if there is no window */
};

/* Vertex layout of struct mesh_vertex (shaders/mesh_layout.h). */
extern const struct rg_vertex_layout frame_mesh_layout;

/* Uniform buffer with a struct globals (shaders/globals.h), and the rg_use that binds it. */
extern const struct rg_buffer frame_globals;
#define FRAME_USE_GLOBALS \
    { \
        .buffer = &frame_globals, .access = RG_UNIFORM, .binding = GLOBALS_BINDING \
    }

/* Initialises a struct rg_image that is imported from the scene. Its size is that of the fallback
 * texel. */
#define FRAME_IMPORTED(title, texel, is_array) \
    { \
        .name = (title), .format = (texel), .width = 1, .height = 1, .array = (is_array) \
    }

/* Initialises a struct rg_use of an image that is sampled without filtering, at mip level 0. */
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
extern const struct rg_image frame_depth;   /* reversed depth: 0 is infinitely far */
extern const struct rg_image frame_display; /* display image: 8 bits, sRGB-encoded */

/* Environment cube (rgb: linear radiance; a: 1 / distance in metres) and its depth buffer. */
extern const struct rg_image frame_env_cube, frame_env_cube_depth;

/* Mean of an image's samples, uploaded as tightly packed texels in the format of frame_color. */
extern const struct rg_buffer frame_samples;

/* Images imported from the scene. */
extern const struct rg_image frame_environment;   /* equirectangular; 1x1 without one */
extern const struct rg_image frame_textures;      /* colour textures; 1x1 if none */
extern const struct rg_image frame_data_textures; /* non-colour textures; 1x1 if none */
extern const struct rg_image frame_materials; /* shaders/material_layout.h; 1x1 without materials */
/* Punctual lights of scene files (shaders/brdf.h); 1x1 if there are none. */
extern const struct rg_image frame_lights;
/* Optional vertex attributes of the surroundings (shaders/mesh_layout.h); 1x1 if there are none. */
extern const struct rg_image frame_extras;
/* Prefiltered environment light and split-sum table (shaders/brdf.h); 1x1 if unused. */
extern const struct rg_image frame_surface_light, frame_surface_split;

/* Maximum anisotropy of samplers; settings and device may lower it. */
#define FRAME_ANISOTROPY 16.0f
extern const struct rg_sampler frame_linear; /* bilinear, clamped, one mip level */
/* nearest, for passes that fetch only the texel at the fragment's own position (rg_firn.h) */
extern const struct rg_sampler frame_same_texel;
extern const struct rg_sampler frame_environment_sampler; /* wraps around horizontally, trilinear */
extern const struct rg_sampler frame_texture_sampler;     /* repeats, trilinear, anisotropic */

/* Returns the area of the view, in pixels, that contains the pass's object. */
VkRect2D frame_object_area(const struct rg_cmd *cmd, const struct rg_frame *frame);

/* Returns the refractive object that a pass draws. The scene must have at least one object. */
const struct object *frame_object_of(const struct rg_cmd *cmd, const struct rg_frame *frame);

/* Implement rg_pass.area and rg_exec_extensions.more for passes that draw one of the objects. */
VkRect2D frame_object_drawn(const struct rg_cmd *cmd, const struct rg_frame *frame);
const struct rg_pass *frame_object_next_pass(const struct rg_pass *pass,
                                             const struct rg_frame *frame);

/* Implement rg_pass.record for passes without push constants. Draw the pass's object, a full-screen
 * triangle, or a full-screen triangle clipped to lookup_area. */
void frame_draw_object(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_screen(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_lookup_area(struct rg_cmd *cmd, const struct rg_frame *frame);

/* Draws the mesh that the technique's `mesh` function returns. */
void frame_draw_mesh(struct rg_cmd *cmd, const struct rg_frame *frame,
                     const struct technique *technique);

enum {
    FRAME_DENOISE_COUNT = 3
};

/* Images that shaders/trace/trace_denoise_inputs.glsl writes for the denoise pass: traced lighting,
 * throughput and position. These layers cannot be selected by --aov. */
extern const struct frame_layer frame_denoise_layers[FRAME_DENOISE_COUNT];

#endif
