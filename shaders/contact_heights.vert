#version 460
#extension GL_GOOGLE_include_directive : require
#include "contact.h"
#include "lib/pose.glsl"

layout(set = 0, binding = CONTACT_BINDING, scalar) uniform Contact
{
    contact_bodies contact;
};

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_MATERIAL) in uint material;

/* Projects the surroundings orthographically from above, over the square of the map. Heights are
 * clamped to the maximum; what lies below the plane of the objects' base is clipped. */
void main()
{
    vec3 off = pose_surroundings(position, material) - contact.middle;
    float depth = off.y / (CONTACT_HIGH * contact.height) - CONTACT_GAP;
    gl_Position = vec4(off.xz / contact.half_side, min(depth, 1.0), 1.0);
}
