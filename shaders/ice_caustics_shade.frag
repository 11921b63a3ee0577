#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/material.glsl"

layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint material;

void main()
{
    bool may_be_hole =
        (constant_textured & CONSTANT_TEXTURED_HOLES) != 0u || (material & MESH_CUTOUT) != 0u;
    if (may_be_hole && material_is_hole(material, material_base(material, uv).a))
        discard;
}
