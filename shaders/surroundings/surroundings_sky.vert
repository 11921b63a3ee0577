/* surroundings_sky.vert: vertex shader of the background: full-screen triangle at depth 0, which
 * is infinitely far away. */
#version 460
#include "lib/specialization_constants.glsl"
#include "surroundings/surroundings.h"

layout(push_constant, scalar) uniform Push
{
    surroundings_push push;
};

layout(location = 0) out vec3 dir; /* not normalised; linear in screen space */

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    dir = push.forward;
    if (constant_orthographic == 0u || push.inverse != 0u)
        dir += corner.x * push.right - corner.y * push.up;
}
