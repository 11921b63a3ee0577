/* object_id_names.h: the object names for the IDs in the layer `object`. */
#ifndef FIRN_SETUP_OBJECT_ID_NAMES_H
#define FIRN_SETUP_OBJECT_ID_NAMES_H

#include "src/scene/scene.h"

/* Returns text that the caller frees, or NULL if out of memory. Each line is "ID NAME". The lines
 * are the refractive objects, then the unnamed surroundings, then the opaque objects. */
char *object_names(const struct scene *scene);

#endif
