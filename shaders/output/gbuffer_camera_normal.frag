/* gbuffer_camera_normal.frag: rotates the normals of the G-buffer to the camera's axes: x to the
 * right, y down, z forward. */
#version 460
#include "lib/globals.glsl"
#include "output/gbuffer.h"

layout(set = 0, binding = GBUFFER_NORMAL) uniform sampler2D normals;

layout(location = 0) out vec4 out_normal;

/* Returns the camera axis of a row of the projection, without the shear of lens and jitter. */
vec3 camera_axis(int row)
{
    mat4 m = frame.clip_from_world;
    vec3 axis = vec3(m[0][row], m[1][row], m[2][row]);
    return normalize(axis - dot(axis, frame.forward) * frame.forward);
}

void main()
{
    vec3 n = texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz;
    out_normal = vec4(dot(n, camera_axis(0)), dot(n, camera_axis(1)), dot(n, frame.forward), 0.0);
}
