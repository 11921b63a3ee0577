/* sun_shadow_map.vert: vertex shader of the sun's shadow map. */
#version 460
#include "lib/object_pose.glsl"
#include "lib/sun_light_space.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(location = 0) out vec2 out_uv;
layout(location = 1) flat out uint out_material;

void main()
{
    gl_Position = ice_light_shadow_map_clip(ice_light_clip(pose_surroundings(position, material)));
    out_uv = uv;
    out_material = material;
}
