/* refract_way.glsl: the way of light through the ice, as rungs find it (refract_follow()). */
#ifndef REFRACT_WAY_GLSL
#define REFRACT_WAY_GLSL
#include "lib/optics.glsl"
#include "refract_front.glsl"

/* Light through the ice, against its direction: from the eye to where it leaves. */
struct refract_way {
    vec3 dir;      /* in which it leaves */
    vec3 point;    /* from where, world */
    float path;    /* inside, metres; 0 where a rung knows no back */
    float bounces; /* how often it is totally reflected inside */
    float tir;     /* 1 if so at the first surface that it meets inside, else 0 */
};

/* The rung's. `channel` is that of the colour: its index is refract_frame.etas[channel]. */
refract_way refract_follow(vec3 e, vec3 n_f, int channel);

vec3 refract_front_point()
{
    return refract_frame.eye + eye_to_point;
}

/* One bend at the front, and straight on from there. */
refract_way refract_leave_at_front(vec3 dir)
{
    return refract_way(dir, refract_front_point(), 0.0, 0.0, 0.0);
}

#endif
