/*
 * refract_slab.c: each pixel as if it were one of a window pane.
 *
 * A slab that is parallel to the front face, as thick as the straight ray finds the ice: light
 * leaves as it came, moved aside. Exact for a pane; of an environment at infinity it shows nothing
 * but what is behind the ice (but see refract.lookup).
 *
 * Error: all of the deviation, wherever the back is not parallel to the front.
 */
#include "src/tech/refract_slab.h"
#include "shaders/embedded.h"
#include "src/tech/bump.h"
#include "src/tech/frame.h"
#include "src/tech/refract.h"

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    REFRACT_USE_ENV_CUBE,
    REFRACT_USE_DEPTH_BACK_HERE,
    { 0 },
};

static const struct rg_use bumped_uses[] = {
    FRAME_USE_GLOBALS, REFRACT_USE_ENV_CUBE, REFRACT_USE_DEPTH_BACK_HERE, BUMP_USE_MAP, { 0 },
};

static const struct rg_pass passes[] = {
    REFRACT_ROWS(slab, , REFRACT_FRONT_FACES, .uses = uses, .record = frame_draw_object),
};

static const struct rg_pass bumped_passes[] = {
    REFRACT_ROWS(slab, _bump, REFRACT_BUMPED_FACES, .uses = bumped_uses,
                 .record = frame_draw_object),
};

const struct technique refract_slab[] = REFRACT_TECHNIQUES(
    "refract_slab", passes,
    .help = "a pane parallel to the front face: light is moved aside, not turned");

const struct technique refract_slab_bumped[] =
    REFRACT_TECHNIQUES("refract_slab", bumped_passes, .help = "the same with bumps");
