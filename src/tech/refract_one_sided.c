/*
 * refract_one_sided.c: the environment, refracted at the front face as if the ice never ended.
 *
 * The plain environment mapping that Seipel and Nivfors 2006 start from (section 3.2): eq. 2 with
 * the front normal alone, eq. 3, 4 and 6 as in their method.
 *
 * Error: for an ice sphere half of the true deviation; 11 to 15 degrees on average elsewhere
 * (docs/truth.md).
 */
#include "src/tech/refract_one_sided.h"
#include "shaders/embedded.h"
#include "src/tech/bump.h"
#include "src/tech/frame.h"
#include "src/tech/refract.h"

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    REFRACT_USE_ENV_CUBE,
    { 0 },
};

static const struct rg_use bumped_uses[] = {
    FRAME_USE_GLOBALS,
    REFRACT_USE_ENV_CUBE,
    BUMP_USE_MAP,
    { 0 },
};

static const struct rg_pass passes[] = {
    REFRACT_ROWS(one_sided, , REFRACT_FRONT_FACES, .uses = uses, .record = frame_draw_object),
};

static const struct rg_pass bumped_passes[] = {
    REFRACT_ROWS(one_sided, _bump, REFRACT_BUMPED_FACES, .uses = bumped_uses,
                 .record = frame_draw_object),
};

const struct technique refract_one_sided[] =
    REFRACT_TECHNIQUES("refract_one_sided", passes, .help = "refraction at the front face alone");

const struct technique refract_one_sided_bumped[] =
    REFRACT_TECHNIQUES("refract_one_sided", bumped_passes, .help = "the same with bumps");
