/* refract_exit_bracket.glsl: interval around a ray's exit point, which ray marching refines. */
#ifndef REFRACT_EXIT_BRACKET_GLSL
#define REFRACT_EXIT_BRACKET_GLSL

const float march_outside_silhouette = -1e30; /* signed distance there */

/* Bracket of a ray's exit: the last known distance inside the object, and the first one outside. */
struct march_bracket {
    float within, beyond;
    float distance_within; /* signed distance at `within`, or 0 */
    float distance_beyond;
    bool near_front; /* front face is nearer at `within` */
};

/* Returns the estimated distance of the exit, from signed distances by interpolation. Subtracts
 * `exact` / 4 to stay inside. If a signed distance is unknown, returns the bracket's middle. */
float march_root(march_bracket ends, float exact)
{
    bool known = ends.distance_within > 0.0 && ends.distance_beyond < 0.0 &&
                 ends.distance_beyond > march_outside_silhouette;
    float fraction =
        known ? ends.distance_within / (ends.distance_within - ends.distance_beyond) : 0.5;
    return mix(ends.within, ends.beyond, fraction) - (known ? 0.25 * exact : 0.0);
}

#endif
