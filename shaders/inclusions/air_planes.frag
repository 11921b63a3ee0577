/* air_planes.frag: fragment shader that writes the opacity of milky air, drawn as textured planes.
 */
#version 460
#include "ice/ice_depth.h"
#include "inclusions/air_planes.h"
#include "lib/globals.glsl"
#include "lib/primary_ray.glsl"
#include "lib/specialization_constants.glsl"

layout(set = 0, binding = AIR_LAYERS) uniform sampler2DArray layers;

layout(set = 0, binding = ICE_DEPTH_FRONT) uniform sampler2D ice_front;

layout(push_constant, scalar) uniform Push
{
    air_push push;
};

layout(location = 0) in vec3 uv;
layout(location = 1) in vec3 eye_to_point;
layout(location = 2) in vec3 normal;

layout(location = 0) out vec4 cover; /* r: combined opacity; a: for blending */

void main()
{
    vec2 texel = texture(layers, uv).rg;
    if (constant_tiled != 0u)
        texel = texture(layers, uv, frame.lod_bias).rg;
    if (gl_FragCoord.z < texelFetch(ice_front, ivec2(gl_FragCoord.xy), 0).r)
        discard;
    texel *= smoothstep(0.0, AIR_EDGE, abs(dot(primary_ray_dir(eye_to_point), normal)));
    float clear = (1.0 - push.strength * texel.r) * (1.0 - push.haze * texel.g);
    cover = vec4(1.0 - clear);
}
