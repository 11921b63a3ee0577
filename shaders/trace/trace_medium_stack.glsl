/* trace_medium_stack.glsl: medium stack of a path: priorities of all objects around the path's
 * origin. The stack is a bit mask or, with TRACE_HAS_MANY_OBJECTS, a descending list. */
#ifndef TRACE_MEDIUM_STACK_GLSL
#define TRACE_MEDIUM_STACK_GLSL
#include "trace/trace_bvh.glsl"

uint trace_priority_bit(uint rank)
{
    return 1u << (max(rank, 1u) - 1u);
}

uvec4 trace_camera_stack()
{
    uvec3 more = uvec3(trace.inside[1], trace.inside[2], trace.inside[3]);
    return uvec4(trace.inside[0], trace_has(TRACE_HAS_MANY_OBJECTS) ? more : uvec3(0u));
}

/* Inserts a medium priority into a list in descending order. A full list loses its last entry. */
uvec4 trace_list_insert(uvec4 list, uint rank)
{
    for (int i = 0; i < BVH_INTERIOR_LIST_MAX / 2; i++) {
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
    for (int i = 0; i < BVH_INTERIOR_LIST_MAX / 2; i++) {
        uint first = list[i] & 0xffffu, second = list[i] >> 16;
        uint third = i + 1 < BVH_INTERIOR_LIST_MAX / 2 ? list[i + 1] & 0xffffu : 0u;
        is_behind = is_behind || first == rank;
        first = is_behind ? second : first;
        is_behind = is_behind || second == rank;
        second = is_behind ? third : second;
        list[i] = first | second << 16;
    }
    return list;
}

uvec4 trace_stack_push(uvec4 medium_stack, uint rank)
{
    if (trace_has(TRACE_HAS_MANY_OBJECTS))
        return trace_list_insert(medium_stack, rank);
    medium_stack.x |= trace_priority_bit(rank);
    return medium_stack;
}

uvec4 trace_stack_remove(uvec4 medium_stack, uint rank)
{
    if (trace_has(TRACE_HAS_MANY_OBJECTS))
        return trace_list_remove(medium_stack, rank);
    medium_stack.x &= ~trace_priority_bit(rank);
    return medium_stack;
}

/* Removes objects from a medium stack, and adds others. Objects in both sets do not change. */
uvec4 trace_stack_change(uvec4 medium_stack, uvec4 removed, uvec4 added)
{
    uvec4 changed = medium_stack & ~(removed & ~added) | added & ~removed;
    int count = trace_has(TRACE_HAS_MANY_OBJECTS) ? BVH_INTERIOR_LIST_MAX : 0;
    for (int i = 0; i < count; i++) {
        uint old = removed[i / 2] >> 16 * (i % 2) & 0xffffu;
        uint own = added[i / 2] >> 16 * (i % 2) & 0xffffu;
        medium_stack = trace_list_remove(medium_stack, trace_stack_has(added, old) ? 0u : old);
        medium_stack = trace_list_insert(medium_stack, trace_stack_has(removed, own) ? 0u : own);
    }
    return trace_has(TRACE_HAS_MANY_OBJECTS) ? medium_stack : changed;
}

bool trace_is_inside(uvec4 medium_stack)
{
    return medium_stack.x != 0u;
}

bool trace_camera_is_inside()
{
    return trace.inside[0] != 0u;
}

/* Returns the medium that a path is in, which has the highest priority on the stack. */
uint trace_current_medium(uvec4 medium_stack)
{
    return trace_has(TRACE_HAS_MANY_OBJECTS) ? medium_stack.x & 0xffffu
                                             : uint(findMSB(medium_stack.x) + 1);
}

/* Returns the medium of highest priority on the stack, not counting `rank`. */
uint trace_current_medium_without(uvec4 medium_stack, uint rank)
{
    if (trace_has(TRACE_HAS_MANY_OBJECTS))
        return (medium_stack.x & 0xffffu) == rank ? medium_stack.x >> 16 : medium_stack.x & 0xffffu;
    return uint(findMSB(medium_stack.x & ~trace_priority_bit(rank)) + 1);
}

vec4 trace_medium(uint rank, int texel)
{
    uint medium = rank;
    if (trace_has(TRACE_HAS_MANY_OBJECTS))
        medium = trace_corner(int(trace.media_at + rank)).x;
    return trace.media[int(medium) * TRACE_MEDIUM + texel];
}

/* Returns true if there is no interface between two media, because they are the same medium or
 * objects of equal parameters. */
bool trace_is_same_medium(uint a, uint b)
{
    bool is_same = a == b;
    bool are_objects = !is_same && min(a, b) > 0u;
    int iterations = are_objects && trace_medium(a, TRACE_IOR) == trace_medium(b, TRACE_IOR)
                         ? int(trace.one)
                         : 0;
    while (iterations > 0) {
        iterations -= int(trace.one);
        is_same = trace_medium(a, TRACE_ABSORB) == trace_medium(b, TRACE_ABSORB) &&
                  trace_medium(a, TRACE_TINT) == trace_medium(b, TRACE_TINT);
    }
    return is_same;
}

/* Returns the refractive index of a path's medium for green light, relative to the outside. */
float trace_ior(uvec4 medium_stack)
{
    if (!trace_has(TRACE_HAS_MEDIA))
        return 1.0 / refract_frame.eta;
    return trace_medium(trace_current_medium(medium_stack), TRACE_IOR).g /
           trace_medium(0u, TRACE_IOR).g;
}

#endif
