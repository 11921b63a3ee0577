/* trace_settings.h: settings of the ray tracer and the features that a scene needs from it. */
#ifndef FIRN_TECH_TRACE_TRACE_SETTINGS_H
#define FIRN_TECH_TRACE_TRACE_SETTINGS_H
#include "src/scene/scene.h"
#include "src/settings/settings.h"

enum trace_surroundings {
    TRACE_AUTO,
    TRACE_CUBE, /* the environment cube */
    TRACE_RAYS, /* the triangles of the surroundings */
};

enum trace_rays_by {
    TRACE_BY_DEVICE, /* the faster one on this device */
    TRACE_BY_BVH,
    TRACE_BY_QUERY, /* hardware ray queries, if available */
};

struct trace_params {
    float branch;          /* minimum throughput; below 0: automatic */
    uint32_t surroundings; /* enum trace_surroundings */
    uint32_t rays;         /* enum trace_rays_by */
    uint32_t footprint;    /* footprint: 1 to filter lookups by ray differentials, else 0 */
};

extern const struct setting_group trace_settings;

/* Returns the feature bits of CONSTANT_TRACE that a scene needs. */
uint32_t trace_features(const struct scene *scene, const struct settings *settings);

/* Returns true if the diffuse lighting of surroundings is ray traced and some of them are lit. */
bool trace_has_diffuse_light(const struct scene *scene, const struct settings *settings);

/* Returns true if rays that leave the objects are traced to the triangles of the surroundings.
 * trace.surroundings=auto traces them for traced lighting, for several objects and for near
 * surroundings. It also traces them for objects that scatter, are textured or are partly opaque. */
bool trace_hits_surroundings(const struct scene *scene, const struct settings *settings);

/* Returns true if objects or surroundings may rotate. */
bool trace_has_motion(const struct settings *settings);

/* Returns the setting trace.min_branch: the throughput below which Russian roulette decides whether
 * a reflection is followed. `auto` is lower if all objects are clear and rays hit the surroundings.
 */
float trace_branch_throughput(const struct scene *scene, const struct settings *settings);

#endif
