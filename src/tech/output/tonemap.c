/*
 * tonemap.c: applies exposure, tone curve and sRGB encoding, for PNG files and windows.
 *
 * Curve "neutral": Khronos PBR Neutral (Khronos Group 2024), which preserves base colours. Curve
 * "agx": for images that show the sun (Sobotka 2022). Curves "aces" and "hable": widely used
 * alternatives (Hill 2016; Hable 2010). Curve "clip": encoding only, for measurements.
 */
#include "src/tech/output/tonemap.h"
#include <math.h>
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/specialization_constants.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"

static rg_record_fn record_screen;

static const struct rg_pass passes[] = {
    {
        .name = "tonemap.screen",
        .color = RG_TARGETS({ &frame_display, RG_LOAD_DISCARD }),
        .uses = RG_USES(FRAME_SAMPLE(frame_color, TONEMAP_COLOR, .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &tonemap_frag,
        .push_size = sizeof(struct tonemap_params),
        .record = record_screen,
    },
};

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct tonemap_params push = tonemap_params_of(frame->settings);
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
}

static const char *const curves[] = {
    [TONEMAP_NEUTRAL] = "neutral", [TONEMAP_CLIP] = "clip",   [TONEMAP_AGX] = "agx",
    [TONEMAP_ACES] = "aces",       [TONEMAP_HABLE] = "hable", NULL,
};

static const char *const resolves[] = {
    [TONEMAP_RESOLVE_WEIGHTED] = "weighted",
    [TONEMAP_RESOLVE_LINEAR] = "linear",
    [TONEMAP_RESOLVE_FILTERED] = "filtered",
    NULL,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("tonemap.exposure", FLOAT, struct tonemap_values, exposure),
        .label = "Exposure",
        .min = -16,
        .max = 16,
        .unit = "stops",
        .help = "exposure of PNG images",
    },
    {
        SETTING_FIELD("tonemap.curve", CHOICE, struct tonemap_values, curve),
        .label = "Tone curve",
        .initial = TONEMAP_NEUTRAL,
        .max = TONEMAP_LAST,
        .choices = curves,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "tone mapping curve of PNG images",
    },
    {
        SETTING_FIELD("tonemap.dither", SWITCH, struct tonemap_values, dither),
        .label = "Dither 8-bit images",
        .max = 1,
        .help = "dither 8-bit PNG files with noise of one step, which hides banding",
    },
    {
        SETTING_FIELD("tonemap.resolve", CHOICE, struct tonemap_values, resolve),
        .label = "Sample mean",
        .max = TONEMAP_RESOLVE_FILTERED,
        .choices = resolves,
        .help = "mean of samples in PNG files and windows: weighted (by 1/(1+luminance), which "
                "antialiases edges of highlights), filtered (weighted, over pixels and their "
                "neighbours; noisy pixels are averaged with similar neighbours) or linear; EXR "
                "files are always linear",
    },
};

SETTING_GROUP(tonemap, rows, struct tonemap_values);

struct tonemap_params tonemap_params_of(const struct settings *settings)
{
    const struct tonemap_values *values = settings_of(settings, &tonemap_settings);
    return (struct tonemap_params){ .gain = exp2f(values->exposure), .curve = values->curve };
}

bool tonemap_params_equal(const struct tonemap_params *a, const struct tonemap_params *b)
{
    /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): counts members that are added later */
    return !memcmp(a, b, sizeof(*a));
}

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    values[CONSTANT_TONEMAP_CURVE] = tonemap_params_of(config->settings).curve;
}

const struct technique tonemap = {
    .name = "tonemap",
    .help = "tone mapping of linear colour to 8-bit sRGB",
    .settings = &tonemap_settings,
    .pass_groups = { { PHASE_DISPLAY, SCENE_OF_ANY,
                       .purposes = 1u << TECHNIQUE_IMAGE | 1u << TECHNIQUE_RESOLVE,
                       .graph = RG_TECHNIQUE("tonemap", passes) } },
    .write_constants = write_constants,
};
