/*
 * refract_slab.c: refraction model that treats the ice in each pixel as a window pane.
 *
 * The slab is parallel to the front face and as thick as the ice along the unrefracted ray: light
 * leaves in its original direction, displaced. Exact for a pane. An environment at infinity
 * therefore appears undistorted (but see refract.lookup).
 *
 * Error: all of the deviation, wherever the back is not parallel to the front.
 */
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/refract/refract.h"

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    FRAME_SAMPLE(ice_normal_back_depth, REFRACT_DEPTH_BACK, .same_texel = true),
    { 0 },
};

static const struct refract_shaders refraction = {
    .frag = &refract_slab_frag,
    .layers_frag = &refract_slab_aov_frag,
    .material_frag = &refract_slab_material_frag,
    .material_layers_frag = &refract_slab_material_aov_frag,
    .bump_frag = &refract_slab_bump_frag,
    .bump_layers_frag = &refract_slab_bump_aov_frag,
    .uses = uses,
};

const struct technique refract_slab = {
    .name = "refract_slab",
    .help = "refraction as by a window pane: light is displaced without changing its direction",
    .pass_groups = REFRACT_PASS_GROUPS,
    .refraction = { .name = "slab", .shaders = &refraction, .choose = refract_choose },
};
