/*
 * trace_ray_query.glsl: BVH traversal by hardware ray queries, bit-identical to trace_bvh.glsl.
 *
 * The acceleration structures only return candidate triangles; trace_bvh.glsl decides about hits.
 * To miss no candidate, the structures contain triangles enlarged by more than the rounding error
 * (src/render/blas_groups.h), and queries start behind the ray's origin. A first query finds the
 * nearest triangle up to the device's rounding, a second one all candidates at about that distance,
 * so that the hit does not depend on how the structures were built.
 */
#ifndef TRACE_RAY_QUERY_GLSL
#define TRACE_RAY_QUERY_GLSL

layout(set = 0, binding = TRACE_STRUCTURE) uniform accelerationStructureEXT structure;

/* Intersects a candidate triangle. Of equally distant triangles, keeps the one of lowest index. */
bool trace_hit_candidate(trace_ray ray, int i, int bvh, inout trace_hit hit)
{
    trace_hit candidate = trace_hit(1e30, 0.0, 0.0, -1, bvh);
    trace_hit_triangle(ray, i, bvh, true, candidate);
    bool is_first = candidate.t == hit.t && bvh == hit.bvh && i < hit.triangle;
    if (candidate.t < hit.t || is_first)
        hit = candidate;
    return candidate.triangle >= 0;
}

void trace_query_bvh(trace_ray ray, int bvh, inout trace_hit hit)
{
    rayQueryEXT query;
    /* ray queries must not get NaN or infinity */
    bool is_finite = dot(ray.origin, ray.origin) < 1e30 && dot(ray.dir, ray.dir) < 1e30;
    vec3 dir = is_finite ? ray.dir : vec3(0.0, 1.0, 0.0);
    vec3 origin = is_finite ? ray.origin - trace.epsilon * dir : vec3(0.0);
    float near = trace_has(TRACE_HAS_CONTACTS) ? contact_search.near : 0.0;
    float far = hit.t + 2.0 * trace.epsilon;
    for (int pass = 0; pass < 2; pass++) {
        rayQueryInitializeEXT(query, structure, gl_RayFlagsNoOpaqueEXT, is_finite ? 1u << bvh : 0u,
                              origin, near, dir, far);
        while (rayQueryProceedEXT(query)) {
            uint first =
                rayQueryGetIntersectionInstanceShaderBindingTableRecordOffsetEXT(query, false);
            int i = int(first) + rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
            if (trace_hit_candidate(ray, i, bvh, hit) && pass == 0)
                rayQueryConfirmIntersectionEXT(query);
        }
        float margin = trace.epsilon + 1e-5 * hit.t;
        is_finite = is_finite && hit.triangle >= 0 && hit.bvh == bvh;
        near = is_finite ? max(hit.t + trace.epsilon - margin, 0.0) : 0.0;
        far = is_finite ? hit.t + trace.epsilon + margin : 1.0;
    }
}

#endif
