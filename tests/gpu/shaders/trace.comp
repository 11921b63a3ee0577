/* trace.comp: which texels see a triangle, along -z. */
#version 460
#extension GL_EXT_ray_query : require
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_IMAGE) uniform accelerationStructureEXT scene;

layout(binding = DATA_NUMBERS, scalar) writeonly buffer Numbers
{
    uint numbers[];
};

void main()
{
    uvec2 size = gl_NumWorkGroups.xy * DATA_GROUP;
    uvec2 at = gl_GlobalInvocationID.xy;
    vec3 from = vec3((vec2(at) + 0.5) / vec2(size), 1.0);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, scene, gl_RayFlagsOpaqueEXT, 0xff, from, 0.0, vec3(0, 0, -1), 2.0);
    while (rayQueryProceedEXT(query))
        ;
    numbers[at.y * size.x + at.x] = rayQueryGetIntersectionTypeEXT(query, true);
}
