/* refract_ends.glsl: bracket around the exit point of a ray, for the root search of ray marching.
 */
#ifndef REFRACT_ENDS_GLSL
#define REFRACT_ENDS_GLSL

const float march_beside = -1e30; /* signed distance assigned to points outside the silhouette */

/* Bracket of a ray's exit: the last distance inside and the first one outside. */
struct march_ends {
    float within, beyond;
    float room_within; /* signed distance to the face at `within`; 0 if not known */
    float room_beyond;
    bool near_front; /* the front face is the nearer one at `within` */
};

/* Returns the root of the linearly interpolated signed distance, moved back by a quarter of
 * `exact`; the middle of the bracket if the distances are not known. */
float march_divide(march_ends ends, float exact)
{
    bool known =
        ends.room_within > 0.0 && ends.room_beyond < 0.0 && ends.room_beyond > march_beside;
    float share = known ? ends.room_within / (ends.room_within - ends.room_beyond) : 0.5;
    return mix(ends.within, ends.beyond, share) - (known ? 0.25 * exact : 0.0);
}

#endif
