/* info_surroundings.h: lists a model's opaque objects with their materials, for firn info. */
#ifndef FIRN_APP_INFO_SURROUNDINGS_H
#define FIRN_APP_INFO_SURROUNDINGS_H

#include <jansson.h>
#include "src/scene/import/model.h"

/* Prints a table of the surroundings objects: name, triangles and materials. Prints nothing if
 * there are none, or when out of memory. */
void info_surroundings_print(const struct model *model);

/* Returns the surroundings objects as a JSON array; NULL when out of memory. */
json_t *info_surroundings_json(const struct model *model);

#endif
