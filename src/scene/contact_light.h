/*
 * contact_light.h: where light comes from that a body brings to its foot.
 *
 * Rays go from the ground around a body into it, and are refracted, mirrored, absorbed and
 * scattered as its medium says, by chance: what leaves upwards sees the sky, what leaves downwards
 * the ground. A clear body loses nothing, so that even light stays even.
 */
#ifndef FIRN_SCENE_CONTACT_LIGHT_H
#define FIRN_SCENE_CONTACT_LIGHT_H

#include "src/scene/contact.h"

/* What fills a body evenly. */
struct contact_medium {
    float ior;        /* refractive index, by that of what is around it */
    float scattering; /* 1 / metre, as if light were scattered evenly to all sides */
    float shine;      /* share of the light on its surface that this reflects, matt */
    vec3s absorption; /* 1 / metre */
    vec3s tint;       /* of light that passes its surface, and of what that reflects matt */
};

/* Shares of the light of the sky and of the ground, together at most 1. */
struct contact_light {
    vec3s sky, ground;
    float straight; /* of the sky's, as much comes from nearly where the body is seen */
};

/* Returns the light that a body brings to the ground below it and near it; `up` is unit. The same
 * rays are followed in each call. */
struct contact_light contact_light_of(const struct contact_shape *shape,
                                      const struct contact_medium *medium, vec3s up);

#endif
