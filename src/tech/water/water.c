/*
 * water.c: passes that draw a pool of water: waves, reflections and the refracted ground.
 *
 * The waves of shaders/water/wave_function.h have analytic normals. The surface is drawn as a grid;
 * the primary ray is refracted once per pixel, intersected with the floor and walls of the pool,
 * and attenuated along its path in the water by the Beer-Lambert law. Reflectances follow Fresnel's
 * equations. Sunlight is that below level water, multiplied by the light map of
 * src/tech/water/caustics.c.
 *
 * Limits: no ray hits a second wave. Reflections show the sky and the pool's dry walls, but no
 * other surroundings. Interreflections between parts of the ground, and between the ground and the
 * surface above, are left out; to compensate, radiance is not divided by the squared index of
 * refraction where light leaves the water.
 *
 * A camera below the water has passes of its own, full-screen: rays to the ground, and to the
 * waves, which transmit the sky or reflect the ground once.
 *
 * Ice that floats in the pool (pool.ice) is drawn above the water. Rays below the water intersect
 * it by ray marching the maps of ice_gbuffer.c in the camera's view, refracted by air and level
 * water. The limits are those of refract_bounce.c, and: there is no dispersion; the ice reflects
 * only the sky and the dry walls; the water does not reflect the ice; no ray hits the ice twice;
 * the ice affects neither the sunlight nor the waves.
 */
#include "shaders/water/water.h"
#include <math.h>
#include "shaders/embedded.h"
#include "shaders/water/wave_function.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/output/gbuffer.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract.h"
#include "src/tech/water/caustics.h"
#include "src/tech/water/pool_parameters.h"

static rg_record_fn record_surface, record_ice, record_below;
static rg_when_fn is_above, is_below;

static const struct rg_use surface_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_environment, WATER_ENVIRONMENT, .sampler = &frame_environment_sampler),
    { 0 },
};

static const struct rg_use caustics_uses[] = {
    FRAME_SAMPLE(caustics_light, WATER_CAUSTICS, .sampler = &frame_linear),
    { 0 },
};

/* Depth and normal maps of the ice that shaders/refract/refract_march_ray.glsl marches through. */
static const struct rg_use ice_uses[] = {
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT),
    { 0 },
};

static const struct rg_pass gbuffer_pass = {
    .name = "water.gbuffer",
    .color = RG_TARGETS({ &gbuffer_normal, RG_LOAD_KEEP }),
    .depth = { &gbuffer_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .uses = RG_USES(FRAME_USE_GLOBALS),
    .vert = &water_vert,
    .frag = &water_gbuffer_frag,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

static const struct rg_pass color_pass = {
    .name = "water.color",
    .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .vert = &water_vert,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
    .when = is_above,
};

/* Draws the part of the floating ice above the water. */
static const struct rg_pass ice_pass = {
    .name = "water.ice",
    .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .vert = &refract_vert,
    .vertices = &frame_mesh_layout,
    .cull = VK_CULL_MODE_BACK_BIT,
    .push_size = sizeof(struct water_push),
    .record = record_ice,
    .when = is_above,
};

static const struct rg_pass layers_pass = {
    .name = "water.layers",
    .color = RG_TARGETS({ &caustics_layer, RG_LOAD_CLEAR }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_read_only = true,
    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
    .vert = &water_vert,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

static const struct rg_pass below_pass = {
    .name = "water.below",
    .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP }),
    .vert = &fullscreen_ray_vert,
    .push_size = sizeof(struct water_push),
    .record = record_below,
    .when = is_below,
};

static const struct rg_pass below_layers_pass = {
    .name = "water.below_layers",
    .color = RG_TARGETS({ &caustics_layer, RG_LOAD_KEEP }),
    .vert = &fullscreen_ray_vert,
    .push_size = sizeof(struct water_push),
    .record = record_below,
    .when = is_below,
};

enum {
    PASS_COUNT = 6
};

/* Shader variants, indexed by whether there is ice and whether there are caustics. */
static const struct rg_shader *const color_frags[2][2] = {
    { &water_frag, &water_caustics_frag },
    { &water_iced_frag, &water_iced_caustics_frag },
};
static const struct rg_shader *const ice_frags[2] = { &water_ice_frag, &water_ice_caustics_frag };
static const struct rg_shader *const layers_frags[2] = {
    &water_caustics_aov_frag,
    &water_iced_caustics_aov_frag,
};

static const struct rg_shader *const below_frags[2][2] = {
    { &underwater_view_frag, &underwater_view_caustics_frag },
    { &underwater_view_iced_frag, &underwater_view_iced_caustics_frag },
};
static const struct rg_shader *const below_layers_frags[2] = {
    &underwater_view_caustics_aov_frag,
    &underwater_view_iced_caustics_aov_frag,
};

/* Appends a copy of `pass` with the given resource uses and fragment shader. */
static void add_pass(struct rg_technique *technique, struct rg_pass *passes,
                     const struct rg_pass *pass, const struct rg_use *uses,
                     const struct rg_shader *frag)
{
    struct rg_pass *added = &passes[technique->pass_count++];
    *added = *pass;
    added->uses = uses;
    added->frag = frag;
}

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const bool lit = caustics_are_lit(config->settings);
    const bool iced = pool_has_ice(config->settings);
    const struct rg_use *const lists[] = { surface_uses, lit ? caustics_uses : NULL,
                                           iced ? ice_uses : NULL };
    const struct rg_use *uses = pass_arena_join_uses(builder, lists, 3);
    struct rg_pass *passes = pass_arena_alloc(builder, PASS_COUNT * sizeof(*passes));
    if (!passes)
        return (struct rg_technique){ 0 };
    struct rg_technique technique = { "water", passes, 1 };
    passes[0] = gbuffer_pass;
    add_pass(&technique, passes, &color_pass, uses, color_frags[iced][lit]);
    if (iced)
        add_pass(&technique, passes, &ice_pass, uses, ice_frags[lit]);
    add_pass(&technique, passes, &below_pass, uses, below_frags[iced][lit]);
    if (lit) {
        add_pass(&technique, passes, &layers_pass, uses, layers_frags[iced]);
        add_pass(&technique, passes, &below_layers_pass, uses, below_layers_frags[iced]);
    }
    return technique;
}

/* Returns true if the camera is in the pool below the waves. Ice in the pool is ignored. */
static bool is_below(const struct rg_frame *frame, uint32_t repetition)
{
    const struct water_push push = pool_push_of(frame->settings);
    const vec3s eye = frame->view.eye;
    const vec2s at = { { eye.x, -eye.z } }; /* pool coordinates (lib/pool_walls.glsl) */
    const float half = 0.5f * push.pool.size;
    (void)repetition;
    return fabsf(at.x) < half && fabsf(at.y) < half && eye.y > -push.pool.depth &&
           eye.y < wave_at(push.water, at, frame->time).z;
}

static bool is_above(const struct rg_frame *frame, uint32_t repetition)
{
    return !is_below(frame, repetition);
}

static void record_surface(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct water_push push = pool_push_of(frame->settings);
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, WATER_GRID * (2 * WATER_GRID + 4));
}

static void record_ice(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct water_push push = pool_push_of(frame->settings);
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw_mesh(cmd, &frame->object);
}

static void record_below(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct water_push push = pool_push_of(frame->settings);
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
}

const struct technique water = {
    .name = "water",
    .help = "pool of water and the ground below it",
    .pass_groups = { { PHASE_REFRACTION, SCENE_OF_POOL, .make_passes = make_passes } },
};
