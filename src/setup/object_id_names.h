/* object_id_names.h: the object names for the IDs in the layer `object`. */
#ifndef FIRN_SETUP_OBJECT_ID_NAMES_H
#define FIRN_SETUP_OBJECT_ID_NAMES_H

#include "src/scene/scene.h"

/* Returns text with a line "ID NAME" for each refractive object, the unnamed surroundings and each
 * opaque object. The caller frees the text. Returns NULL when out of memory. */
char *object_names(const struct scene *scene);

#endif
