/* tracing.h: what all rays of a picture share. */
#ifndef FIRN_REFERENCE_TRACING_H
#define FIRN_REFERENCE_TRACING_H

#include "src/reference/cloud.h"
#include "src/reference/inclusions.h"
#include "src/reference/media.h"
#include "src/tech/refract_reference.h"

struct tracing {
    const struct bvh *bvh;
    const struct radiance *radiance;
    const struct media *media;
    const struct inclusions *inclusions;
    struct cloud cloud;
    struct media_set eye_inside; /* whitted_immerse() of the eye */
    uint32_t sample;             /* of a pixel; its random numbers are those of this index */
    struct reference_params params;
};

static inline const struct frame_medium *tracing_medium(const struct tracing *tracing,
                                                        uint32_t index)
{
    return &tracing->media->all[index];
}

#endif
