/* fullscreen_ray.vert: vertex shader of a full-screen triangle with primary rays. */
#version 460
#include "lib/primary_ray.glsl"
#include "refract/refract.h"

layout(location = REFRACT_VIEW_RAY) out vec3 out_view_ray;

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    out_view_ray = primary_ray(corner);
}
