/* gbuffer.h: where and how the first visible surface lies, of ice and surroundings alike. */
#ifndef TECH_GBUFFER_H
#define TECH_GBUFFER_H
#include "shaders/gbuffer.h"
#include "src/tech/technique.h"

extern const struct rg_image gbuffer_normal;   /* xyz: unit, outward, world; 0: no surface */
extern const struct rg_image gbuffer_position; /* xyz: world, metres; w: along the view's axis,
                                                  or GBUFFER_NOTHING */
extern const struct rg_image gbuffer_depth;    /* of both; reversed */
extern const struct technique gbuffer;

#endif
