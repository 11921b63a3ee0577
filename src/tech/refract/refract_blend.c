/*
 * refract_blend.c: refraction model with one blended normal that adds up both deflections.
 *
 * Eq. 1 of Seipel and Nivfors 2006 with the back normal negated and the sum normalised. The two
 * faces of a convex object deflect light to the same side; so does this normal, more than the front
 * normal alone. Near the centre of a sphere a = 0.25 is right; over the whole sphere 0.3 is best.
 *
 * Error: 6 degrees on average on a sphere, 12 on cubes (docs/truth.md): there is still only one
 * refraction, and no total internal reflection. The thickness is unknown: no absorption.
 */
#include "shaders/refract/refract_blend.h"
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/refract/refract.h"

static rg_record_fn record_object;

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear,
                 .same_texel = true),
    { 0 },
};

static const struct refract_shaders refraction = {
    .frag = &refract_blend_frag,
    .layers_frag = &refract_blend_aov_frag,
    .material_frag = &refract_blend_material_frag,
    .material_layers_frag = &refract_blend_material_aov_frag,
    .bump_frag = &refract_blend_bump_frag,
    .bump_layers_frag = &refract_blend_bump_aov_frag,
    .uses = uses,
    .push_size = sizeof(struct refract_blend_params),
    .record = record_object,
};

static const struct setting rows[] = {
    {
        .name = "refract_blend.back_weight",
        .renamed_from = "refract_blend.a",
        .label = "Back-face normal weight (blend)",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct refract_blend_params, a),
        .initial = 0.33,
        .max = 1.0,
        .help = "weight of the back face's normal",
    },
};

SETTING_GROUP(refract_blend, rows, struct refract_blend_params);

static void record_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_blend_settings),
                sizeof(struct refract_blend_params));
    frame_draw_object(cmd, frame);
}

const struct technique refract_blend = {
    .name = "refract_blend",
    .help = "single refraction by a blended normal that adds up the deflections of front and back",
    .settings = &refract_blend_settings,
    .pass_groups = REFRACT_PASS_GROUPS,
    .refraction = { .name = "blend", .shaders = &refraction, .choose = refract_choose },
};
