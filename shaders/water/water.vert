/* water.vert: vertex shader of the water surface, a grid displaced by waves. */
#version 460
#include "lib/grid_strip.glsl"
#include "lib/pool_walls.glsl"
#include "water/wave_function.h"

layout(push_constant, scalar) uniform Push
{
    water_push push;
};

layout(location = 0) out vec3 out_point; /* pool coordinates */

void main()
{
    /* `precise`, because the AOV pass tests for equal depth */
    precise vec2 across =
        vec2(grid_strip_corner(uint(gl_VertexIndex), WATER_GRID)) / float(WATER_GRID) - 0.5;
    precise vec2 p = across * push.pool.size;
    precise float height = wave_at(push.water, p, frame.time).z;
    precise vec4 clip = frame.clip_from_world * vec4(pool_to_world(vec3(p, height)), 1.0);
    gl_Position = clip;
    out_point = vec3(p, height);
}
