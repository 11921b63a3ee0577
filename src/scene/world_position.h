/* world_position.h: positions in the coordinates of a model's file, in double precision. All other
 * positions of a scene are relative to model.origin. */
#ifndef FIRN_SCENE_WORLD_POSITION_H
#define FIRN_SCENE_WORLD_POSITION_H

#include "src/scene/import/model.h"

/* Returns true if the model's origin is not (0, 0, 0). */
bool world_position_is_far(const struct model *model);

/* Returns the number of significant digits with which to print a coordinate: `near`, or more if the
 * model is far from the origin. */
int world_position_digits(const struct model *model, int near);

/* Returns coordinate `axis` of a relative position in the file's coordinates: the shortest decimal
 * number that identifies it. */
double world_position_axis(const struct model *model, vec3s relative, int axis);

/* Returns a position given in the file's coordinates, relative to the model's origin. */
vec3s world_position_relative(const struct model *model, const double position[static 3]);

#endif
