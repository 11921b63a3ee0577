/* tracing.h: what all rays of a picture share. */
#ifndef FIRN_REFERENCE_TRACING_H
#define FIRN_REFERENCE_TRACING_H

#include "src/reference/cloud.h"
#include "src/reference/inclusions.h"
#include "src/reference/media.h"
#include "src/tech/refract_reference.h"

enum {
    TRACING_CHANNEL_COUNT = 3 /* red, green, blue */
};

struct basin;
struct photons;

struct tracing {
    const struct bvh *bvh;
    const struct radiance *radiance;
    const struct media *media;
    const struct inclusions *inclusions;
    struct cloud clouds[CLOUDS_MAX]; /* those that scatter anything */
    uint32_t cloud_count;
    const struct basin *basin;     /* NULL: the scene is no pool */
    const struct photons *photons; /* NULL: the sun shines everywhere, and is not refracted */
    const struct first_surface_earlier *earlier; /* for layers; NULL: nothing moves */
    vec4s guide;                                 /* surface_light_guide() */
    struct media_set eye_inside;                 /* whitted_immerse() of the eye */
    bool has_layers; /* else of what a ray sees only colour, alpha and remaining are of use */
    uint32_t sample; /* of a pixel; its random numbers are those of this index */
    struct reference_params params;
};

static inline const struct frame_medium *tracing_medium(const struct tracing *tracing,
                                                        uint32_t index)
{
    return &tracing->media->all[index];
}

/* Returns the number of paths of a ray, one for each channel or one of all. */
static inline uint32_t tracing_channel_count(const struct tracing *tracing)
{
    return tracing->media->is_dispersive ? TRACING_CHANNEL_COUNT : 1;
}

/* Returns the channels of a path, as factors. */
static inline vec3s tracing_channels(const struct tracing *tracing, uint32_t path)
{
    const bool all = !tracing->media->is_dispersive;
    return (vec3s){ { all || path == 0 ? 1.0f : 0.0f, all || path == 1 ? 1.0f : 0.0f,
                      all || path == 2 ? 1.0f : 0.0f } };
}

#endif
