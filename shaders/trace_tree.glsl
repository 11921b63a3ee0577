/*
 * trace_tree.glsl: meets the trees of tree.h with rays.
 *
 * The nearer child first, a stack of the others; first nodes, then triangles (Aila and Laine 2009,
 * "while-while"). Lanes that have finished must not go on: Mesa 22.3 loses hits in loops in which
 * they do.
 */
#ifndef TRACE_TREE_GLSL
#define TRACE_TREE_GLSL
#include "lib/globals.glsl"
#include "refract_trace.h"

layout(set = 0, binding = TRACE_FRAME, scalar) uniform Trace
{
    trace_frame trace;
};

layout(set = 0, binding = TRACE_NODES) uniform usamplerBuffer nodes;
layout(set = 0, binding = TRACE_TRIANGLES) uniform usamplerBuffer triangles;
layout(set = 0, binding = TRACE_CORNERS) uniform usamplerBuffer corners;

bool trace_has(uint bit)
{
    return (constant_trace & bit) != 0u;
}

struct trace_ray {
    vec3 origin, dir;
    vec3 inverse, origin_inverse; /* 1 / dir, origin / dir */
    float side;  /* 1: inside the object that it begins on, -1: outside of it, 0: on none */
    float reach; /* within which faces are not met that it could only see from the other side */
    float cull;  /* `side`, if the cones of nodes count */
    int from;    /* a triangle that is not met */
};

struct trace_hit {
    float t, u, v; /* t is 1e30 if nothing is met */
    int triangle;  /* below 0: none */
    int part;
};

const float trace_edge = 1e-6;
const int trace_nothing = int(TREE_LEAF);

trace_ray trace_ray_of(vec3 origin, vec3 dir, float side, float reach, int from)
{
    vec3 safe = mix(dir, vec3(1e-20), lessThan(abs(dir), vec3(1e-20)));
    vec3 inverse = 1.0 / safe;
    float cull = trace_has(TRACE_HAS_CULLING) ? side : 0.0;
    return trace_ray(origin, dir, inverse, origin * inverse, side, reach, cull, from);
}

/* Returns whether a ray meets a box before `far`, and where it enters. */
bool trace_meets_box(trace_ray ray, vec3 low, vec3 high, float far, out float enter)
{
    vec3 a = low * ray.inverse - ray.origin_inverse;
    vec3 b = high * ray.inverse - ray.origin_inverse;
    vec3 near_sides = min(a, b);
    vec3 far_sides = max(a, b);
    enter = max(max(near_sides.x, near_sides.y), max(near_sides.z, 0.0));
    float leave = min(min(far_sides.x, far_sides.y), min(far_sides.z, far));
    return enter <= leave;
}

bool trace_faces(uint cone, trace_ray ray)
{
    if (!trace_has(TRACE_HAS_CULLING))
        return true;
    vec4 c = unpackSnorm4x8(cone);
    return dot(c.xyz, ray.dir) * ray.cull + c.w >= 0.0;
}

void trace_meet_triangle(trace_ray ray, int i, int part, bool counts, inout trace_hit hit)
{
    vec4 w = uintBitsToFloat(texelFetch(triangles, 3 * i + 2));
    float towards = dot(w.xyz, ray.dir);
    float t = -(dot(w.xyz, ray.origin) + w.w) / towards;
    vec3 p = ray.origin + t * ray.dir;
    vec4 row = uintBitsToFloat(texelFetch(triangles, 3 * i));
    float u = dot(row.xyz, p) + row.w;
    row = uintBitsToFloat(texelFetch(triangles, 3 * i + 1));
    float v = dot(row.xyz, p) + row.w;
    bool is_seen = i != ray.from && (towards * ray.side >= 0.0 || t >= ray.reach);
    if (counts && is_seen && t > 0.0 && t < hit.t && u >= -trace_edge && v >= -trace_edge &&
        u + v <= 1.0 + trace_edge) {
        hit.t = t;
        hit.u = u;
        hit.v = v;
        hit.triangle = i;
        hit.part = part;
    }
}

void trace_meet_part(trace_ray ray, int root, int part, inout trace_hit hit)
{
    int stack[TREE_DEPTH_MAX + 2];
    int top = 0;
    int node = root;
    stack[0] = trace_nothing;
    do {
        do {
            int at = TREE_NODE_WORDS * max(node, 0);
            uvec4 a = texelFetch(nodes, at), b = texelFetch(nodes, at + 1);
            uvec4 c = texelFetch(nodes, at + 2), d = texelFetch(nodes, at + 3);
            float enter_0, enter_1;
            bool meets_0 = trace_meets_box(ray, uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz),
                                           hit.t, enter_0) &&
                           trace_faces(b.w, ray) && node >= 0;
            bool meets_1 = trace_meets_box(ray, uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz),
                                           hit.t, enter_1) &&
                           trace_faces(d.w, ray) && node >= 0;
            bool second = meets_1 && (!meets_0 || enter_1 < enter_0);
            int near = second ? int(c.w) : int(a.w);
            int far = second ? int(a.w) : int(c.w);
            int popped = stack[top];
            bool none = !meets_0 && !meets_1;
            if (meets_0 && meets_1) {
                top++;
                stack[top] = far;
            }
            top -= none ? 1 : 0;
            node = none ? popped : near;
        } while (node >= 0);
        int leaf = node & 0x7fffffff;
        int k = leaf >> 3, end = k + (leaf & 7);
        do {
            trace_meet_triangle(ray, k, part, k < end, hit);
            k++;
            if (k >= end && node < 0 && node != trace_nothing) {
                node = stack[top];
                top--;
                leaf = node >= 0 ? 0 : node & 0x7fffffff;
                k = leaf >> 3;
                end = k + (leaf & 7);
            }
        } while (k < end);
    } while (node != trace_nothing);
}

/* Returns the pose of a part in the world, a rotation. */
mat4 trace_pose(int part)
{
    mat4 around = part == TREE_MOVERS ? frame.world_from_movers : mat4(1.0);
    return part == TREE_OBJECTS ? frame.world_from_object : around;
}

/* Meets all parts; a ray that is not active meets nothing. */
trace_hit trace_meet(vec3 origin, vec3 dir, float side, float reach, int from, bool is_active)
{
    trace_hit hit = trace_hit(1e30, 0.0, 0.0, -1, 0);
#ifdef TRACE_RAYS
    for (int part = 0; part < TREE_PART_COUNT; part++) {
        uint root = trace.roots[part];
        if (root == TREE_NOTHING)
            continue;
#else
    {
        const int part = TREE_OBJECTS;
        uint root = trace.roots[part];
#endif
        vec3 own_origin = origin, own_dir = dir;
        if (trace_has(TRACE_HAS_MOTION)) {
            mat4 pose = trace_pose(part);
            mat3 turn = transpose(mat3(pose));
            own_origin = turn * (origin - pose[3].xyz);
            own_dir = turn * dir;
        }
        float own_side = part == TREE_OBJECTS ? side : 0.0;
        trace_ray ray = trace_ray_of(own_origin, own_dir, own_side, reach, from);
        trace_meet_part(ray, is_active ? int(root) : trace_nothing, part, hit);
    }
    return hit;
}

/* Returns a vector of a part in the world. */
vec3 trace_posed(vec3 v, int part)
{
    return trace_has(TRACE_HAS_MOTION) ? mat3(trace_pose(part)) * v : v;
}

#endif
