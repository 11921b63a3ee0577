/* gbuffer_position.frag: position of the visible surface, from its depth and the primary ray. */
#version 460
#include "lib/primary_ray.glsl"
#include "output/gbuffer.h"

layout(set = 0, binding = GBUFFER_NORMAL) uniform sampler2D normals;

layout(location = 0) out vec4 out_position; /* w: distance from the camera */

void main()
{
    float depth = texelFetch(normals, ivec2(gl_FragCoord.xy), 0).w;
    vec3 ray = primary_ray(gl_FragCoord.xy / vec2(textureSize(normals, 0)) * 2.0 - 1.0);
    vec3 eye_to_surface = primary_ray_at(ray, depth);
    out_position = vec4(frame.eye + eye_to_surface, length(eye_to_surface));
    if (depth == GBUFFER_NOTHING)
        out_position = vec4(vec3(0.0), GBUFFER_NOTHING);
}
