/*
 * melt_parts.h: what follows ice that melts: shells of air that were in it, and of water below it.
 *
 * A mesh has many shells, whose parts are not connected with each other.
 */
#ifndef FIRN_SCENE_MELT_PARTS_H
#define FIRN_SCENE_MELT_PARTS_H

#include "src/scene/depth_field.h"
#include "src/scene/import/model.h"

/* Ice that has melted. */
struct melt_parts_ice {
    const struct object *object; /* of the model, which has it melted; its box is that before */
    const struct mesh *grown;    /* the mesh of all objects before, where the ice has sunk to */
    float half;                  /* of its width, before, metres */
    float rise;                  /* by which it has moved up, metres */
    float spread;                /* radius that the water which it lost covers, metres */
    struct depth_field depth, depth_before; /* found when they are needed; {0} */
};

/* Moves the parts of an object that were in the ice with it, shrinks those that are near its
 * surface, and makes those that are outside of it points. Returns false when out of memory. */
bool melt_parts_shrink(struct model *model, uint32_t object, struct melt_parts_ice *ice);

/* Spreads the parts of an object that are below the ice, and on which it stands. Returns false when
 * out of memory. */
bool melt_parts_spread(struct model *model, uint32_t object, const struct melt_parts_ice *ice);

/* The same of films of water on what is around the objects (MATERIAL_IS_FILM). They go down with
 * the ground; where it rises they stay level, so that it rises out of them. Textures stay where
 * they are. */
bool melt_parts_spread_films(struct model *model, const struct melt_parts_ice *ice);

void melt_parts_finish(struct melt_parts_ice *ice);

/* Returns the depth at a point below a field's surface, metres; 0 outside. */
float melt_parts_depth(const struct depth_field *field, vec3s point);

#endif
