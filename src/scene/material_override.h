/* material_override.h: overrides (--material) of the materials of a model's nodes. */
#ifndef FIRN_SCENE_MATERIAL_OVERRIDE_H
#define FIRN_SCENE_MATERIAL_OVERRIDE_H

#include "src/scene/import/model.h"

enum {
    MATERIAL_OVERRIDE_SIZE = 256, /* size of an option's text in bytes, terminator included */
};

struct material_override {
    char words[MATERIAL_OVERRIDE_SIZE]; /* text of the option, "NODE=glass,ior=1.52" */
    char name[MATERIAL_NAME_SIZE];      /* name of mesh nodes or, failing that, of a material */
    struct material material;
};

/* Returns all override names in the format of model_pose.objects. The caller frees the result.
 * Returns NULL when out of memory. */
char *material_override_names(const struct material_override *all, uint32_t count);

/* Assigns materials to a model's objects by name. Later overrides win. Unknown names are ignored.
 * Sets the model's refractive index to that of the first object. On failure, logs an error and
 * returns STATUS_DATA (too many materials) or STATUS_TRY_AGAIN (out of memory). */
MUST_USE enum status material_override_apply(struct model *model,
                                             const struct material_override *all, uint32_t count);

#endif
