/*
 * refract_paper.c: refraction model of Seipel and Nivfors 2006: blended front and back normals.
 *
 * Section 3.2, faithfully: eq. 1 with outward normals and a = 0.33, not normalised; eq. 2 with the
 * blended normal, eq. 3 with the front normal, eq. 4 in the vertex shader, eq. 6.
 *
 * Error: outward normals make eq. 1 average two normals that face the viewer, which deflects less
 * than one interface, where two real ones deflect twice: an ice sphere at impact parameter 0.6
 * shows 3.3 degrees, one interface 9.6, the truth 19.2. Convex objects only: of a concave one, only
 * one front and one back face are known.
 */
#include "src/tech/refract/refract_paper.h"
#include "shaders/embedded.h"
#include "shaders/refract/refract_paper.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/refract/refract.h"

static rg_record_fn record_object;

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_same_texel),
    { 0 },
};

static const struct refract_shaders refraction = {
    REFRACT_FRAGS(refract_paper),
    .uses = uses,
    .push_size = sizeof(struct refract_paper_params),
    .record = record_object,
};

static void record_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_paper_settings),
                sizeof(struct refract_paper_params));
    frame_draw_object(cmd, frame);
}

static const struct setting rows[] = {
    {
        SETTING_FIELD("refract_paper.back_weight", FLOAT, struct refract_paper_params, a),
        .renamed_from = "refract_paper.a",
        .label = "Back-face normal weight (paper)",
        .initial = 0.33,
        .max = 1.0,
        .help = "weight of the back face's normal (Seipel and Nivfors, eq. 1)",
    },
};

SETTING_GROUP(refract_paper, rows, struct refract_paper_params);

const struct technique refract_paper = {
    .name = "refract_paper",
    .help = "refraction by blended front and back normals (Seipel and Nivfors 2006)",
    .settings = &refract_paper_settings,
    .pass_groups = REFRACT_PASS_GROUPS,
    .refraction = { .name = "paper", .shaders = &refraction },
};
