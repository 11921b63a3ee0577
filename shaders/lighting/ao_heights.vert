/* ao_heights.vert: vertex shader of the height maps of the surroundings, for ambient occlusion. */
#version 460
#include "lib/object_pose.glsl"
#include "lighting/ao.h"

layout(set = 0, binding = AO_BINDING, scalar) uniform Occluders
{
    ao_occluders ao;
};

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_MATERIAL) in uint material;

/* Projects the surroundings orthographically from above, onto the occlusion map's square. Clamps
 * heights to the map's maximum. Geometry below the objects' base is clipped. */
void main()
{
    vec3 off = pose_surroundings(position, material) - ao.center;
    float depth = off.y / (AO_HEIGHTS_RANGE * ao.height) - AO_HEIGHTS_GAP;
    gl_Position = vec4(off.xz / ao.half_side, min(depth, 1.0), 1.0);
}
