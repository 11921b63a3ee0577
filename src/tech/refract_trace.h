/* refract_trace.h: refraction through the triangles of the whole scene. */
#ifndef TECH_REFRACT_TRACE_H
#define TECH_REFRACT_TRACE_H
#include "src/tech/technique.h"

enum trace_surroundings {
    TRACE_AUTO,
    TRACE_CUBE, /* the environment cube */
    TRACE_RAYS, /* the triangles around the objects */
};

enum trace_rays_by {
    TRACE_BY_DEVICE, /* what is faster */
    TRACE_BY_TREE,
    TRACE_BY_QUERY, /* ray queries of the device, if it has them */
};

struct trace_params {
    float branch;          /* share of a path's light from which a reflection is followed */
    uint32_t surroundings; /* enum trace_surroundings */
    uint32_t rays;         /* enum trace_rays_by */
    uint32_t footprint;    /* 0 or 1 */
};

/* Number of straight parts of the refracted path inside objects. */
extern const struct rg_image trace_media;

/* Number of the last object of the refracted path. */
extern const struct rg_image trace_last;

extern const struct setting_group trace_settings;
extern const struct technique refract_trace;

#endif
