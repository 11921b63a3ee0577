/* ice_caustics_ground_depth.vert: vertex shader of the light-space depth of ground behind the ice.
 */
#version 460
#include "lib/object_pose.glsl"
#include "lib/sun_light_space.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_MATERIAL) in uint material;

layout(location = 0) out vec3 out_point;

void main()
{
    out_point = pose_surroundings(position, material);
    gl_Position = ice_light_clip(out_point);
}
