/* melt_inclusions_and_water.h: moves air pockets inside melting ice, and water below the ice. */
#ifndef FIRN_SCENE_MELT_MELT_INCLUSIONS_AND_WATER_H
#define FIRN_SCENE_MELT_MELT_INCLUSIONS_AND_WATER_H

#include "src/scene/geometry/distance_field.h"
#include "src/scene/import/model.h"

/* Melted ice, and its state before melting. */
struct melt_air_and_water_ice {
    const struct object *object; /* melted ice, but with the bounding box from before melting */
    const struct mesh *unmelted; /* objects before melting, but with the ice moved by `rise` */
    float half;                  /* half the ice's initial width, metres */
    float rise;                  /* vertical displacement of the ice, metres */
    float spread;                /* radius of the area that the meltwater covers, metres */
    /* distance fields of the ice after and before melting, zeroed until they are needed */
    struct distance_field depth, depth_before;
};

/* Moves air pockets along with the ice. Shrinks pockets near the melted surface. Collapses pockets
 * that melting has exposed. If out of memory, returns false. */
bool melt_air_and_water_shrink_air(struct model *model, uint32_t object,
                                   struct melt_air_and_water_ice *ice);

/* Spreads the parts of a water object that are below the ice. Returns false when out of memory. */
bool melt_air_and_water_spread_components(struct model *model, uint32_t object,
                                          const struct melt_air_and_water_ice *ice);

/* Spreads water layers (MATERIAL_IS_WATER_LAYER) on the surroundings below the ice. Layers sink
 * where the ground falls, and stay level where the ground rises through them. Textures stay in
 * place. If out of memory, returns false. */
bool melt_air_and_water_spread_layers(struct model *model,
                                      const struct melt_air_and_water_ice *ice);

void melt_air_and_water_finish(struct melt_air_and_water_ice *ice);

/* Returns the depth below a distance field's surface, metres; 0 outside. */
float melt_air_and_water_depth(const struct distance_field *field, vec3s point);

#endif
