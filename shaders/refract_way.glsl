/* refract_way.glsl: the path of light through the ice, which rungs compute (refract_follow()). */
#ifndef REFRACT_WAY_GLSL
#define REFRACT_WAY_GLSL
#include "lib/optics.glsl"
#include "refract_front.glsl"

/* A path through the ice, traced from the eye. */
struct refract_way {
    vec3 dir;      /* direction in which it leaves */
    vec3 point;    /* point at which it leaves, world */
    float path;    /* length inside, metres; 0 if the rung does not compute it */
    float bounces; /* number of total reflections inside */
    float tir;     /* 1 if the first inner surface reflects totally, else 0 */
};

/* Each rung defines this function. The refractive index of a channel is
 * refract_frame.etas[channel]. */
refract_way refract_follow(vec3 e, vec3 n_f, int channel);

vec3 refract_front_point()
{
    return refract_frame.eye + eye_to_point;
}

/* Returns a path with one bend at the front. */
refract_way refract_leave_at_front(vec3 dir)
{
    return refract_way(dir, refract_front_point(), 0.0, 0.0, 0.0);
}

#endif
