/* trace_next.glsl: selects the BVHs that a path segment may hit, to skip other traversals. */
#ifndef TRACE_NEXT_GLSL
#define TRACE_NEXT_GLSL

/* Returns true if a path that has left a surface cannot hit an object again. */
bool trace_has_left(trace_way path)
{
    return trace_has(TRACE_IS_CONVEX) ? !trace_is_in(path) : path.side == trace_left;
}

/* Returns a bit mask of the BVHs that the next segment may hit. */
uint trace_parts_of(trace_way path)
{
    bool is_in_ice = trace_is_in(path) && trace_top(path.medium_stack) == trace.ice;
    bool meets_inclusions = trace_has(TRACE_HAS_INCLUSIONS) && (is_in_ice || path.is_in_bubble);
#ifdef TRACE_RAYS
    uint around = trace_around;
#else
    uint around = 0u;
#endif
#ifndef REFRACT_LAYERS
    /* surroundings in front of the objects are composited by rasterisation */
    if (!trace_has(TRACE_HAS_HOLES | TRACE_HAS_GROUND) && is_first && !trace_eye_is_inside())
        around = 0u;
#endif
    bool has_left =
        trace_has(TRACE_IS_CONVEX) ? path.side < 0.0 && !is_first : path.side == trace_left;
    uint objects = has_left ? 0u : 1u << TREE_OBJECTS;
    return objects | around | (meets_inclusions ? 1u << TREE_INCLUSIONS : 0u);
}

trace_start trace_start_of(trace_way path)
{
    float reach = trace_has(TRACE_HAS_CULLING) ? 1e30 : path.reach;
    return trace_start(path.origin, path.dir, path.side, reach, path.from, path.is_in_bubble,
                       trace_parts_of(path));
}

#ifndef TRACE_RAYS
/* Returns the horizon, a sine, at a rasterised point of an object's outer side, whose triangle is
 * not known. Rays above that elevation hit no object. */
float trace_grid_horizon(vec3 point)
{
    vec3 own = trace_unposed_point(point, TREE_OBJECTS);
    vec3 cells = (own - trace.grid_low.xyz) * trace.grid_scale.xyz;
    uvec3 cell = uvec3(clamp(cells, vec3(0.0), vec3(float(TREE_GRID - 1))));
    uint at = cell.x + uint(TREE_GRID) * (cell.y + uint(TREE_GRID) * cell.z);
    uvec4 word = trace_corner(int(trace.grid_at + at / 32u));
    uint steps = word[at / 8u % 4u] >> 4u * (at % 8u) & 15u;
    return trace.grid_at == 0u ? 2.0 : float(steps) / float(TREE_HORIZON_STEPS);
}
#endif

#endif
