/* object_names.h: the names behind the numbers of the layer object. */
#ifndef FIRN_APP_OBJECT_NAMES_H
#define FIRN_APP_OBJECT_NAMES_H

#include "src/scene/scene.h"

/* Returns lines "NUMBER NAME", malloc'd: refractive objects by their nodes, then surfaces by their
 * materials. NULL when out of memory. */
char *object_names(const struct scene *scene);

#endif
