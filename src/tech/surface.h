/* surface.h: highlights of the lights on the ice's front. */
#ifndef TECH_SURFACE_H
#define TECH_SURFACE_H
#include "src/technique.h"

extern const struct technique surface, surface_bumped;
extern const struct setting_group surface_settings; /* struct surface_params */

#endif
