/* object_names.h: the object names for the IDs in the layer `object`. */
#ifndef FIRN_APP_OBJECT_NAMES_H
#define FIRN_APP_OBJECT_NAMES_H

#include "src/scene/scene.h"

/* Returns lines "ID NAME", to be freed by the caller: refractive objects, then surroundings that
 * are not objects, then opaque objects. NULL when out of memory. */
char *object_names(const struct scene *scene);

#endif
