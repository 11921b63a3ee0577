/* water_gbuffer.frag: fragment shader of the G-buffer of the water surface: normal and position. */
#version 460
#include "lib/pool_walls.glsl"
#include "water/wave_function.h"

layout(push_constant, scalar) uniform Push
{
    water_push push;
};

layout(location = 0) in vec3 point;       /* pool coordinates */
layout(location = 0) out vec4 out_normal; /* w: distance along the view axis */

void main()
{
    vec3 n = wave_normal(wave_at(push.water, point.xy, frame.time));
    vec3 position = pool_to_world(point);
    out_normal = vec4(pool_to_world(n), dot(position - frame.eye, frame.forward));
}
