/* refract_bracket.glsl: bracket around the exit point of a ray, for the root search of ray
 * marching. */
#ifndef REFRACT_BRACKET_GLSL
#define REFRACT_BRACKET_GLSL

const float march_outside_silhouette =
    -1e30; /* signed distance assigned to points outside the silhouette */

/* Bracket of a ray's exit: the last distance inside and the first one outside. */
struct march_bracket {
    float within, beyond;
    float distance_within; /* signed distance to the face at `within`; 0 if not known */
    float distance_beyond;
    bool near_front; /* the front face is the nearer one at `within` */
};

/* Returns the root of the linearly interpolated signed distance, moved back by a quarter of
 * `exact`; the middle of the bracket if the distances are not known. */
float march_root(march_bracket ends, float exact)
{
    bool known = ends.distance_within > 0.0 && ends.distance_beyond < 0.0 &&
                 ends.distance_beyond > march_outside_silhouette;
    float share =
        known ? ends.distance_within / (ends.distance_within - ends.distance_beyond) : 0.5;
    return mix(ends.within, ends.beyond, share) - (known ? 0.25 * exact : 0.0);
}

#endif
