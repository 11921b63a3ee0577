/* composite.vert: vertex shader of compositing. Draws a full-screen triangle and computes milky
 * air's radiance. */
#version 460
#include "lib/milky_air_radiance.glsl"
#include "output/composite.h"

layout(set = 0, binding = COMPOSITE_ENVIRONMENT) uniform sampler2D environment;

layout(location = 0) flat out vec3 out_light;

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    out_light = (constant_composite & COMPOSITE_HAS_AIR) != 0u ? air_light(environment) : vec3(0.0);
}
