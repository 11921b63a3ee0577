/* refract_bounce.h: refraction with total reflections inside. */
#ifndef TECH_REFRACT_BOUNCE_H
#define TECH_REFRACT_BOUNCE_H
#include "shaders/refract_bounce.h"
#include "src/tech/technique.h"

extern const struct technique refract_bounce;
extern const struct setting_group refract_bounce_settings;

/* Returns whether objects are drawn with those that are in them, and concave ones by more than
 * their nearest faces: as refract_bounce.nested says, if nothing has textures or tints. */
bool refract_bounce_is_nested(const struct settings *settings, const struct scene *scene);

#endif
