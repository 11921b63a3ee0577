/* refract_ends.glsl: two points of a ray, one inside and one outside, between which it leaves. */
#ifndef REFRACT_ENDS_GLSL
#define REFRACT_ENDS_GLSL

const float march_beside = -1e30; /* room of a point beside the silhouette */

/* Two points of a ray, between which it leaves. */
struct march_ends {
    float within, beyond;
    float room_within; /* 0: not known */
    float room_beyond;
    bool near_front; /* at `within` */
};

/* Returns the point a little before that at which linearly interpolated room is 0, or the middle if
 * the room is not known. */
float march_divide(march_ends ends, float exact)
{
    bool known =
        ends.room_within > 0.0 && ends.room_beyond < 0.0 && ends.room_beyond > march_beside;
    float share = known ? ends.room_within / (ends.room_within - ends.room_beyond) : 0.5;
    return mix(ends.within, ends.beyond, share) - (known ? 0.25 * exact : 0.0);
}

#endif
