/* vertex_tangent_uv1.glsl: tangent and second uv of surroundings (struct mesh_extra). */
#ifndef VERTEX_TANGENT_UV1_GLSL
#define VERTEX_TANGENT_UV1_GLSL
#include "mesh_layout.h"
#include "surroundings/surroundings.h"

layout(set = 0, binding = SURROUNDINGS_EXTRAS) uniform sampler2D extras;

/* Returns texel `index` of the current vertex's struct mesh_extra. */
vec4 vertex_extra_texel(int index)
{
    int at = gl_VertexIndex * MESH_EXTRA_TEXELS + index;
    return texelFetch(extras, ivec2(at % MESH_EXTRA_WIDTH, at / MESH_EXTRA_WIDTH), 0);
}
#endif
