/*
 * frame.h: what a record function may read. Filled by the renderer, once a frame.
 */
#ifndef FIRN_TECH_FRAME_H
#define FIRN_TECH_FRAME_H

#include "graph/rg_cmd.h"
#include "shaders/background.h"
#include "shaders/globals.h"
#include "src/settings/settings.h"

struct window_frame;

/* The tag that graph/rg.h leaves to the program. */
struct rg_frame {
    const struct settings *settings;
    struct rg_mesh object;       /* the refractive one */
    struct rg_mesh surroundings; /* may be empty */
    struct rg_mesh cracks;       /* in the object's space, as are these; may be empty */
    struct rg_mesh air;          /* planes */
    uint32_t bubble_count;       /* in bubbles_spheres */
    VkRect2D object_area;        /* pixels of the view; all of the object lies in it */
    VkRect2D lookup_area;        /* the same, and wherever else shaders look for the ice's faces */
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

/* Pictures that come from the scene, imported: */
extern const struct rg_image frame_environment; /* equirectangular; 1x1 if there is none */
extern const struct rg_image frame_textures;    /* of the surroundings, an array; the same */
extern const struct rg_image frame_air;         /* struct air_layers, an array; the same */

/* Samplers. What is anisotropic is so as far as the settings and the device let it. */
#define FRAME_ANISOTROPY 16.0f
extern const struct rg_sampler frame_linear;              /* clamped, one mip */
extern const struct rg_sampler frame_environment_sampler; /* wraps around, all mips */
extern const struct rg_sampler frame_texture_sampler;     /* repeats, all mips, anisotropic */

/* Record functions of rows that push nothing: the object; a triangle that covers the picture
 * (screen.vert) as far as shaders look for the ice's faces. */
void frame_draw_object(struct rg_cmd *cmd, const struct rg_frame *frame);
void frame_draw_lookup_area(struct rg_cmd *cmd, const struct rg_frame *frame);

#endif
