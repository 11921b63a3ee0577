/*
 * refract_per_vertex.c: refraction model with directions computed at the vertices.
 *
 * Environment mapping as commonly taught (after The Cg Tutorial, chapter 7): one refraction at the
 * front, with reflected and refracted direction interpolated between vertices. The cross-fade of
 * reflection and refraction of such courses is refract.fresnel=crossfade.
 *
 * Error: that of refract_one_sided.c and, for large triangles, of the interpolation. Bumps are
 * finer than vertices and are ignored.
 */
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/refract/refract.h"

static const struct rg_use uses[] = {
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear),
    { 0 },
};

static const struct refract_shaders refraction = {
    .frag = &refract_per_vertex_frag,
    .layers_frag = &refract_per_vertex_aov_frag,
    .material_frag = &refract_per_vertex_material_frag,
    .material_layers_frag = &refract_per_vertex_material_aov_frag,
    .vert = &refract_per_vertex_vert,
    .uses = uses,
};

const struct technique refract_per_vertex = {
    .name = "refract_per_vertex",
    .help = "refraction at the front face only, with directions computed at the vertices",
    .pass_groups = REFRACT_PASS_GROUPS,
    .refraction = { .name = "per-vertex", .shaders = &refraction },
};
