/* faces.comp: what a cube shows along +X -X +Y -Y +Z -Z. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(binding = DATA_IMAGE) uniform samplerCube cube;

layout(binding = DATA_COLORS, scalar) writeonly buffer Colors
{
    vec4 colors[6];
};

void main()
{
    uint face = gl_WorkGroupID.x;
    vec3 direction = vec3(0);
    direction[face / 2] = face % 2 == 0 ? 1 : -1;
    colors[face] = texture(cube, direction);
}
