/*
 * refract_sphere.c: refraction model that treats the ice in each pixel as a sphere.
 *
 * A sphere that touches the front face replaces the object, as in most renderers that only know
 * front faces: exact directions for light through a sphere of any radius. The radius, half the edge
 * of a cube with the object's diagonal, determines length and end of the path.
 *
 * Error: 0.1 degrees on average on a triangulated sphere, 11 on cubes (docs/truth.md). A sphere
 * never totally reflects light that has entered it; two fifths of the first inner surfaces of those
 * cubes do.
 */
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/refract/refract.h"

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    { 0 },
};

static const struct refract_shaders refraction = {
    .frag = &refract_sphere_frag,
    .layers_frag = &refract_sphere_aov_frag,
    .material_frag = &refract_sphere_material_frag,
    .material_layers_frag = &refract_sphere_material_aov_frag,
    .bump_frag = &refract_sphere_bump_frag,
    .bump_layers_frag = &refract_sphere_bump_aov_frag,
    .uses = uses,
};

const struct technique refract_sphere = {
    .name = "refract_sphere",
    .help = "two refractions; the object is treated as a sphere that touches the front face",
    .pass_groups = REFRACT_PASS_GROUPS,
    .refraction = { .name = "sphere", .shaders = &refraction, .choose = refract_choose },
};
