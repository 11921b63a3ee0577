/* fallbacks.comp: one sample of each kind of image. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(binding = DATA_SAMPLERS) uniform sampler2D flat_image;
layout(binding = DATA_SAMPLERS + 1) uniform sampler2DArray array;
layout(binding = DATA_SAMPLERS + 2) uniform samplerCube cube;
layout(binding = DATA_SAMPLERS + 3) uniform sampler2D depth;
layout(binding = DATA_SAMPLERS + 4) uniform usampler2D numbers;
layout(binding = DATA_SAMPLERS + 5) uniform sampler2D again;

layout(binding = DATA_COLORS, scalar) writeonly buffer Colors
{
    vec4 colors[];
};

void main()
{
    colors[0] = textureLod(flat_image, vec2(0.3, 0.7), 0);
    colors[1] = textureLod(array, vec3(0.3, 0.7, 0), 0);
    colors[2] = textureLod(cube, vec3(0, -1, 0.2), 0);
    colors[3] = textureLod(depth, vec2(0.3, 0.7), 0);
    colors[4] = vec4(textureLod(numbers, vec2(0.3, 0.7), 0));
    colors[5] = textureLod(again, vec2(0.3, 0.7), 0);
}
