/* surface.h: highlights of the lights on the ice's front. */
#ifndef TECH_SURFACE_H
#define TECH_SURFACE_H
#include "src/tech/technique.h"

/* Radiance of the highlights; below 0 in pixels without ice. A rung's row writes it. */
extern const struct rg_image surface_highlight;

extern const struct technique surface;
extern const struct setting_group surface_settings; /* struct surface_params */

#endif
