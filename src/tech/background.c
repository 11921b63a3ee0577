/*
 * background.c: sky or environment picture, and before it the surroundings.
 */
#include "src/tech/background.h"
#include "shaders/embedded.h"
#include "src/frame.h"

static rg_record_fn record_sky, record_surroundings;

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

const struct rg_use background_uses[] = {
    FRAME_USE_GLOBALS,
    {
        .image = &frame_textures,
        .access = RG_SAMPLED,
        .binding = BACKGROUND_TEXTURES,
        .sampler = &frame_texture_sampler,
    },
    { 0 },
};

static const struct rg_pass passes[] = {
    {
        .name = "background.sky",
        .color[0] = { &background_color, RG_LOAD_DISCARD },
        BACKGROUND_SKY,
        .record = record_sky,
    },
    {
        .name = "background.surroundings",
        .color[0] = { &background_color, RG_LOAD_KEEP },
        .depth = { &background_depth, RG_LOAD_CLEAR }, /* 0 is infinity */
        BACKGROUND_SURROUNDINGS,
        .record = record_surroundings,
    },
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
