/*
 * depth_field.h: interior distance field: depth of points below the surface of a closed mesh.
 *
 * Depths at texel centres are exact: the distance to the nearest triangle, or 0 outside.
 */
#ifndef FIRN_SCENE_DEPTH_FIELD_H
#define FIRN_SCENE_DEPTH_FIELD_H

#include "src/scene/mesh.h"

struct depth_field {
    struct box box; /* extent of the texels, in the mesh's space */
    float most;     /* maximum depth, in the mesh's units; 0 if nothing is inside */
    float *texels;  /* depths in units of `most`, CLOUD_SIZE per axis, x fastest; owned */
};

/* Computes the field; {0} for an empty mesh. Returns false when out of memory; *field is then {0}.
 */
bool depth_field_init(struct depth_field *field, const struct mesh *mesh);
void depth_field_finish(struct depth_field *field); /* {0} is fine */

/* Returns the trilinearly interpolated depth at a point, 0 to 1, in units of `most`. */
float depth_field_at(const struct depth_field *field, vec3s point);

#endif
