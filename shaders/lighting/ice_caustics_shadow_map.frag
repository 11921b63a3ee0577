#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/material_textures.glsl"

layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint material;

void main()
{
    if ((constant_textured & CONSTANT_TEXTURED_HOLES) != 0u &&
        material_is_hole(material, material_base_color(material, uv).a))
        discard;
}
