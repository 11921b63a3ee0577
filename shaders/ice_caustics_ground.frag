#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/ice_light.glsl"

layout(set = 0, binding = ICE_CAUSTICS_FRONT) uniform sampler2D front;

layout(location = 0) in vec3 point;

/* Ground is all surfaces behind the front of the ice, which excludes roofs above it. */
void main()
{
    vec4 clip = ice_light_clip(point);
    if (clip.w < light.front || ice_light_is_before(front, clip))
        discard;
}
