/*
 * within.glsl: screen-space intersection of refracted rays with cracks or bubbles.
 *
 * An image holds the inclusions as seen along unrefracted rays. A refracted ray hits what the image
 * shows beside the ray's own pixel, so the ray is marched through it. Red is a depth from 1 to 2
 * through the object's bounding sphere along the view axis; 0 if there is no inclusion.
 */
#ifndef WITHIN_GLSL
#define WITHIN_GLSL

const uint within_steps = 8u;    /* ray marching steps through the object's bounding sphere */
const uint within_nearings = 2u; /* iterations that refine the hit within its step */
const float within_none = 1e30;

struct within_ray {
    vec4 from, way;    /* in image texels: x / w and y / w, relative to the centre of the first */
    float depth, pace; /* depth at the origin, and its change with length, never 0 */
    bool is_across;    /* crosses the view at a large angle: steep inclusions can be hit */
};

/* Returns the depth of a point; `from_center` is its offset from the bounding sphere's centre. */
float within_depth(vec3 from_center, vec3 forward, float radius)
{
    return clamp(1.5 + 0.5 * dot(from_center, forward) / radius, 1.0, 2.0);
}

ivec2 within_texel(within_ray ray, float t)
{
    vec4 at = fma(vec4(t), ray.way, ray.from);
    return ivec2(at.xy / at.w + 0.5);
}

/* Returns how much deeper the image's inclusion is than the ray at distance `t`; below -2 if none.
 */
float within_room(sampler2D image, within_ray ray, float t)
{
    float depth = texelFetch(image, within_texel(ray, t), 0).r;
    return (depth > 0.0 ? depth : -9.0) - (ray.depth + t * ray.pace);
}

/* Returns the distance along a ray to the inclusion that it hits, or within_none. `most` is the
 * distance to the bounding sphere. */
float within_find(sampler2D image, within_ray ray, float most)
{
    float step_length = most / float(within_steps);
    float sense = ray.pace < 0.0 ? -1.0 : 1.0;
    float half_step = 0.5 * step_length * abs(ray.pace);
    float found = within_none;
    float closing = ray.pace; /* change of the depth difference with length */
    float before = -9.0;
    for (uint i = 0u; i < within_steps; i++) {
        float t = (float(i) + 0.5) * step_length;
        float room = within_room(image, ray, t);
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
    for (uint i = 0u; i < within_nearings && found < within_none; i++) {
        float t = nearer + within_room(image, ray, nearer) / closing;
        t = clamp(t, least, found + step_length);
        nearer = within_room(image, ray, t) > -2.0 ? t : nearer;
    }
    return nearer;
}

#endif
