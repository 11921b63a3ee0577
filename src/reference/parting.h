/* parting.h: how light that meets a surface parts: reflection and refraction. */
#ifndef FIRN_REFERENCE_PARTING_H
#define FIRN_REFERENCE_PARTING_H

#include "src/reference/tracing.h"

/* Reflection and refraction at an object's surface. */
struct parting {
    float fresnel; /* reflectance; 1: total reflection */
    vec3s colors;  /* the same for red, green and blue light, whose mean it is */
    vec3s reflected, refracted;
    float reflected_share, refracted_share; /* of the light in these directions: what a rough
                                               surface does not mask */
};

/* A ray's meeting with an object. */
struct meeting {
    struct bvh_hit hit;
    struct media_crossing crossing;
    uint32_t channel; /* colour of the light, for dispersion */
    uint32_t seed;
    struct dress dress; /* with textures */
    vec3s normal;       /* outward, interpolated; as the normal texture bends it */
    bool is_bent;
};

/* Parts the light of a ray at a crack, at a smooth surface or, at one of its microfacets, a rough
 * one. */
struct parting parting_at(const struct tracing *tracing, vec3s dir, const struct meeting *meeting);

/* In double. */
static inline double parting_dot(vec3s a, vec3s b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

#endif
