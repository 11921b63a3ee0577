/*
 * refract.h: what the refraction rungs (refract_*.c) share: their layers and the index.
 *
 * A rung is two techniques, of a row each. The picture's comes before the background, which then
 * leaves out what the ice hides; that of the layers after it, since surroundings may hide the ice.
 * It may name what other techniques make (env_cube, ice_normal); what the chosen rung does not name
 * is culled. Others with the same rows draw it with bumps: so smooth ice reads no map.
 */
#ifndef TECH_REFRACT_H
#define TECH_REFRACT_H
#include "shaders/refract.h"
#include "src/tech/background.h"
#include "src/tech/env_cube.h"
#include "src/tech/ice_normal.h"
#include "src/tech/surface.h"
#include "src/technique.h"

/* On the ice's front faces; 0 elsewhere. With dispersion, exit and way are those of green. */
extern const struct rg_image refract_exit;       /* unit direction in which light leaves */
extern const struct rg_image refract_refraction; /* linear radiance from there */
extern const struct rg_image refract_reflection; /* linear radiance by reflection */
extern const struct rg_image refract_fresnel;    /* share of the reflection */
/* x: how far light goes inside, metres, 0 where the rung does not know; y: how often it is totally
 * reflected there; z: 1 if so where it first could leave, else 0 */
extern const struct rg_image refract_way;

extern const struct setting_group refract_settings;

struct refract_params {
    float ior;        /* refractive index of the object, for green */
    float dispersion; /* 20 / Abbe number, as KHR_materials_dispersion has it; 0: none */
    uint32_t fresnel; /* REFRACT_FRESNEL_PAPER ... */
    float crossfade;  /* share of refraction with REFRACT_FRESNEL_CROSSFADE */
    uint32_t lookup;  /* REFRACT_LOOKUP_INFINITE ... */
    uint32_t steps;   /* of REFRACT_LOOKUP_DISTANCE */
};

/* Refractive index of the air around it (Cg Tutorial; Seipel and Nivfors 2006, eq. 2). */
#define REFRACT_IOR_AIR 1.0003f

/* The use of the environment that every rung has. */
#define REFRACT_USE_ENV_CUBE \
    { \
        .image = &env_cube_color, .access = RG_SAMPLED, .binding = REFRACT_ENV_CUBE, \
        .sampler = &frame_linear \
    }

/* Uses that a rung may have. */
#define REFRACT_USE_NORMAL_BACK \
    { \
        .image = &ice_normal_back, .access = RG_SAMPLED, .binding = REFRACT_NORMAL_BACK, \
        .sampler = &frame_linear \
    }
#define REFRACT_USE_DEPTH_BACK \
    { \
        .image = &ice_normal_back_depth, .access = RG_SAMPLED, .binding = REFRACT_DEPTH_BACK \
    }
/* The same of rungs that read the pixel's own alone. */
#define REFRACT_USE_NORMAL_BACK_HERE \
    { \
        .image = &ice_normal_back, .access = RG_SAMPLED, .binding = REFRACT_NORMAL_BACK, \
        .sampler = &frame_linear, .same_texel = true \
    }
#define REFRACT_USE_DEPTH_BACK_HERE \
    { \
        .image = &ice_normal_back_depth, .access = RG_SAMPLED, .binding = REFRACT_DEPTH_BACK, \
        .same_texel = true \
    }
#define REFRACT_USE_NORMAL_FRONT \
    { \
        .image = &ice_normal_front, .access = RG_SAMPLED, .binding = REFRACT_NORMAL_FRONT, \
        .sampler = &frame_linear \
    }
#define REFRACT_USE_DEPTH_FRONT \
    { \
        .image = &ice_normal_front_depth, .access = RG_SAMPLED, .binding = REFRACT_DEPTH_FRONT \
    }

/* The use that refract_over.frag has: what is drawn over the picture, of the view's size. */
#define REFRACT_USE_OVER(target) \
    { \
        .image = (target), .access = RG_SAMPLED, .binding = REFRACT_OVER, .same_texel = true \
    }

/* What is drawn: the front faces, with eq. 4 at the vertices. */
#define REFRACT_FRONT_FACES \
    .vert = &refract_vert, .vertices = &frame_mesh_layout, .cull = VK_CULL_MODE_BACK_BIT

/* The same with the mesh's uv for bumps (bump.h). */
#define REFRACT_BUMPED_FACES \
    .vert = &refract_bump_vert, .vertices = &frame_mesh_layout, .cull = VK_CULL_MODE_BACK_BIT

/* Where the rung draws no ice. */
#define REFRACT_NO_HIGHLIGHT \
    { \
        .color.float32 = { -1.0f } \
    }

/* The targets of a rung's row for the picture, and of its row for the layers. */
#define REFRACT_COLORS \
    .color = RG_TARGETS([REFRACT_OUT_COLOR] = { &background_color, RG_LOAD_DISCARD }, \
                        [REFRACT_OUT_HIGHLIGHT] = { &surface_highlight, RG_LOAD_CLEAR, \
                                                    REFRACT_NO_HIGHLIGHT })
#define REFRACT_LAYER_TARGETS \
    .color = RG_TARGETS([REFRACT_OUT_EXIT] = { &refract_exit, RG_LOAD_CLEAR }, \
                        [REFRACT_OUT_REFRACTION] = { &refract_refraction, RG_LOAD_CLEAR }, \
                        [REFRACT_OUT_REFLECTION] = { &refract_reflection, RG_LOAD_CLEAR }, \
                        [REFRACT_OUT_FRESNEL] = { &refract_fresnel, RG_LOAD_CLEAR }, \
                        [REFRACT_OUT_WAY] = { &refract_way, RG_LOAD_CLEAR })

/* The techniques of a rung, from its rows, and what both say of themselves. */
enum {
    REFRACT_PICTURE,
    REFRACT_LAYERS,
};

#define REFRACT_TECHNIQUES(title, rows, ...) \
    { \
        [REFRACT_PICTURE] = { { (title), &(rows)[REFRACT_PICTURE], 1 }, __VA_ARGS__ }, \
        [REFRACT_LAYERS] = { { (title), &(rows)[REFRACT_LAYERS], 1 }, __VA_ARGS__ }, \
    }

/* The rows of a rung that draws the front faces: refract_STEM.frag (or _bump), compiled for both;
 * then what both rows say. */
#define REFRACT_ROWS(stem, variant, ...) \
    { .name = "refract_" #stem ".color", \
      REFRACT_COLORS, \
      .depth = { &background_depth, RG_LOAD_CLEAR }, /* 0 is infinity */ \
      .depth_compare = VK_COMPARE_OP_GREATER, \
      .frag = &refract_##stem##variant##_frag, \
      __VA_ARGS__ }, \
    { \
        .name = "refract_" #stem ".layers", REFRACT_LAYER_TARGETS, \
        .depth = { &background_depth, RG_LOAD_KEEP }, .depth_read_only = true, \
        .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL, \
        .frag = &refract_##stem##variant##_aov_frag, __VA_ARGS__ \
    }

/* The rows of a rung whose pixels cost much: it draws all those in which ice_normal.front shows the
 * ice (refract_seen.glsl), bumpy or not; then what both rows read. */
#define REFRACT_SEEN_ROWS(stem, push, recorded, ...) \
    { .name = "refract_" #stem ".color", \
      REFRACT_COLORS, \
      .depth = { &background_depth, RG_LOAD_KEEP }, \
      .depth_read_only = true, \
      .depth_compare = VK_COMPARE_OP_LESS, \
      .frag = &refract_##stem##_frag, \
      .uses = RG_USES(REFRACT_SEEN_USES, __VA_ARGS__), \
      REFRACT_SEEN_DRAW(push, recorded) }, \
    { \
        .name = "refract_" #stem ".layers", REFRACT_LAYER_TARGETS, \
        .frag = &refract_##stem##_aov_frag, \
        .uses = RG_USES(REFRACT_SEEN_USES, REFRACT_USE_DEPTH_SCENE, __VA_ARGS__), \
        REFRACT_SEEN_DRAW(push, recorded) \
    }
#define REFRACT_SEEN_DRAW(push, recorded) \
    .vert = &refract_seen_vert, .push_size = sizeof(push), .record = (recorded)
#define REFRACT_SEEN_USES \
    FRAME_USE_GLOBALS, REFRACT_USE_DEPTH_FRONT, \
    { \
        .image = &ice_normal_shading, .access = RG_SAMPLED, .binding = REFRACT_SHADING, \
        .same_texel = true \
    }
#define REFRACT_USE_DEPTH_SCENE \
    { \
        .image = &background_depth, .access = RG_SAMPLED, .binding = REFRACT_DEPTH_SCENE, \
        .same_texel = true \
    }

/* What lies in or on the ice is drawn over the rung's picture, on the front faces that it drew:
 * premultiplied colour. The vertex shader is refract.vert, or one as precise. */
#define REFRACT_OVER_TARGETS \
    .color = RG_TARGETS({ &background_color, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }), \
    .depth = { &background_depth, RG_LOAD_KEEP }, .depth_read_only = true, \
    .depth_compare = VK_COMPARE_OP_EQUAL

#endif
