/* highlight.h: Blinn-Phong highlights of the light sources on the ice's front faces. */
#ifndef FIRN_TECH_LIGHTING_HIGHLIGHT_H
#define FIRN_TECH_LIGHTING_HIGHLIGHT_H
#include "src/tech/technique.h"

/* Radiance of the highlights, drawn by the refraction model; negative in pixels without ice. */
extern const struct rg_image highlight_radiance;

extern const struct technique highlight;
extern const struct setting_group highlight_settings; /* struct highlight_params */

#endif
