/*
 * refract_wyman.c: the exit guessed from two thicknesses.
 *
 * Wyman 2005, An Approximate Image-Space Approach for Interactive Refraction: the way inside is
 * between the thickness along the straight ray and the one along the front normal, mixed by the
 * ratio of the angles of refraction and incidence; the back normal is that of the pixel where it
 * ends, and light is bent again there. He has the thickness along the normal computed before, at
 * each vertex; here it is that to the back face seen where a slab would end.
 *
 * Error: 7 degrees on average on a sphere, 2 to 3 on cubes, 11 on a teapot (docs/truth.md). What is
 * totally reflected leaves in the direction of its first reflection.
 */
#include "src/tech/refract_wyman.h"
#include "shaders/embedded.h"
#include "src/tech/bump.h"
#include "src/tech/frame.h"
#include "src/tech/refract.h"

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS, REFRACT_USE_ENV_CUBE, REFRACT_USE_NORMAL_BACK, REFRACT_USE_DEPTH_BACK, { 0 },
};

static const struct rg_use bumped_uses[] = {
    FRAME_USE_GLOBALS,      REFRACT_USE_ENV_CUBE, REFRACT_USE_NORMAL_BACK,
    REFRACT_USE_DEPTH_BACK, BUMP_USE_MAP,         { 0 },
};

static const struct rg_pass passes[] = {
    REFRACT_ROWS(wyman, , REFRACT_FRONT_FACES, .uses = uses, .record = frame_draw_object),
};

static const struct rg_pass bumped_passes[] = {
    REFRACT_ROWS(wyman, _bump, REFRACT_BUMPED_FACES, .uses = bumped_uses,
                 .record = frame_draw_object),
};

const struct technique refract_wyman[] =
    REFRACT_TECHNIQUES("refract_wyman", passes,
                       .help = "two bends, the exit guessed from two thicknesses (Wyman 2005)");

const struct technique refract_wyman_bumped[] =
    REFRACT_TECHNIQUES("refract_wyman", bumped_passes, .help = "the same with bumps");
