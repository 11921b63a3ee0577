/*
 * inclusion_march.glsl: screen-space intersection of refracted rays with cracks or bubbles.
 *
 * An image holds the inclusions as seen along unrefracted rays. A refracted ray hits what the image
 * shows beside the ray's own pixel, so the ray is marched through it. Red is a depth from 1 to 2
 * through the object's bounding sphere along the view axis; 0 if there is no inclusion.
 */
#ifndef INCLUSION_MARCH_GLSL
#define INCLUSION_MARCH_GLSL

const uint inclusion_steps = 8u;       /* ray marching steps through the object's bounding sphere */
const uint inclusion_refinements = 2u; /* iterations that refine the hit within its step */
const float inclusion_none = 1e30;

struct inclusion_ray {
    vec4 from, way;    /* in image texels: x / w and y / w, relative to the centre of the first */
    float depth, pace; /* depth at the origin, and its change with length, never 0 */
    bool is_across;    /* crosses the view at a large angle: steep inclusions can be hit */
};

/* Returns the depth of a point; `from_center` is its offset from the bounding sphere's centre. */
float inclusion_depth(vec3 from_center, vec3 forward, float radius)
{
    return clamp(1.5 + 0.5 * dot(from_center, forward) / radius, 1.0, 2.0);
}

ivec2 inclusion_texel(inclusion_ray ray, float t)
{
    vec4 at = fma(vec4(t), ray.way, ray.from);
    return ivec2(at.xy / at.w + 0.5);
}

/* Returns how much deeper the image's inclusion is than the ray at distance `t`; below -2 if none.
 */
float inclusion_depth_difference(sampler2D image, inclusion_ray ray, float t)
{
    float depth = texelFetch(image, inclusion_texel(ray, t), 0).r;
    return (depth > 0.0 ? depth : -9.0) - (ray.depth + t * ray.pace);
}

/* Returns the distance along a ray to the inclusion that it hits, or inclusion_none. `most` is the
 * distance to the bounding sphere. */
float inclusion_find(sampler2D image, inclusion_ray ray, float most)
{
    float step_length = most / float(inclusion_steps);
    float sense = ray.pace < 0.0 ? -1.0 : 1.0;
    float half_step = 0.5 * step_length * abs(ray.pace);
    float found = inclusion_none;
    float closing = ray.pace; /* change of the depth difference with length */
    float before = -9.0;
    for (uint i = 0u; i < inclusion_steps; i++) {
        float t = (float(i) + 0.5) * step_length;
        float room = inclusion_depth_difference(image, ray, t);
        bool is_shown = room > -2.0;
        bool crosses = before > 0.0 && is_shown;
        room *= sense;
        if (room <= half_step && (room > -half_step || crosses)) {
            found = t;
            if (ray.is_across && before > -2.0)
                closing = sense * max((before - room) / step_length, 0.25 * abs(ray.pace));
            break;
        }
        before = is_shown ? room : -9.0;
    }
    float least = max(found - step_length, 0.0), nearer = found;
    for (uint i = 0u; i < inclusion_refinements && found < inclusion_none; i++) {
        float t = nearer + inclusion_depth_difference(image, ray, nearer) / closing;
        t = clamp(t, least, found + step_length);
        nearer = inclusion_depth_difference(image, ray, t) > -2.0 ? t : nearer;
    }
    return nearer;
}

#endif
