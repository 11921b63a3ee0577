/* node_material.h: materials in place of those that a model's nodes have. */
#ifndef FIRN_SCENE_NODE_MATERIAL_H
#define FIRN_SCENE_NODE_MATERIAL_H

#include "src/scene/import/model.h"

struct node_material {
    const char *words;             /* that say it, "NODE=glass,ior=1.52"; borrowed */
    char name[MATERIAL_NAME_SIZE]; /* of a node with a mesh; if there is none, of a material */
    struct material material;      /* transmissive */
};

/* Returns the names as struct model_pose wants them, or NULL when out of memory. The caller frees
 * them. */
char *node_material_names(const struct node_material *all, uint32_t count);

/*
 * Gives the objects of a model these materials, a later one in place of an earlier one; the index
 * of the first object becomes the model's. Names that no object has change nothing. Logs and
 * returns STATUS_DATA for too many materials, or STATUS_TRY_AGAIN when out of memory.
 */
MUST_USE enum status node_material_apply(struct model *model, const struct node_material *all,
                                         uint32_t count);

#endif
