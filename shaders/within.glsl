/*
 * within.glsl: where a ray inside an object meets what an image shows of the straight rays' view of
 * it, such as cracks or bubbles: the surface has bent the ray, so it meets what the picture shows
 * beside its own pixel.
 *
 * Red of such an image is a depth, 0 where there is nothing: 1 to 2 through the object's bounding
 * sphere along the view's axis.
 */
#ifndef WITHIN_GLSL
#define WITHIN_GLSL

const uint within_steps = 8u;    /* of a ray through the object's bounding sphere */
const uint within_nearings = 2u; /* of the place in the step that met something */
const float within_none = 1e30;

struct within_ray {
    vec4 from, way;    /* in texels of the image: x / w and y / w, from the middle of the first */
    float depth, pace; /* at the start, and its growth with length, which is not 0 */
    bool is_across;    /* it goes across the view: what it meets may be steeper than it is */
};

/* Returns the depth of a point that is `from_center` of a sphere away. */
float within_depth(vec3 from_center, vec3 forward, float radius)
{
    return clamp(1.5 + 0.5 * dot(from_center, forward) / radius, 1.0, 2.0);
}

ivec2 within_texel(within_ray ray, float t)
{
    vec4 at = fma(vec4(t), ray.way, ray.from);
    return ivec2(at.xy / at.w + 0.5);
}

/* Returns how much farther than a place of a ray what the image shows there is, in depths; below
 * -2 where it shows nothing. */
float within_room(sampler2D image, within_ray ray, float t)
{
    float depth = texelFetch(image, within_texel(ray, t), 0).r;
    return (depth > 0.0 ? depth : -9.0) - (ray.depth + t * ray.pace);
}

/* Returns the length of a ray to what it meets, or within_none. `most` is its length through the
 * sphere. */
float within_find(sampler2D image, within_ray ray, float most)
{
    float step_length = most / float(within_steps);
    float sense = ray.pace < 0.0 ? -1.0 : 1.0;
    float half_step = 0.5 * step_length * abs(ray.pace);
    float found = within_none;
    float closing = ray.pace; /* by which the room shrinks with length */
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
