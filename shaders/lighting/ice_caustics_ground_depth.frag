/* ice_caustics_ground_depth.frag: fragment shader of the light-space depth of ground behind the
 * ice. */
#version 460
#include "lib/sun_light_space.glsl"

layout(set = 0, binding = ICE_CAUSTICS_FRONT) uniform sampler2D front;

layout(location = 0) in vec3 point;

/* Discards surfaces between the sun and the ice, so that roofs do not count as ground. */
void main()
{
    vec4 clip = ice_light_clip(point);
    if (clip.w < light.front || ice_light_is_before(front, clip))
        discard;
}
