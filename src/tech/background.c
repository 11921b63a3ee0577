/*
 * background.c: the surroundings, and behind them the sky or environment picture.
 *
 * Drawn after the ice, if there is one: what it hides costs a depth test and no more.
 */
#include "src/tech/background.h"
#include "shaders/embedded.h"
#include "src/tech/frame.h"
#include "src/tech/ice_caustics.h"

static rg_record_fn record_surroundings, record_sky;

const struct rg_image background_color = {
    .name = "background.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image background_depth = {
    .name = "background.depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

const struct rg_use background_sky_uses[] = {
    FRAME_USE_GLOBALS,
    {
        .image = &frame_environment,
        .access = RG_SAMPLED,
        .binding = BACKGROUND_ENVIRONMENT,
        .sampler = &frame_environment_sampler,
    },
    { 0 },
};

#define USE_TEXTURES \
    { \
        .image = &frame_textures, .access = RG_SAMPLED, .binding = BACKGROUND_TEXTURES, \
        .sampler = &frame_texture_sampler \
    }

const struct rg_use background_uses[] = { FRAME_USE_GLOBALS, USE_TEXTURES, { 0 } };

const struct rg_use background_shine_uses[] = {
    FRAME_USE_GLOBALS,
    USE_TEXTURES,
    ICE_CAUSTICS_USES,
    { 0 },
};

#define SURROUNDINGS_ROW(...) \
    { \
        .name = "background.surroundings", .record = record_surroundings, __VA_ARGS__ \
    }

#define ONTO_THE_ICE \
    .color = RG_TARGETS({ &background_color, RG_LOAD_KEEP }), \
    .depth = { &background_depth, RG_LOAD_KEEP }

#define SKY_ROW \
    { \
        .name = "background.sky", BACKGROUND_SKY(&background_color, &background_depth), \
        .record = record_sky \
    }

static const struct rg_pass passes[] = {
    SURROUNDINGS_ROW(BACKGROUND_SURROUNDINGS(&background_color, &background_depth)),
    SKY_ROW,
};

static const struct rg_pass around_passes[] = {
    SURROUNDINGS_ROW(ONTO_THE_ICE, BACKGROUND_PLAIN),
    SKY_ROW,
};

static const struct rg_pass around_shine_passes[] = {
    SURROUNDINGS_ROW(ONTO_THE_ICE, BACKGROUND_SHINING),
    SKY_ROW,
};

static void record_sky(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->view, sizeof(frame->view));
    rg_cmd_draw(cmd, 3);
}

static void record_surroundings(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->view, sizeof(frame->view));
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

const struct technique background = {
    .graph = RG_TECHNIQUE("background", passes),
    .help = "sky or environment picture, and the surroundings",
};

const struct technique background_around = {
    .graph = RG_TECHNIQUE("background", around_passes),
    .help = "the same around the ice",
};

const struct technique background_around_shine = {
    .graph = RG_TECHNIQUE("background", around_shine_passes),
    .help = "the same with light that comes through the ice",
};
