/* bubble_intersect.glsl: ray intersection with bubbles (C: src/scene/bubble_intersect.c). Bubbles
 * are ellipsoids of revolution or capsules. Points are relative to the bubble's centre. Axes are
 * unit vectors. */
#ifndef BUBBLE_INTERSECT_GLSL
#define BUBBLE_INTERSECT_GLSL

/* Returns a ray's entry distance (x) and exit distance (y) for a sphere. If the ray misses, x > y.
 * For a cylinder, pass `from` and `dir` perpendicular to its axis. `square` is dot(dir, dir). */
vec2 bubble_intersect_sphere(vec3 from, vec3 dir, float square, float radius)
{
    float along = dot(from, dir) / square;
    vec3 aside = from - along * dir;
    float root2 = (radius * radius - dot(aside, aside)) / square;
    float root = sqrt(max(root2, 0.0));
    return root2 > 0.0 ? vec2(-along - root, -along + root) : vec2(1e30, -1e30);
}

/* Returns a ray's entry and exit distances for a sphere or cylinder; `dir` may have any length. */
vec2 bubble_intersect_ball(vec3 from, vec3 dir, float radius)
{
    return bubble_intersect_sphere(from, dir, max(dot(dir, dir), 1e-20), radius);
}

/* Returns entry and exit distances for a capsule: two spheres connected by a cylinder. */
vec2 bubble_intersect_capsule(vec3 from, vec3 dir, vec3 axis, float half_length, float radius)
{
    float at = dot(from, axis), slope = dot(dir, axis);
    slope = abs(slope) < 1e-10 ? 1e-10 : slope;
    vec2 sides = (vec2(-half_length, half_length) - at) / slope;
    vec2 cut = bubble_intersect_ball(from - at * axis, dir - slope * axis, radius);
    cut = vec2(max(cut.x, min(sides.x, sides.y)), min(cut.y, max(sides.x, sides.y)));
    cut = cut.x <= cut.y ? cut : vec2(1e30, -1e30);
    vec2 low = bubble_intersect_ball(from + half_length * axis, dir, radius);
    vec2 high = bubble_intersect_ball(from - half_length * axis, dir, radius);
    return vec2(min(cut.x, min(low.x, high.x)), max(cut.y, max(low.y, high.y)));
}

/* Transforms a vector so that the ellipsoid around the origin becomes a sphere. */
vec3 bubble_to_sphere(vec3 v, vec3 axis, float stretch, float radius)
{
    return v + (radius / (radius + stretch) - 1.0) * dot(v, axis) * axis;
}

/* Returns the distances at which a ray enters and leaves a bubble; x > y if the ray misses. */
vec2 bubble_intersect(vec3 from, vec3 dir, vec3 axis, float stretch, float radius, bool is_capsule)
{
    if (is_capsule)
        return bubble_intersect_capsule(from, dir, axis, stretch, radius);
    return bubble_intersect_ball(bubble_to_sphere(from, axis, stretch, radius),
                                 bubble_to_sphere(dir, axis, stretch, radius), radius);
}

/* Returns the outward normal at a surface point of a bubble. */
vec3 bubble_normal(vec3 from, vec3 axis, float stretch, float radius, bool is_capsule)
{
    if (is_capsule)
        from -= clamp(dot(from, axis), -stretch, stretch) * axis;
    else
        from =
            bubble_to_sphere(bubble_to_sphere(from, axis, stretch, radius), axis, stretch, radius);
    return normalize(from);
}

#endif
