/*
 * refract_bubbles.glsl: intersects path segments inside the ice with the BVH of the bubbles.
 *
 * A bubble covers a ray by the fraction of the ray's footprint that the bubble's outline overlaps,
 * so that outlines are antialiased and bubbles thinner than a pixel keep their projected area.
 */
#ifndef REFRACT_BUBBLES_GLSL
#define REFRACT_BUBBLES_GLSL
#include "inclusions/bubbles.h"
#include "lib/bubble_intersect.glsl"

layout(set = 0, binding = REFRACT_BUBBLES, scalar) readonly buffer Bubbles
{
    bubbles_node bubble_nodes[];
};

struct bubbles_hit {
    float t;     /* distance to the ray's closest approach to the bubble's centre or axis */
    float cover; /* fraction of the ray's footprint that the bubble covers; 0 without hit */
    uint index;  /* of the node */
};

/* Returns the fraction of a footprint of width `width` that a node's bubble covers. Sets `t`. */
float bubbles_cover(bubbles_node node, vec3 from, vec3 dir, float width, out float t)
{
    vec3 axis = node.axis, gap;
    float radius = node.radius, slope = dot(dir, axis);
    from -= node.center;
    float across = 1.0 - slope * slope;
    if (node.kind == BUBBLES_NODE_CAPSULE) {
        float along = dot(from, dir);
        float at = (dot(from, axis) - slope * along) / max(across, 1e-6);
        at = clamp(at, -node.stretch, node.stretch);
        t = slope * at - along;
        gap = from + t * dir - at * axis;
    } else {
        vec3 scaled_from = bubble_to_sphere(from, axis, node.stretch, radius);
        vec3 scaled_dir = bubble_to_sphere(dir, axis, node.stretch, radius);
        t = -dot(scaled_from, scaled_dir) / max(dot(scaled_dir, scaled_dir), 1e-20);
        gap = scaled_from + t * scaled_dir;
    }
    float dist = length(gap);
    float reach = radius + max(node.stretch, 0.0) * sqrt(max(across, 0.0));
    float near = clamp(0.5 + (radius - dist) / width, 0.0, 1.0);
    float far = clamp(0.5 + (radius + dist) / width, 0.0, 1.0);
    /* A footprint wider than the bubble is long: the ratio of a disc's area to a square's. */
    return (near + far - 1.0) * min(1.5708 * reach / width, 1.0);
}

/* Returns true if a ray enters a node's box, widened by `margin`, between `min_t` and `max_t`. */
bool bubbles_enters(bubbles_node node, vec3 from, vec3 inverse_dir, float margin, vec2 range)
{
    vec3 center = (node.center - from) * inverse_dir;
    vec3 half_size = (node.axis + margin) * abs(inverse_dir);
    vec3 enter = center - half_size, leave = center + half_size;
    return max(max(enter.x, enter.y), max(enter.z, range.x)) <=
           min(min(leave.x, leave.y), min(leave.z, range.y));
}

/* Returns the first bubble that covers a ray of footprint `width` between the distances `range`. */
bubbles_hit bubbles_find(vec3 from, vec3 dir, float width, vec2 range)
{
    vec3 inverse_dir = 1.0 / mix(dir, vec3(1e-9), lessThan(abs(dir), vec3(1e-9)));
    bubbles_hit hit = bubbles_hit(range.y, 0.0, 0u);
    uint count = bubble_nodes[0].skip;
    for (uint i = 0u; i < count;) {
        bubbles_node node = bubble_nodes[i];
        uint next = i + 1u;
        if (node.kind == BUBBLES_NODE_BOX) {
            if (!bubbles_enters(node, from, inverse_dir, 0.5 * width, vec2(range.x, hit.t)))
                next = node.skip;
        } else {
            float t;
            float cover = bubbles_cover(node, from, dir, width, t);
            if (cover > 0.0 && t > range.x && t < hit.t)
                hit = bubbles_hit(t, cover, i);
        }
        i = next;
    }
    return hit;
}

#endif
