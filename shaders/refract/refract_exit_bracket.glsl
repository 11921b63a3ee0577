/* refract_exit_bracket.glsl: bracket around a ray's exit point, for the root search of ray
 * marching. */
#ifndef REFRACT_EXIT_BRACKET_GLSL
#define REFRACT_EXIT_BRACKET_GLSL

const float march_outside_silhouette = -1e30; /* signed distance there */

/* Bracket of a ray's exit: the last known distance inside the object, the first one outside. */
struct march_bracket {
    float within, beyond;
    float distance_within; /* signed distance to the face at `within`; 0 if unknown */
    float distance_beyond;
    bool near_front; /* front face is nearer at `within` */
};

/* Returns the estimated exit. If the signed distances are known, interpolates them linearly and
 * moves inwards by `exact` / 4. Otherwise, returns the middle of the bracket. */
float march_root(march_bracket ends, float exact)
{
    bool known = ends.distance_within > 0.0 && ends.distance_beyond < 0.0 &&
                 ends.distance_beyond > march_outside_silhouette;
    float fraction =
        known ? ends.distance_within / (ends.distance_within - ends.distance_beyond) : 0.5;
    return mix(ends.within, ends.beyond, fraction) - (known ? 0.25 * exact : 0.0);
}

#endif
