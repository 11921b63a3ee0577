/*
 * local_cube.glsl: where a cube that was captured inside a box is looked up for a ray that begins
 * elsewhere in the box.
 *
 * ARM 2014, Guide to Unity (ARM 100140), 6.4: the ray meets the box, and the vector from where the
 * cube was captured to there looks it up. Exact for what lies on the box's sides.
 */
#ifndef LIB_LOCAL_CUBE_GLSL
#define LIB_LOCAL_CUBE_GLSL

/* `dir` may be of any length. It is the result itself, as if all lay infinitely far away, where a
 * point outside the box, a box inside out or a length of 0 leaves no other. */
vec3 local_cube_dir(vec3 point, vec3 dir, vec3 low, vec3 high, vec3 captured)
{
    bool inside = all(greaterThanEqual(point, low)) && all(lessThanEqual(point, high));
    bvec3 flat_dir = equal(dir, vec3(0.0));
    vec3 sides = mix(low, high, greaterThan(dir, vec3(0.0)));
    vec3 reach = (sides - point) / mix(dir, vec3(1.0), flat_dir);
    reach = mix(reach, vec3(1e30), flat_dir); /* along a side, never met */
    float t = min(min(reach.x, reach.y), reach.z);
    vec3 found = point + t * dir - captured;
    return inside && t >= 0.0 && t < 1e30 && found != vec3(0.0) ? found : dir;
}

#endif
