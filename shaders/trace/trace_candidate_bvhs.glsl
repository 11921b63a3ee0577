/* trace_candidate_bvhs.glsl: selects the BVHs that a path segment may hit. */
#ifndef TRACE_CANDIDATE_BVHS_GLSL
#define TRACE_CANDIDATE_BVHS_GLSL

/* Returns true if a path that has left a surface cannot hit an object again. */
bool trace_has_escaped(trace_path path)
{
    return trace_has(TRACE_IS_CONVEX) && !trace_is_in(path);
}

/* Returns a bit mask of the BVHs that the next segment may hit. */
uint trace_bvh_mask(trace_path path)
{
    bool is_in_ice = trace_is_in(path) && trace_current_medium(path.medium_stack) == trace.ice;
    bool hits_inclusions = trace_has(TRACE_HAS_INCLUSIONS) && (is_in_ice || path.is_in_bubble);
#ifdef TRACE_RAYS
    uint surroundings = trace_surroundings_mask;
#else
    uint surroundings = 0u;
#endif
    /* primary rays skip surroundings, which rasterisation composites in front of objects */
    if (!trace_has(TRACE_HAS_HOLES | TRACE_HAS_DIFFUSE_LIGHT) && is_first &&
        !trace_camera_is_inside())
        surroundings = 0u;
    bool has_left = trace_has(TRACE_IS_CONVEX) && path.side < 0.0 && !is_first;
    uint objects = has_left ? 0u : 1u << BVH_OBJECTS;
    return objects | surroundings | (hits_inclusions ? 1u << BVH_INCLUSIONS : 0u);
}

trace_start trace_start_of(trace_path path)
{
    float reach = trace_has(TRACE_HAS_CULLING) ? 1e30 : path.reach;
    return trace_start(path.origin, path.dir, path.side, reach, path.from, path.is_in_bubble,
                       trace_bvh_mask(path));
}

#endif
