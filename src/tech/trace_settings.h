/* trace_settings.h: settings of the rung trace, and what a scene makes of them. */
#ifndef TECH_TRACE_SETTINGS_H
#define TECH_TRACE_SETTINGS_H
#include "src/scene/scene.h"
#include "src/settings/settings.h"

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
    float branch;          /* share of a path's light from which a reflection is followed; below 0:
                              by the scene */
    uint32_t surroundings; /* enum trace_surroundings */
    uint32_t rays;         /* enum trace_rays_by */
    uint32_t footprint;    /* 0 or 1 */
};

extern const struct setting_group trace_settings;

/* Returns CONSTANT_TRACE. */
uint32_t trace_features(const struct scene *scene, const struct settings *settings);

/* Returns whether rays bring light to what is around the objects: where something of it is lit. */
bool trace_lights_surroundings(const struct scene *scene, const struct settings *settings);

/* Returns whether rays that leave the objects meet the triangles around them, as trace.surroundings
 * says. With `auto` they do if there are several objects, one that is cloudy, not wholly
 * transmissive or has textures, or a corner of the surroundings within two radii of the object's
 * middle. */
bool trace_meets_surroundings(const struct scene *scene, const struct settings *settings);

/* Returns whether objects, or what is around them, may turn. */
bool trace_has_motion(const struct settings *settings);

/* Returns the share of light from which reflections inside are followed, as trace.branch says. With
 * `auto` it is less if all objects are clear and rays meet what is around them. */
float trace_branch(const struct scene *scene, const struct settings *settings);

#endif
