/* distance_field.h: depth of points inside a closed mesh, on a grid of texels. The depth is the
 * distance to the nearest triangle. It is exact at texel centres, and 0 outside the mesh. */
#ifndef FIRN_SCENE_GEOMETRY_DISTANCE_FIELD_H
#define FIRN_SCENE_GEOMETRY_DISTANCE_FIELD_H

#include "src/scene/geometry/mesh.h"

struct distance_field {
    struct box box;  /* extent of the texels, in the mesh's space */
    float max_depth; /* maximum depth, in the mesh's units; 0 if nothing is inside */
    float *texels;   /* owned depths of MEDIUM_SIZE^3 texels, x fastest, relative to max_depth */
};

/* Computes the field (zeroed if the mesh is empty). Returns false when out of memory. */
bool distance_field_init(struct distance_field *field, const struct mesh *mesh);
void distance_field_finish(struct distance_field *field); /* {0} is fine */

/* Returns the trilinearly interpolated depth at a point, relative to the maximum depth. */
float distance_field_at(const struct distance_field *field, vec3s point);

#endif
