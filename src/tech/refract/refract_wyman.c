/*
 * refract_wyman.c: refraction model of Wyman 2005: exit point estimated from two thicknesses.
 *
 * An Approximate Image-Space Approach for Interactive Refraction: the path length inside is
 * interpolated between the thickness along the unrefracted ray and that along the front normal, by
 * the ratio of the angles of refraction and incidence. Light is refracted again by the back normal
 * of the pixel in which the path ends. Wyman precomputes the thickness along the normal per vertex;
 * here it is the distance to the back face visible where a slab would end.
 *
 * Error: 7 degrees on average on a sphere, 2 to 3 on cubes, 11 on a teapot
 * (docs/explanation/truth.md).
 * Totally reflected light leaves in the direction of its first reflection.
 */
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/refract/refract.h"

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    { 0 },
};

static const struct refract_shaders refraction = {
    REFRACT_FRAGS(refract_wyman),
    .uses = uses,
};

const struct technique refract_wyman = {
    .name = "refract_wyman",
    .help = "two refractions; the exit point is estimated from two thicknesses (Wyman 2005)",
    .pass_groups = REFRACT_PASS_GROUPS,
    /* reach: lookups extend one diameter beyond the object, 3 radii from its centre */
    .refraction = { .name = "wyman", .shaders = &refraction, .reach = 3.0f },
};
