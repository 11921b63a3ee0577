/*
 * box_projection.glsl: box-projected cube map lookup, for rays from any point.
 *
 * The lookup direction goes from the capture point to the ray's intersection with the box (ARM
 * 2014, Guide to Unity, ARM 100140, 6.4). This is exact for surroundings on the box's sides.
 */
#ifndef BOX_PROJECTION_GLSL
#define BOX_PROJECTION_GLSL

/* Returns a ray's direction for a cube map lookup. `dir` may have any length. If `point` is outside
 * the box or `dir` is 0, returns `dir`, as for an infinitely distant environment. */
vec3 box_projection_dir(vec3 point, vec3 dir, vec3 low, vec3 high, vec3 captured)
{
    bool inside = all(greaterThanEqual(point, low)) && all(lessThanEqual(point, high));
    bvec3 flat_dir = equal(dir, vec3(0.0));
    vec3 sides = mix(low, high, greaterThan(dir, vec3(0.0)));
    vec3 reach = (sides - point) / mix(dir, vec3(1.0), flat_dir);
    reach = mix(reach, vec3(1e30), flat_dir); /* parallel to a side: no intersection */
    float t = min(min(reach.x, reach.y), reach.z);
    vec3 found = point + t * dir - captured;
    return inside && t >= 0.0 && t < 1e30 && found != vec3(0.0) ? found : dir;
}

#endif
