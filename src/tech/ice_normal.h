/* ice_normal.h: the normals of the ice's back faces, as the view sees them. */
#ifndef TECH_ICE_NORMAL_H
#define TECH_ICE_NORMAL_H
#include "src/technique.h"

/* xyz: outward, unit, world: away from the eye, never flipped; w: 1, or 0 where there is none */
extern const struct rg_image ice_normal_back;
extern const struct technique ice_normal;

#endif
