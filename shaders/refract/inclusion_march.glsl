/*
 * inclusion_march.glsl: screen-space intersection of refracted rays with cracks.
 *
 * An image holds the inclusions that are visible along unrefracted rays. A refracted ray is marched
 * through it, because it hits what the image shows beside the ray's own pixel. Red is a depth from
 * 1 to 2 through the object's bounding sphere along the view axis; 0 without inclusion.
 */
#ifndef INCLUSION_MARCH_GLSL
#define INCLUSION_MARCH_GLSL

const uint inclusion_steps = 8u;       /* marching steps per ray */
const uint inclusion_refinements = 2u; /* iterations that refine a hit */
const float inclusion_none = 1e30;

struct inclusion_ray {
    vec4 from, dir;    /* origin and direction, projected to texels */
    float depth;       /* depth at the origin */
    float depth_slope; /* depth per unit distance, never 0 */
    bool is_across;    /* over 45 degrees to view axis */
};

/* Returns a point's depth in the bounding sphere, from 1 at the near end to 2 at the far end. */
float inclusion_depth(vec3 from_center, vec3 forward, float radius)
{
    return clamp(1.5 + 0.5 * dot(from_center, forward) / radius, 1.0, 2.0);
}

ivec2 inclusion_texel(inclusion_ray ray, float t)
{
    vec4 at = fma(vec4(t), ray.dir, ray.from);
    return ivec2(at.xy / at.w + 0.5);
}

/* Returns an inclusion's depth minus the ray's depth at `t`, or less than -2 if there is none. */
float inclusion_depth_difference(sampler2D image, inclusion_ray ray, float t)
{
    float depth = texelFetch(image, inclusion_texel(ray, t), 0).r;
    return (depth > 0.0 ? depth : -9.0) - (ray.depth + t * ray.depth_slope);
}

/* Returns a ray's distance to the first inclusion up to `max_t`, or inclusion_none. */
float inclusion_find(sampler2D image, inclusion_ray ray, float max_t)
{
    float step_length = max_t / float(inclusion_steps);
    float sense = ray.depth_slope < 0.0 ? -1.0 : 1.0;
    float half_step = 0.5 * step_length * abs(ray.depth_slope);
    float found = inclusion_none;
    float slope = ray.depth_slope; /* derivative of the depth difference */
    float previous = -9.0;
    for (uint i = 0u; i < inclusion_steps; i++) {
        float t = (float(i) + 0.5) * step_length;
        float diff = inclusion_depth_difference(image, ray, t);
        bool is_shown = diff > -2.0;
        bool crosses = previous > 0.0 && is_shown;
        diff *= sense;
        if (diff <= half_step && (diff > -half_step || crosses)) {
            found = t;
            if (ray.is_across && previous > -2.0)
                slope = sense * max((previous - diff) / step_length, 0.25 * abs(ray.depth_slope));
            break;
        }
        previous = is_shown ? diff : -9.0;
    }
    float min_t = max(found - step_length, 0.0), nearer = found;
    for (uint i = 0u; i < inclusion_refinements && found < inclusion_none; i++) {
        float t = nearer + inclusion_depth_difference(image, ray, nearer) / slope;
        t = clamp(t, min_t, found + step_length);
        nearer = inclusion_depth_difference(image, ray, t) > -2.0 ? t : nearer;
    }
    return nearer;
}

#endif
