/* tracer_context.h: state shared by all rays of an image: scene, media, inclusions, photon map. */
#ifndef FIRN_LAB_REFERENCE_TRACER_CONTEXT_H
#define FIRN_LAB_REFERENCE_TRACER_CONTEXT_H

#include "src/lab/reference/inclusion_shading.h"
#include "src/lab/reference/nested_media.h"
#include "src/lab/reference/volume_scattering.h"
#include "src/tech/refract/cpu_reference_settings.h"

enum {
    TRACER_CHANNEL_COUNT = 3 /* red, green, blue */
};

struct pool_scene;
struct photons;

struct tracer {
    const struct embree_scene *embree_scene;
    const struct radiance *radiance;
    const struct nested_media *media;
    const struct inclusions *inclusions;
    struct volume_scattering scattering_media[MEDIUM_MAX]; /* nonempty scattering media */
    uint32_t scattering_media_count;
    const struct pool_scene *pool_scene;          /* NULL if the scene has none */
    const struct photons *photons;                /* NULL without effects on sunlight */
    const struct first_surface_previous *earlier; /* NULL if nothing moves */
    vec3s expected_radiance;                      /* of paths that Russian roulette may terminate */
    vec4s guide;                           /* guide of image_based_lighting_dominant_cone() */
    struct nested_media_set camera_inside; /* objects that contain the camera */
    bool has_layers;                       /* computes all layers of the image */
    uint32_t sample;                       /* sample index within its pixel */
    struct reference_params params;
};

static inline const struct frame_medium *tracer_medium(const struct tracer *tracing, uint32_t index)
{
    return &tracing->media->all[index];
}

/* Returns the number of paths per camera ray: one per colour channel with dispersion, else one. */
static inline uint32_t tracer_channel_count(const struct tracer *tracing)
{
    return tracing->media->is_dispersive ? TRACER_CHANNEL_COUNT : 1;
}

/* Returns a vector that is 1 for the colour channels of a path and 0 for the others. */
static inline vec3s tracer_channels(const struct tracer *tracing, uint32_t path)
{
    const bool all = !tracing->media->is_dispersive;
    return (vec3s){ { all || path == 0 ? 1.0f : 0.0f, all || path == 1 ? 1.0f : 0.0f,
                      all || path == 2 ? 1.0f : 0.0f } };
}

#endif
