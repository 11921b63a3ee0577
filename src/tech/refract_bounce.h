/* refract_bounce.h: refraction with total reflections inside. */
#ifndef TECH_REFRACT_BOUNCE_H
#define TECH_REFRACT_BOUNCE_H
#include "shaders/refract_bounce.h"
#include "src/tech/technique.h"

extern const struct technique refract_bounce;
extern const struct setting_group refract_bounce_settings;

#endif
