/*
 * refract_one_sided.c: refraction model with one refraction, at the front face.
 *
 * Plain environment mapping, from which Seipel and Nivfors 2006 start (section 3.2): eq. 2 with the
 * front normal alone, eq. 3, 4 and 6 as in their method.
 *
 * Error: for an ice sphere half of the true deviation; 11 to 15 degrees on average elsewhere
 * (docs/explanation/truth.md).
 */
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/refract/refract.h"

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    { 0 },
};

static const struct refract_shaders medium_shaders = {
    .frag = &refract_one_sided_medium_frag,
    .layers_frag = &refract_one_sided_medium_aov_frag,
    .bump_frag = &refract_one_sided_bump_medium_frag,
    .bump_layers_frag = &refract_one_sided_bump_medium_aov_frag,
    .material_frag = &refract_one_sided_material_medium_frag,
    .material_layers_frag = &refract_one_sided_material_medium_aov_frag,
};

static const struct refract_shaders refraction = {
    REFRACT_FRAGS(refract_one_sided),
    .medium_shaders = &medium_shaders,
    .uses = uses,
};

const struct technique refract_one_sided = {
    .name = "refract_one_sided",
    .help = "refraction at the front face only",
    .pass_groups = REFRACT_PASS_GROUPS,
    .refraction = { .name = "one-sided", .shaders = &refraction },
};
