/* object_pose.glsl: rotates points and normals of the object and of orbiting surroundings. */
#ifndef OBJECT_POSE_GLSL
#define OBJECT_POSE_GLSL
#include "lib/globals.glsl"
#include "mesh_layout.h"

vec3 pose_object(vec3 position)
{
    return (frame.world_from_object * vec4(position, 1.0)).xyz;
}

vec3 pose_object_normal(vec3 normal)
{
    return mat3(frame.world_from_object) * normal;
}

vec3 pose_to_object(vec3 point)
{
    return transpose(mat3(frame.world_from_object)) * (point - frame.world_from_object[3].xyz);
}

vec3 pose_surroundings(vec3 position, uint material)
{
    bool moves = (material & MESH_ORBITS) != 0u;
    return moves ? (frame.world_from_movers * vec4(position, 1.0)).xyz : position;
}

vec3 pose_surroundings_normal(vec3 normal, uint material)
{
    return (material & MESH_ORBITS) != 0u ? mat3(frame.world_from_movers) * normal : normal;
}
#endif
