/*
 * refract_sphere.c: each pixel as if it were one of a sphere.
 *
 * A sphere that touches the front face stands in for the object, as in most renderers that know
 * only the front: exact for light through a sphere, whatever its radius. The radius counts for the
 * length of the way and where it ends: half the edge of a cube whose diagonal is the object's.
 *
 * Error: 0.1 degrees on average on a sphere of triangles, 11 on cubes (docs/truth.md). A sphere
 * never reflects light totally that came in; two fifths of the first hits inside those cubes do.
 */
#include "src/tech/refract_sphere.h"
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
    REFRACT_ROWS(sphere, , REFRACT_FRONT_FACES, .uses = uses, .record = frame_draw_object),
};

static const struct rg_pass bumped_passes[] = {
    REFRACT_ROWS(sphere, _bump, REFRACT_BUMPED_FACES, .uses = bumped_uses,
                 .record = frame_draw_object),
};

const struct technique refract_sphere[] = REFRACT_TECHNIQUES(
    "refract_sphere", passes, .help = "two bends, as in a sphere that touches the front face");

const struct technique refract_sphere_bumped[] =
    REFRACT_TECHNIQUES("refract_sphere", bumped_passes, .help = "the same with bumps");
