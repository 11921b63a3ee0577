/* trace_next.glsl: what a way may meet next. Frames of the ice cube are a tenth faster since rays
 * skip what they cannot meet. */
#ifndef TRACE_NEXT_GLSL
#define TRACE_NEXT_GLSL

/* Returns whether a way that has met a surface meets no object any more. */
bool trace_has_left(trace_way way)
{
    return trace_has(TRACE_IS_CONVEX) ? !trace_is_in(way) : way.side == trace_left;
}

/* Returns the parts that a way may meet next, a bit each. */
uint trace_parts_of(trace_way way)
{
    bool is_in_ice = trace_is_in(way) && trace_top(way.inside) == trace.ice;
    bool meets_inclusions = trace_has(TRACE_HAS_INCLUSIONS) && (is_in_ice || way.is_in_bubble);
#ifdef TRACE_RAYS
    uint around = trace_around;
#else
    uint around = 0u;
#endif
#ifndef REFRACT_LAYERS
    /* what is before the objects is drawn over the picture */
    if (!trace_has(TRACE_HAS_HOLES | TRACE_HAS_GROUND) && is_first && !trace_eye_is_inside())
        around = 0u;
#endif
    bool has_left =
        trace_has(TRACE_IS_CONVEX) ? way.side < 0.0 && !is_first : way.side == trace_left;
    uint objects = has_left ? 0u : 1u << TREE_OBJECTS;
    return objects | around | (meets_inclusions ? 1u << TREE_INCLUSIONS : 0u);
}

trace_start trace_start_of(trace_way way)
{
    float reach = trace_has(TRACE_HAS_CULLING) ? 1e30 : way.reach;
    return trace_start(way.origin, way.dir, way.side, reach, way.from, way.is_in_bubble,
                       trace_parts_of(way));
}

#ifndef TRACE_RAYS
/* Returns the sine beyond which rays that leave a point of an object's outer side meet none, to
 * tell it of rasterised points, whose triangles are not known. */
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
