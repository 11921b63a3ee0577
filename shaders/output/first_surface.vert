/* first_surface.vert: vertex shader of the albedo and motion layers (AOVs). */
#version 460
#include "lib/object_pose.glsl"
#include "output/first_surface.h"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_COLOR) in vec3 color;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(set = 0, binding = FIRST_SURFACE_PREVIOUS, scalar) uniform Previous
{
    first_surface_previous previous;
};

layout(set = 0, binding = FIRST_SURFACE_POSITIONS) uniform sampler2D positions;

layout(push_constant, scalar) uniform Push
{
    first_surface_push push;
};

layout(location = 0) out vec3 out_color;
layout(location = 1) out vec2 out_uv;
layout(location = 2) flat out uint out_material;
layout(location = 3) out vec4 out_now;
layout(location = 4) out vec4 out_previous;

vec3 previous_position()
{
    int at = int(push.first) + gl_VertexIndex;
    if (textureSize(positions, 0).x != FIRST_SURFACE_WIDTH)
        return position;
    ivec2 texel = ivec2(at % FIRST_SURFACE_WIDTH, at / FIRST_SURFACE_WIDTH);
    return texelFetch(positions, texel, 0).xyz;
}

void main()
{
    bool object = push.object != 0u;
    bool moves = (material & MESH_ORBITS) != 0u;
    vec4 old_point = vec4(previous_position(), 1.0);
    if (object)
        old_point = previous.world_from_object * old_point;
    else if (moves)
        old_point = previous.world_from_movers * old_point;
    vec3 point = object ? pose_object(position) : pose_surroundings(position, material);
    out_color = color;
    out_uv = uv;
    out_material = material;
    out_now = frame.clip_from_world * vec4(point, 1.0);
    out_previous = previous.clip_from_world * old_point;
    gl_Position = out_now;
}
