/*
 * vertex_weld.h: welds vertices that share a position but differ in other attributes. Model files
 * split vertices at hard edges and texture seams, which hides that triangles are adjacent.
 * Positions must be exactly equal, because a tolerance could join surfaces that merely touch.
 */
#ifndef FIRN_SCENE_GEOMETRY_VERTEX_WELD_H
#define FIRN_SCENE_GEOMETRY_VERTEX_WELD_H

#include "src/scene/geometry/mesh.h"

#define VERTEX_WELD_NONE UINT32_MAX

struct vertex_weld {
    uint32_t *points;  /* index of each vertex's welded point, or VERTEX_WELD_NONE; owned */
    uint32_t count;    /* number of welded points */
    uint32_t *corners; /* index of each triangle corner's welded point; owned */
    uint32_t corner_count;
};

/* Welds the vertices of mesh->indices[first] to mesh->indices[first + count - 1]. Returns false
 * when out of memory; *vertex_weld is then zeroed. */
bool vertex_weld_init(struct vertex_weld *vertex_weld, const struct mesh *mesh, uint32_t first,
                      uint32_t count);
void vertex_weld_finish(struct vertex_weld *vertex_weld); /* {0} is fine */

#endif
