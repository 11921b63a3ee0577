/* bubbles.h: shared by bubbles.c and bubbles_grown.c. */
#ifndef FIRN_SCENE_GENERATE_BUBBLES_H
#define FIRN_SCENE_GENERATE_BUBBLES_H

#include "src/scene/generate/generate.h"

/* Returns the least distance of a closed surface along the three axes, or 0 for points outside. */
float bubbles_clearance(const struct mesh *mesh, vec3s point);

/* Adds bubbles to none, up to params->count; there is room for so many. */
void bubbles_grow(struct bubbles *bubbles, const struct mesh *mesh,
                  const struct generate_bubbles *params);

#endif
