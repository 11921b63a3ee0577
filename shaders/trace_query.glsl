/*
 * trace_query.glsl: meets the acceleration structures of a tree's triangles by ray queries.
 *
 * The structures tell which triangles a ray may meet; whether it does, and where, the words of the
 * tree say, as without them. For that the structures have triangles that are larger than those of
 * the tree by more than rounding (src/render/ray_groups.h), and queries begin before the ray does.
 * The first query finds a triangle that is the nearest one but for the device's rounding, the
 * second one those that are as near: so what is met does not depend on how structures were built.
 */
#ifndef TRACE_QUERY_GLSL
#define TRACE_QUERY_GLSL

layout(set = 0, binding = TRACE_STRUCTURE) uniform accelerationStructureEXT structure;

/* Meets a triangle; of some that are equally far, the one of the least number. */
bool trace_meet_candidate(trace_ray ray, int i, int part, inout trace_hit hit)
{
    trace_hit own = trace_hit(1e30, 0.0, 0.0, -1, part);
    trace_meet_triangle(ray, i, part, true, own);
    bool is_first = own.t == hit.t && part == hit.part && i < hit.triangle;
    if (own.t < hit.t || is_first)
        hit = own;
    return own.triangle >= 0;
}

void trace_query_part(trace_ray ray, int part, inout trace_hit hit)
{
    rayQueryEXT query;
    /* What is no number must not reach a query. */
    bool is_sound = dot(ray.origin, ray.origin) < 1e30 && dot(ray.dir, ray.dir) < 1e30;
    vec3 dir = is_sound ? ray.dir : vec3(0.0, 1.0, 0.0);
    vec3 origin = is_sound ? ray.origin - trace.hair * dir : vec3(0.0);
    float near = 0.0, far = hit.t + 2.0 * trace.hair;
    for (int turn = 0; turn < 2; turn++) {
        rayQueryInitializeEXT(query, structure, gl_RayFlagsNoOpaqueEXT, is_sound ? 1u << part : 0u,
                              origin, near, dir, far);
        while (rayQueryProceedEXT(query)) {
            uint first =
                rayQueryGetIntersectionInstanceShaderBindingTableRecordOffsetEXT(query, false);
            int i = int(first) + rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
            if (trace_meet_candidate(ray, i, part, hit) && turn == 0)
                rayQueryConfirmIntersectionEXT(query);
        }
        float room = trace.hair + 1e-5 * hit.t;
        is_sound = is_sound && hit.triangle >= 0 && hit.part == part;
        near = is_sound ? max(hit.t + trace.hair - room, 0.0) : 0.0;
        far = is_sound ? hit.t + trace.hair + room : 1.0;
    }
}

#endif
