/*
 * water.c: a pool of water: waves, their reflection, and the ground seen by refraction.
 *
 * The waves of shaders/wave.h have exact normals. The surface is drawn as a grid; in each
 * pixel the ray is refracted once, meets the floor or a wall of the pool exactly, and is absorbed
 * along its path through the water by the law of Beer and Lambert. Reflectances are those of
 * Fresnel's equations. The sun's light falls as through water at rest, multiplied by the light map
 * of src/tech/caustics.c.
 *
 * Limits: no ray meets a second wave. Reflections show the sky and the pool's dry walls, but no
 * surroundings. Interreflection is left out between parts of the ground, and between the ground and
 * the surface above it; to make up for that, radiance is not divided by the squared index where
 * light leaves the water. The eye must be above the water.
 *
 * Ice that floats in the pool (pool.ice) is drawn above the water. Rays below the water meet it in
 * the maps of ice_normal.c in the eye's view, bent by air and water at rest. The limits are those
 * of refract_bounce.c, and: there is no dispersion; the ice reflects only the sky and the dry
 * walls; the water does not reflect the ice; no ray meets the ice twice; the ice changes neither
 * the sun's light nor the waves.
 */
#include "shaders/water.h"
#include "shaders/embedded.h"
#include "src/tech/caustics.h"
#include "src/tech/frame.h"
#include "src/tech/gbuffer.h"
#include "src/tech/ice_normal.h"
#include "src/tech/pool.h"
#include "src/tech/refract.h"
#include "src/tech/row_builder.h"

static rg_record_fn record_surface, record_ice;

static const struct rg_use surface_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_environment, WATER_ENVIRONMENT, .sampler = &frame_environment_sampler),
    { 0 },
};

static const struct rg_use caustics_uses[] = {
    FRAME_SAMPLE(caustics_light, WATER_CAUSTICS, .sampler = &frame_linear),
    { 0 },
};

/* The maps in which shaders/refract_inside.glsl searches the ice. */
static const struct rg_use ice_uses[] = {
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT),
    { 0 },
};

static const struct rg_pass gbuffer_row = {
    .name = "water.gbuffer",
    .color = RG_TARGETS({ &gbuffer_normal, RG_LOAD_KEEP }, { &gbuffer_position, RG_LOAD_KEEP }),
    .depth = { &gbuffer_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .uses = RG_USES(FRAME_USE_GLOBALS),
    .vert = &water_vert,
    .frag = &water_gbuffer_frag,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

static const struct rg_pass color_row = {
    .name = "water.color",
    .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .vert = &water_vert,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

/* Draws the part of the ice above the water. */
static const struct rg_pass ice_row = {
    .name = "water.ice",
    .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .vert = &refract_vert,
    .vertices = &frame_mesh_layout,
    .cull = VK_CULL_MODE_BACK_BIT,
    .push_size = sizeof(struct water_push),
    .record = record_ice,
};

static const struct rg_pass layers_row = {
    .name = "water.layers",
    .color = RG_TARGETS({ &caustics_seen, RG_LOAD_CLEAR }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_read_only = true,
    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
    .vert = &water_vert,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

enum {
    ROW_COUNT = 4
};

/* Shaders for water without and with ice, without and with caustics. */
static const struct rg_shader *const color_frags[2][2] = {
    { &water_frag, &water_caustics_frag },
    { &water_iced_frag, &water_iced_caustics_frag },
};
static const struct rg_shader *const ice_frags[2] = { &water_ice_frag, &water_ice_caustics_frag };
static const struct rg_shader *const layers_frags[2] = {
    &water_caustics_aov_frag,
    &water_iced_caustics_aov_frag,
};

static struct rg_technique make_rows(const struct technique_choice *choice,
                                     struct row_builder *builder)
{
    const bool lit = caustics_are_lit(choice->settings);
    const bool iced = pool_has_ice(choice->settings);
    const struct rg_use *const lists[] = { surface_uses, lit ? caustics_uses : NULL,
                                           iced ? ice_uses : NULL };
    const struct rg_use *uses = row_builder_uses(builder, lists, 3);
    struct rg_pass *rows = row_builder_alloc(builder, ROW_COUNT * sizeof(*rows));
    if (!rows)
        return (struct rg_technique){ 0 };
    struct rg_pass *row = rows;
    *row++ = gbuffer_row;
    *row = color_row;
    row->uses = uses;
    row++->frag = color_frags[iced][lit];
    if (iced) {
        *row = ice_row;
        row->uses = uses;
        row++->frag = ice_frags[lit];
    }
    if (lit) {
        *row = layers_row;
        row->uses = uses;
        row++->frag = layers_frags[iced];
    }
    return (struct rg_technique){ "water", rows, (size_t)(row - rows) };
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

const struct technique water = {
    .name = "water",
    .help = "pool of water and the ground below it",
    .parts = { { PHASE_REFRACTION, SCENE_OF_POOL, .rows = make_rows } },
};
