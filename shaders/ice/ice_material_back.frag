#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice/ice_material.glsl"

layout(location = 0) out vec4 back;          /* xyz: outward unit normal, world; w: 1 */
layout(location = 1) out vec4 material_back; /* rgb: transmittance of the surface; a: roughness */

void main()
{
    vec3 bent;
    object_material own = ice_material_at(bent);
    back = vec4(bent, 1.0);
    material_back = vec4(own.tint * (1.0 - own.opacity), own.roughness);
}
