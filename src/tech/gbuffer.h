/* gbuffer.h: normal, position and depth of the first visible surface, of ice or surroundings. */
#ifndef TECH_GBUFFER_H
#define TECH_GBUFFER_H
#include "shaders/gbuffer.h"
#include "src/tech/technique.h"

extern const struct rg_image gbuffer_normal;   /* xyz: unit, outward, world; 0: no surface */
extern const struct rg_image gbuffer_position; /* xyz: world, metres; w: distance along the view's
                                                  axis, metres, or GBUFFER_NOTHING */
extern const struct rg_image gbuffer_depth;    /* depth buffer of both; reversed */
extern const struct technique gbuffer;

#endif
