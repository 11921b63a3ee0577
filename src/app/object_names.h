/* object_names.h: the names behind the numbers of the layer object. */
#ifndef FIRN_APP_OBJECT_NAMES_H
#define FIRN_APP_OBJECT_NAMES_H

#include "src/scene/scene.h"

/* Returns lines "NUMBER NAME", malloc'd: refractive objects, then what surrounds them without
 * being an object, then opaque objects. NULL when out of memory. */
char *object_names(const struct scene *scene);

#endif
