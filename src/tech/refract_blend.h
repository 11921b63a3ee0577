/* refract_blend.h: two-sided refraction by one normal that bends more. */
#ifndef TECH_REFRACT_BLEND_H
#define TECH_REFRACT_BLEND_H
#include "src/tech/technique.h"

extern const struct technique refract_blend[], refract_blend_bumped[];
extern const struct setting_group refract_blend_settings;

#endif
