/*
 * refract_search.c: refraction model that ray marches to the exit point in image space.
 *
 * The refracted ray is marched until it is behind the back faces, up to the object's bounding
 * sphere; the step that left the object is then refined to where the ray would hit a flat face.
 * There the ray is refracted by the back normal.
 *
 * Error: some hundredths of a degree on average on convex objects in 512 x 512 pixels, growing with
 * pixel size; but totally reflected light leaves in the direction of its first reflection, dozens
 * of degrees off. Of a concave object only the nearest back faces are known.
 */
#include "shaders/embedded.h"
#include "shaders/refract/refract_march.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/refract/refract.h"

static rg_record_fn record_object;

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    { 0 },
};

static const struct refract_shaders refraction = {
    REFRACT_FRAGS(refract_search),
    .uses = uses,
    .push_size = sizeof(struct refract_march),
    .record = record_object,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("refract_search.steps", COUNT, struct refract_march, steps),
        .label = "Ray steps (search)",
        .initial = 8,
        .min = 1,
        .max = 256,
        .help = "maximum number of steps along a ray inside the object",
    },
    {
        SETTING_FIELD("refract_search.bisections", COUNT, struct refract_march, halvings),
        .renamed_from = "refract_search.halvings",
        .label = "Bisections (search)",
        .initial = 8,
        .max = 32,
        .help = "maximum number of bisections where a ray leaves the object; flat faces need fewer",
    },
};

SETTING_GROUP(refract_search, rows, struct refract_march);

static void record_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_search_settings),
                sizeof(struct refract_march));
    frame_draw_object(cmd, frame);
}

const struct technique refract_search = {
    .name = "refract_search",
    .help = "two refractions; the exit point is found by ray marching the depth of back faces",
    .settings = &refract_search_settings,
    .pass_groups = REFRACT_PASS_GROUPS,
    .refraction = { .name = "search", .shaders = &refraction },
};
