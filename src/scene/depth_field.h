/*
 * depth_field.h: how deep points are below the surface of a closed mesh.
 *
 * Depths are exact at the texels' centres: the distance to the nearest triangle, or 0 outside.
 */
#ifndef FIRN_SCENE_DEPTH_FIELD_H
#define FIRN_SCENE_DEPTH_FIELD_H

#include "src/scene/mesh.h"

struct depth_field {
    struct box box; /* that the texels fill, in the mesh's space */
    float most;     /* greatest depth, in the mesh's units; 0: nothing is inside */
    float *texels;  /* CLOUD_SIZE a side, along x first, then y; in units of `most`; owned */
};

/* Returns false when out of memory; *field is then {0}. A mesh without triangles gives {0}. */
bool depth_field_init(struct depth_field *field, const struct mesh *mesh);
void depth_field_finish(struct depth_field *field); /* {0} is fine */

/* Returns the depth at a point in units of `most`, 0 to 1, linear between texels. */
float depth_field_at(const struct depth_field *field, vec3s point);

#endif
