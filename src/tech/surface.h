/* surface.h: Blinn-Phong highlights of the light sources on the ice's front faces. */
#ifndef TECH_SURFACE_H
#define TECH_SURFACE_H
#include "src/tech/technique.h"

/* Radiance of the highlights, drawn by the refraction model; negative in pixels without ice. */
extern const struct rg_image surface_highlight;

extern const struct technique surface;
extern const struct setting_group surface_settings; /* struct surface_params */

#endif
