/* offer_materials.h: suggests --material for blended surfaces with names of clear materials. */
#ifndef FIRN_SETUP_OFFER_MATERIALS_H
#define FIRN_SETUP_OFFER_MATERIALS_H

#include "src/scene/import/model.h"

/* Returns the preset that a name suggests, such as "glass" for "Glass.001"; NULL for none. */
const char *offer_material_for(const char *name);

/* Logs a note if alpha-blended surfaces of a glTF file are named glass, crystal, diamond, water or
 * ice, or their nodes are. The note has the options that draw them as such. */
void offer_materials(const char *path, const struct model *model);

#endif
