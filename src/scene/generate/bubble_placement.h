/* bubble_placement.h: declarations shared by bubble_placement.c and frozen_bubbles.c. */
#ifndef FIRN_SCENE_GENERATE_BUBBLE_PLACEMENT_H
#define FIRN_SCENE_GENERATE_BUBBLE_PLACEMENT_H

#include "src/scene/generate/generate.h"

/* Returns the minimum distance to a closed surface along the three axes; 0 for points outside. */
float bubbles_clearance(const struct mesh *mesh, vec3s point);

/* Generates up to params->count bubbles of trapped air in the empty, allocated list `bubbles`. */
void bubbles_generate_frozen(struct bubbles *bubbles, const struct mesh *mesh,
                             const struct generate_bubbles *params);

#endif
