/* object_id_names.h: names of the IDs in the layers `object` and `material`. */
#ifndef FIRN_SETUP_OBJECT_ID_NAMES_H
#define FIRN_SETUP_OBJECT_ID_NAMES_H

#include "src/scene/scene.h"

/* Returns text that the caller frees, or NULL if out of memory. Each line is "ID NAME". The lines
 * are the refractive objects, then the unnamed surroundings, then the opaque objects. */
char *object_names(const struct scene *scene);

/* Returns the same for materials. */
char *material_names(const struct scene *scene);

#endif
