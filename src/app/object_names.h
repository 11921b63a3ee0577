/* object_names.h: the object names for the IDs in the layer `object`. */
#ifndef FIRN_APP_OBJECT_NAMES_H
#define FIRN_APP_OBJECT_NAMES_H

#include "src/scene/scene.h"

/* Returns lines "ID NAME", to be freed by the caller: one for each refractive object, one for the
 * unnamed surroundings, and one for each opaque object. NULL when out of memory. */
char *object_names(const struct scene *scene);

#endif
