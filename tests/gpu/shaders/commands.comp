/* commands.comp: numbers of indirect commands: the view's workgroups, as many triangles as the
 * seed says. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(binding = DATA_SEED, scalar) uniform Seed
{
    data_seed seed;
};

layout(binding = DATA_COMMANDS, scalar) writeonly buffer Commands
{
    data_commands commands;
};

void main()
{
    commands.groups = uint[](2, 2, 1);
    commands.vertices = uint[](3 * seed.value, 1, 0, 0);
    commands.indices = uint[](3 * seed.value, 1, 0, 0, 0);
}
