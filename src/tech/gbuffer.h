/* gbuffer.h: where and how the first visible surface lies, of ice and surroundings alike. */
#ifndef TECH_GBUFFER_H
#define TECH_GBUFFER_H
#include "src/tech/technique.h"

extern const struct rg_image gbuffer_normal;   /* xyz: unit, outward, world; 0: no surface */
extern const struct rg_image gbuffer_position; /* xyz: world, metres; w: along the view's axis */
extern const struct rg_image gbuffer_depth;    /* of both; reversed */
extern const struct technique gbuffer;

/* gbuffer_position.w where no surface is seen: farther than any surface, yet a number. */
#define GBUFFER_NOTHING 1e10f

#endif
