/* refract_bounce.h: refraction model with total internal reflections. */
#ifndef FIRN_TECH_REFRACT_REFRACT_BOUNCE_H
#define FIRN_TECH_REFRACT_REFRACT_BOUNCE_H
#include "shaders/refract/refract_bounce.h"
#include "src/tech/technique.h"

/* BVH of the bubbles, an array of struct bubbles_node in world space; bubbles.c fills it. */
extern const struct rg_buffer bubbles_bvh;

extern const struct technique refract_bounce;
extern const struct setting_group refract_bounce_settings;

/* Returns true if the model renders all faces of concave and nested objects (setting
 * refract_bounce.nested). It cannot if an object is textured or tinted, or if cracks refract. */
bool refract_bounce_is_nested(const struct settings *settings, const struct scene *scene);

#endif
