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
#include "shaders/embedded.h"
#include "src/tech/frame.h"
#include "src/tech/refract.h"

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    { 0 },
};

static const struct refract_rung rung = {
    .frag = &refract_sphere_frag,
    .layers_frag = &refract_sphere_aov_frag,
    .bump_frag = &refract_sphere_bump_frag,
    .bump_layers_frag = &refract_sphere_bump_aov_frag,
    .uses = uses,
};

const struct technique refract_sphere = {
    .name = "refract_sphere",
    .help = "two refractions, as in a sphere that touches the front face",
    .parts = REFRACT_PARTS,
    .rung = { .name = "sphere", .rows = &rung },
};
