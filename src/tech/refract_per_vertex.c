/*
 * refract_per_vertex.c: reflected and refracted directions computed at the vertices.
 *
 * Environment mapping as lectures teach it (after The Cg Tutorial, chapter 7): one bend at the
 * front, both directions interpolated between vertices. A lecture's cross-fade of reflection and
 * refraction is refract.fresnel=crossfade.
 *
 * Error: that of refract_one_sided.c and, where triangles are large, of interpolation. It has no
 * bumps: they are finer than vertices.
 */
#include "src/tech/refract_per_vertex.h"
#include "shaders/embedded.h"
#include "src/tech/frame.h"
#include "src/tech/refract.h"

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    REFRACT_USE_ENV_CUBE,
    { 0 },
};

static const struct rg_pass passes[] = {
    REFRACT_ROWS(per_vertex, , .vert = &refract_per_vertex_vert, .vertices = &frame_mesh_layout,
                 .cull = VK_CULL_MODE_BACK_BIT, .uses = uses, .record = frame_draw_object),
};

const struct technique refract_per_vertex[] = REFRACT_TECHNIQUES(
    "refract_per_vertex", passes, .help = "one-sided, with directions computed at the vertices");
