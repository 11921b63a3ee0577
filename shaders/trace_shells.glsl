/* trace_shells.glsl: sets of objects, as of struct tree_shells, and their media. */
#ifndef TRACE_SHELLS_GLSL
#define TRACE_SHELLS_GLSL
#include "trace_tree.glsl"

uint trace_bit(uint rank)
{
    return 1u << (max(rank, 1u) - 1u);
}

uvec4 trace_eye_inside()
{
    uvec3 more = uvec3(trace.inside[1], trace.inside[2], trace.inside[3]);
    return uvec4(trace.inside[0], trace_has(TRACE_HAS_MANY) ? more : uvec3(0u));
}

/* Adds a rank to ranks in falling order. Each displaces the next one; the last one is lost. */
uvec4 trace_list_put(uvec4 list, uint rank)
{
    for (int i = 0; i < TREE_NESTED_MAX / 2; i++) {
        uint first = list[i] & 0xffffu, second = list[i] >> 16;
        uint next = first == rank ? 0u : min(first, rank);
        first = max(first, rank);
        rank = second == next ? 0u : min(second, next);
        list[i] = first | max(second, next) << 16;
    }
    return list;
}

uvec4 trace_list_remove(uvec4 list, uint rank)
{
    bool is_behind = false;
    for (int i = 0; i < TREE_NESTED_MAX / 2; i++) {
        uint first = list[i] & 0xffffu, second = list[i] >> 16;
        uint third = i + 1 < TREE_NESTED_MAX / 2 ? list[i + 1] & 0xffffu : 0u;
        is_behind = is_behind || first == rank;
        first = is_behind ? second : first;
        is_behind = is_behind || second == rank;
        second = is_behind ? third : second;
        list[i] = first | second << 16;
    }
    return list;
}

uvec4 trace_with(uvec4 inside, uint rank)
{
    if (trace_has(TRACE_HAS_MANY))
        return trace_list_put(inside, rank);
    inside.x |= trace_bit(rank);
    return inside;
}

uvec4 trace_without(uvec4 inside, uint rank)
{
    if (trace_has(TRACE_HAS_MANY))
        return trace_list_remove(inside, rank);
    inside.x &= ~trace_bit(rank);
    return inside;
}

bool trace_is_inside(uvec4 inside)
{
    return inside.x != 0u;
}

bool trace_eye_is_inside()
{
    return trace.inside[0] != 0u;
}

/* Returns the rank of the medium in a set of objects: the greatest one. */
uint trace_top(uvec4 inside)
{
    return trace_has(TRACE_HAS_MANY) ? inside.x & 0xffffu : uint(findMSB(inside.x) + 1);
}

/* The same without an object. */
uint trace_top_without(uvec4 inside, uint rank)
{
    if (trace_has(TRACE_HAS_MANY))
        return (inside.x & 0xffffu) == rank ? inside.x >> 16 : inside.x & 0xffffu;
    return uint(findMSB(inside.x & ~trace_bit(rank)) + 1);
}

vec4 trace_medium(uint rank, int texel)
{
    uint medium = rank;
    if (trace_has(TRACE_HAS_MANY))
        medium = trace_corner(int(trace.media_at + rank)).x;
    return trace.media[int(medium) * TRACE_MEDIUM + texel];
}

/* Returns the index, for green, of what a ray in objects is in, relative to what is around them. */
float trace_ior(uvec4 inside)
{
    if (!trace_has(TRACE_HAS_MEDIA))
        return 1.0 / refract_frame.eta;
    return trace_medium(trace_top(inside), TRACE_IOR).g / trace_medium(0u, TRACE_IOR).g;
}

#endif
