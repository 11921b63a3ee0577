/*
 * trace_ray_query.glsl: BVH traversal by hardware ray queries, bit-identical to the shader
 * traversal.
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

/* Intersects a candidate triangle; of equally distant ones the lowest index wins. */
bool trace_hit_candidate(trace_ray ray, int i, int part, inout trace_hit hit)
{
    trace_hit own = trace_hit(1e30, 0.0, 0.0, -1, part);
    trace_hit_triangle(ray, i, part, true, own);
    bool is_first = own.t == hit.t && part == hit.part && i < hit.triangle;
    if (own.t < hit.t || is_first)
        hit = own;
    return own.triangle >= 0;
}

void trace_query_bvh(trace_ray ray, int part, inout trace_hit hit)
{
    rayQueryEXT query;
    /* ray queries must not get NaN or infinity */
    bool is_sound = dot(ray.origin, ray.origin) < 1e30 && dot(ray.dir, ray.dir) < 1e30;
    vec3 dir = is_sound ? ray.dir : vec3(0.0, 1.0, 0.0);
    vec3 origin = is_sound ? ray.origin - trace.epsilon * dir : vec3(0.0);
    float near = 0.0, far = hit.t + 2.0 * trace.epsilon;
    for (int turn = 0; turn < 2; turn++) {
        rayQueryInitializeEXT(query, structure, gl_RayFlagsNoOpaqueEXT, is_sound ? 1u << part : 0u,
                              origin, near, dir, far);
        while (rayQueryProceedEXT(query)) {
            uint first =
                rayQueryGetIntersectionInstanceShaderBindingTableRecordOffsetEXT(query, false);
            int i = int(first) + rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
            if (trace_hit_candidate(ray, i, part, hit) && turn == 0)
                rayQueryConfirmIntersectionEXT(query);
        }
        float room = trace.epsilon + 1e-5 * hit.t;
        is_sound = is_sound && hit.triangle >= 0 && hit.part == part;
        near = is_sound ? max(hit.t + trace.epsilon - room, 0.0) : 0.0;
        far = is_sound ? hit.t + trace.epsilon + room : 1.0;
    }
}

#endif
