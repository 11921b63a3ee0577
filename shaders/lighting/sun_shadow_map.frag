/* sun_shadow_map.frag: fragment shader of the sun's shadow map, which tests alpha. */
#version 460
#include "lib/material_textures.glsl"

layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint material;

void main()
{
    if ((constant_textured & CONSTANT_TEXTURED_HOLES) != 0u &&
        material_is_hole(material, material_base_color(material, uv).a))
        discard;
}
