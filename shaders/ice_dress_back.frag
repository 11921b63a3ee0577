#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice_dress.glsl"

layout(location = 0) out vec4 back;       /* xyz: outward unit normal, world; w: 1 */
layout(location = 1) out vec4 dress_back; /* rgb: transmittance of the surface; a: roughness */

void main()
{
    vec3 bent;
    dress own = ice_dress_at(bent);
    back = vec4(bent, 1.0);
    dress_back = vec4(own.tint * (1.0 - own.shine), own.roughness);
}
