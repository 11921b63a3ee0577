/* dielectric_split.h: splits light at a dielectric surface into reflection and refraction. */
#ifndef FIRN_LAB_REFERENCE_DIELECTRIC_SPLIT_H
#define FIRN_LAB_REFERENCE_DIELECTRIC_SPLIT_H

#include "src/lab/reference/tracer_context.h"

/* Reflected and refracted direction at a surface, with their weights. */
struct dielectric_split {
    float fresnel; /* Fresnel reflectance; 1 for total reflection */
    vec3s colors;  /* reflectance per colour channel */
    vec3s reflected, refracted;
    float reflected_masking, refracted_masking; /* masking-shadowing factors, 0 to 1 */
};

/* Hit of a ray on an object, with the media on both sides and the surface material. */
struct surface_hit {
    struct embree_scene_hit hit;
    struct nested_media_crossing crossing;
    struct nested_media_changes changes; /* of the objects around the ray */
    uint32_t channel;                    /* traced colour channel, for dispersion */
    uint32_t seed;
    struct object_material material; /* surface material, textures included */
    vec3s normal;                    /* outward shading normal */
    bool is_bent;
};

/* Computes reflection and refraction of a ray at a hit. Rough surfaces sample one microfacet. */
struct dielectric_split dielectric_split_at(const struct tracer *tracing, vec3s dir,
                                            const struct surface_hit *surface_hit);

static inline double dielectric_split_dot(vec3s a, vec3s b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

#endif
