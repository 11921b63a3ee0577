/* trace_bvh.glsl: intersects rays with the triangles, cracks and bubbles of a BVH (bvh_layout.h). A
 * ray descends front to back to a leaf, then tests the leaf's triangles ("while-while", Aila and
 * Laine 2009). Finished lanes must leave the loops, otherwise Mesa 22.3 loses hits. */
#ifndef TRACE_BVH_GLSL
#define TRACE_BVH_GLSL
#include "lib/bubble_intersect.glsl"
#include "trace/refract_trace.h"
#include "trace/trace_traversal_stack.glsl"

layout(set = 0, binding = TRACE_FRAME, scalar) uniform Trace
{
    trace_frame trace;
};

/* The BVH is in texel buffers, which lavapipe reads three times as fast as storage buffers. If a
 * device's texel buffers are too small, storage buffers are used. */
layout(set = 0, binding = TRACE_NODES) uniform usamplerBuffer nodes;
layout(set = 0, binding = TRACE_TRIANGLES) uniform usamplerBuffer triangles;
layout(set = 0, binding = TRACE_CORNERS) uniform usamplerBuffer corners;

layout(set = 0, binding = TRACE_STORED_NODES, std430) readonly buffer StoredNodes
{
    uvec4 stored_nodes[];
};

layout(set = 0, binding = TRACE_STORED_TRIANGLES, std430) readonly buffer StoredTriangles
{
    uvec4 stored_triangles[];
};

layout(set = 0, binding = TRACE_STORED_CORNERS, std430) readonly buffer StoredCorners
{
    uvec4 stored_corners[];
};

bool trace_has(uint bit)
{
    return (constant_trace & bit) != 0u;
}

uvec4 trace_node(int word)
{
    if (trace_has(TRACE_HAS_STORAGE_BUFFERS))
        return stored_nodes[word];
    return texelFetch(nodes, word);
}

uvec4 trace_row(int word)
{
    if (trace_has(TRACE_HAS_STORAGE_BUFFERS))
        return stored_triangles[word];
    return texelFetch(triangles, word);
}

uvec4 trace_corner(int word)
{
    if (trace_has(TRACE_HAS_STORAGE_BUFFERS))
        return stored_corners[word];
    return texelFetch(corners, word);
}

struct trace_ray {
    vec3 origin, dir;
    float side;  /* 1 inside, -1 outside, else 0 */
    float reach; /* distance from the origin within which back faces are ignored */
    bool is_in_bubble;
    int from; /* triangle at the origin, not hit */
};

/* A ray in world space. */
struct trace_start {
    vec3 origin, dir;
    float side, reach;
    int from; /* triangle at the origin */
    bool is_in_bubble;
    uint bvhs; /* bit mask of BVHs to traverse */
};

struct trace_hit {
    float t, u, v; /* 1e30 if nothing is hit */
    int triangle;  /* below 0 if nothing is hit */
    int bvh;
};

const float trace_edge = 1e-6;
const float contact_cosine_min = 0.0625; /* minimum cosine of incidence in divisions */
const float contact_rounding = 5e-7;     /* relative rounding error of distances */
const uint trace_surroundings_mask = 1u << BVH_SURROUNDINGS | 1u << BVH_MOVERS;

/* Restriction of the hits that a query may return, with TRACE_HAS_CONTACTS. */
struct trace_contact_search {
    float near, far;    /* range of distances */
    float last;         /* distance of the last hit; hits must be beyond it, or at it and */
    int last_triangle;  /* have a higher triangle index than this */
    int first;          /* triangle that is not hit; below 0 if there is none */
    uvec4 medium_stack; /* objects that contain the ray's origin */
};

trace_contact_search contact_search = trace_contact_search(0.0, 1e30, 0.0, -1, -1, uvec4(0u));

/* A ray prepared for slab tests, in the grid coordinates of a BVH. */
struct trace_slabs {
    vec3 inverse, minus_origin; /* 1 / dir, -origin / dir */
    vec3 cull;                  /* 2 * side * dir for normal cone tests, 0 without these tests */
    int mask, shift;            /* lower plane's mask; upper plane's shift */
};

trace_slabs trace_slabs_for(trace_ray ray, int root)
{
    uvec4 grid = trace_node(BVH_NODE_WORDS * (root - 1));
    vec3 scale = uintBitsToFloat(trace_node(BVH_NODE_WORDS * (root - 1) + 1).xyz);
    vec3 safe = mix(ray.dir, vec3(1e-20), lessThan(abs(ray.dir), vec3(1e-20)));
    vec3 inverse = 1.0 / (scale * safe);
    vec3 origin = (ray.origin - uintBitsToFloat(grid.xyz)) * scale;
    int shift = int(grid.w);
    bool has_cones = trace_has(TRACE_HAS_CULLING) && shift < BVH_PLANE_BITS;
    vec3 cull = (has_cones ? 2.0 * ray.side : 0.0) * ray.dir;
    return trace_slabs(inverse, -origin * inverse, cull, (1 << shift) - 1, shift);
}

/* Returns true if the ray hits a child's bounding box before the distance `far`. Sets `enter` to
 * the distance of the hit. Floats are compared as integers, because lavapipe's float minimum takes
 * four instructions. Non-negative floats sort like integers. A negative exit distance is a miss. */
bool trace_hits_box(trace_slabs slabs, uvec4 child, float far, out float enter)
{
    ivec3 low = ivec3(child.xyz) & slabs.mask;
    ivec3 high = ivec3(child.xyz) >> slabs.shift & slabs.mask;
    vec3 a = vec3(low) * slabs.inverse + slabs.minus_origin;
    vec3 b = vec3(high) * slabs.inverse + slabs.minus_origin;
    ivec3 near_sides = min(floatBitsToInt(a), floatBitsToInt(b));
    ivec3 far_sides = max(floatBitsToInt(a), floatBitsToInt(b));
    int near = trace_has(TRACE_HAS_CONTACTS) ? floatBitsToInt(contact_search.near) : 0;
    int first = max(max(near_sides.x, near_sides.y), max(near_sides.z, near));
    int last = min(min(far_sides.x, far_sides.y), min(far_sides.z, floatBitsToInt(far)));
    enter = intBitsToFloat(first);
    return first <= last;
}

/* Returns true if the child's normal cone contains a normal that faces the ray. */
bool trace_cone_faces(trace_slabs slabs, uvec4 child)
{
    if (!trace_has(TRACE_HAS_CULLING))
        return true;
    vec3 axis = vec3(ivec3(child.xyz) >> BVH_CONE_SHIFT);
    int sine = int(child.w) >> BVH_CONE_SINE_SHIFT & BVH_CONE_OPEN;
    return dot(axis, slabs.cull) + float(sine) >= 0.0;
}

/* Returns the distances at which a ray enters and leaves a bubble; x > y if the ray misses. */
vec2 trace_cross_bubble(trace_ray ray, vec4 first, vec4 second, float radius)
{
    vec3 from = ray.origin - first.xyz;
    if (!trace_has(TRACE_HAS_SHAPES))
        return bubble_intersect_sphere(from, ray.dir, 1.0, radius);
    return bubble_intersect(from, ray.dir, second.xyz, first.w, radius, second.w > 0.0);
}

/* Returns true if the ray can hit crack or bubble `i`. Sets a bubble's distance `t`. Rays in
 * bubbles ignore cracks. Cracks nearer than trace.epsilon are ignored: rays may start on one. */
bool trace_hits_inclusion(trace_ray ray, int i, vec4 first, vec4 second, vec4 last, inout float t,
                          inout float u, inout float v)
{
    if (last.xyz != vec3(0.0))
        return i != ray.from && t > trace.epsilon && !ray.is_in_bubble;
    vec2 at = trace_cross_bubble(ray, first, second, last.w);
    t = i == ray.from || at.x <= 0.0 ? at.y : at.x;
    u = 0.0;
    v = 0.0;
    return at.x <= at.y && (i != ray.from || ray.is_in_bubble);
}

/* Returns true if a medium stack contains the object of priority `rank`. */
bool trace_stack_has(uvec4 medium_stack, uint rank)
{
    if (!trace_has(TRACE_HAS_MANY_OBJECTS))
        return rank != 0u && (medium_stack.x >> (rank - 1u) & 1u) != 0u;
    uvec4 low = medium_stack & 0xffffu, high = medium_stack >> 16;
    return any(equal(low, uvec4(rank))) || any(equal(high, uvec4(rank)));
}

/* Returns true if a triangle at a contact can be hit. Near the origin of a ray, faces are ignored
 * that do not change the medium stack, because the path has crossed them at its last surface, but
 * not if the ray enters another shell of the object that it has hit first at this contact. Of other
 * triangles, returns `is_hit`. */
bool contact_is_hit(trace_ray ray, int i, float t, float towards, bool is_hit)
{
    float away = t * max(abs(towards), contact_cosine_min);
    int iterations = ray.side != 0.0 && away < ray.reach ? int(trace.one) : 0;
    while (iterations > 0) {
        iterations -= int(trace.one);
        uint bits = trace_corner(BVH_CORNER_WORDS * i + 2).w & BVH_CONTACT_MASK;
        uint rank = trace_corner(BVH_CORNER_WORDS * i).w % BVH_OBJECT_NUMBER;
        bool changes_stack = trace_stack_has(contact_search.medium_stack, rank) == towards > 0.0;
        int first = BVH_CORNER_WORDS * max(contact_search.first, 0);
        bool is_partner = contact_search.first >= 0 && towards < 0.0 &&
                          trace_corner(first).w % BVH_OBJECT_NUMBER == rank;
        is_hit = bits == BVH_CONTACT ? changes_stack || is_partner
                 : bits == 0u        ? is_hit
                                     : is_hit && away >= trace.epsilon;
    }
    return is_hit && i != ray.from;
}

void trace_hit_triangle(trace_ray ray, int i, int bvh, bool is_active, inout trace_hit hit)
{
    vec4 w = uintBitsToFloat(trace_row(3 * i + 2));
    float towards = dot(w.xyz, ray.dir);
    float t = -(dot(w.xyz, ray.origin) + w.w) / towards;
    vec3 p = ray.origin + t * ray.dir;
    vec4 first = uintBitsToFloat(trace_row(3 * i));
    float u = dot(first.xyz, p) + first.w;
    vec4 row = uintBitsToFloat(trace_row(3 * i + 1));
    float v = dot(row.xyz, p) + row.w;
    bool is_hit = i != ray.from &&
                  (towards * ray.side >= 0.0 || (!trace_has(TRACE_HAS_CULLING) && t >= ray.reach));
    if (trace_has(TRACE_HAS_INCLUSIONS) && bvh == BVH_INCLUSIONS)
        is_hit = trace_hits_inclusion(ray, i, first, row, w, t, u, v);
    else if (trace_has(TRACE_HAS_CONTACTS) && bvh == BVH_OBJECTS)
        is_hit = contact_is_hit(ray, i, t, towards, is_hit);
    bool is_nearer = t < hit.t;
    if (trace_has(TRACE_HAS_CONTACTS)) {
        bool is_beyond = t > contact_search.last ||
                         (t == contact_search.last && i > contact_search.last_triangle);
        is_nearer = is_beyond && i != contact_search.first &&
                    (is_nearer || (t == hit.t && i < hit.triangle));
    }
    if (is_active && is_hit && t > 0.0 && is_nearer && u >= -trace_edge && v >= -trace_edge &&
        u + v <= 1.0 + trace_edge) {
        hit.t = t;
        hit.u = u;
        hit.v = v;
        hit.triangle = i;
        hit.bvh = bvh;
    }
}

void trace_hit_bvh(trace_ray ray, int root, int bvh, inout trace_hit hit)
{
    trace_slabs slabs = trace_slabs_for(ray, root);
    int node = root;
    stack_begin();
    do {
        while (node >= 0 && stack_has_room()) {
            uvec4 child_0 = trace_node(BVH_NODE_WORDS * node);
            uvec4 child_1 = trace_node(BVH_NODE_WORDS * node + 1);
            float enter_0, enter_1;
            float reach = hit.t;
            if (trace_has(TRACE_HAS_CONTACTS) && contact_search.first >= 0)
                reach = contact_search.far; /* hits of equal distance are found despite rounding */
            bool hits_0 = trace_hits_box(slabs, child_0, reach, enter_0);
            bool faces_0 = trace_cone_faces(slabs, child_0);
            hits_0 = hits_0 && faces_0;
            bool hits_1 = trace_hits_box(slabs, child_1, reach, enter_1);
            bool faces_1 = trace_cone_faces(slabs, child_1);
            hits_1 = hits_1 && faces_1;
            bool second = hits_1 && (!hits_0 || enter_1 < enter_0);
            int near = int((second ? child_1.w : child_0.w) & BVH_CHILD_MASK);
            int far = int((second ? child_0.w : child_1.w) & BVH_CHILD_MASK);
            node = stack_next(hits_0 && hits_1, !hits_0 && !hits_1, near, far);
        }
        int leaf = node < 0 ? node & 0x7fffffff : 0;
        int k = leaf >> 3, end = k + (leaf & 7);
        do {
            trace_hit_triangle(ray, k, bvh, k < end, hit);
            k++;
            if (k >= end && node < 0 && node != trace_nothing) {
                node = stack_pop();
                leaf = node >= 0 ? 0 : node & 0x7fffffff;
                k = leaf >> 3;
                end = k + (leaf & 7);
            }
        } while (k < end);
        node = stack_settle(node);
    } while (node != trace_nothing);
}

/* Returns a BVH's pose: cosine and sine of its rotation about the vertical axis, then its
 * translation in x and z. A pose is not a matrix, because tracing would take a sixth longer. */
vec4 trace_bvh_pose(int bvh)
{
    vec4 pose = bvh == BVH_MOVERS ? trace.movers_rotation : vec4(1.0, 0.0, 0.0, 0.0);
    return bvh == BVH_OBJECTS || bvh == BVH_INCLUSIONS ? trace.objects_rotation : pose;
}

vec3 trace_rotated(vec3 v, float cosine, float sine)
{
    return vec3(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x);
}

#ifdef TRACE_QUERY
#include "trace/trace_ray_query.glsl"
#endif

void trace_hit_in_world(trace_start start, int bvh, inout trace_hit hit)
{
    vec3 local_origin = start.origin, local_dir = start.dir;
    if (trace_has(TRACE_HAS_MOTION)) {
        vec4 pose = trace_bvh_pose(bvh);
        local_origin = trace_rotated(start.origin - vec3(pose.z, 0.0, pose.w), pose.x, -pose.y);
        local_dir = trace_rotated(start.dir, pose.x, -pose.y);
    }
    float local_side = bvh == BVH_OBJECTS ? start.side : 0.0;
    trace_ray ray =
        trace_ray(local_origin, local_dir, local_side, start.reach, start.is_in_bubble, start.from);
#ifdef TRACE_QUERY
    if (bvh != BVH_INCLUSIONS) {
        trace_query_bvh(ray, bvh, hit);
        return;
    }
#endif
    trace_hit_bvh(ray, int(trace.roots[bvh]), bvh, hit);
}

/* Returns the nearest hit of a ray with the BVHs in its bit mask. If `is_active` is false, returns
 * no hit. Lanes with different masks traverse different BVHs at the same time. If all scenery is
 * outside the objects' bounding box, a ray that hits an object from inside skips the scenery. */
trace_hit trace_nearest_hit(trace_start start, bool is_active)
{
    float far = trace_has(TRACE_HAS_CONTACTS) ? contact_search.far : 1e30;
    trace_hit hit = trace_hit(far, 0.0, 0.0, -1, 0);
    bool surroundings_are_apart = trace.surroundings_are_apart != 0u && start.side > 0.0;
    uint left = is_active ? start.bvhs & trace.bvh_mask : 0u;
    while (left != 0u) {
        trace_hit_in_world(start, findLSB(left), hit);
        left &= left - 1u;
        left &= surroundings_are_apart && hit.triangle >= 0 ? ~trace_surroundings_mask : ~0u;
    }
    return hit;
}

/* Returns the number of a triangle's object, as in the AOV `object`. */
uint trace_object_number(int triangle)
{
    int at = BVH_CORNER_WORDS * max(triangle, 0);
    uint number = trace_corner(at).w / BVH_OBJECT_NUMBER;
    uint surface = trace_corner(at + 2).w;
    return number != 0u ? number : trace_corner(int(surface) + 3).w / 2u;
}

/* Transforms a world-space point to the space of a BVH. */
vec3 trace_unposed_point(vec3 point, int bvh)
{
    vec4 pose = trace_bvh_pose(bvh);
    vec3 local = trace_rotated(point - vec3(pose.z, 0.0, pose.w), pose.x, -pose.y);
    return trace_has(TRACE_HAS_MOTION) ? local : point;
}

/* Transforms a vector from the space of a BVH to world space. */
vec3 trace_posed(vec3 v, int bvh)
{
    vec4 pose = trace_bvh_pose(bvh);
    return trace_has(TRACE_HAS_MOTION) ? trace_rotated(v, pose.x, pose.y) : v;
}

#endif
