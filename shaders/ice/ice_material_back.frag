/* ice_material_back.frag: fragment shader of the G-buffer of textured ice's back faces. */
#version 460
#include "ice/ice_textured.glsl"

layout(location = 0) out vec4 back;          /* outward unit normal, world; w: 1 */
layout(location = 1) out vec4 material_back; /* surface transmittance; a: roughness */

void main()
{
    vec3 mapped_n;
    object_material material = ice_material_at(mapped_n);
    back = vec4(mapped_n, 1.0);
    material_back = vec4(material.tint * (1.0 - material.opacity), material.roughness);
}
