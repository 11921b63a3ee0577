/* weld.h: joins the vertices of a mesh that are at one place, and differ in other things. */
#ifndef FIRN_SCENE_WELD_H
#define FIRN_SCENE_WELD_H

#include "src/scene/mesh.h"

#define WELD_NONE UINT32_MAX

struct weld {
    uint32_t *points;  /* of each vertex of the mesh: its point, or WELD_NONE; owned */
    uint32_t count;    /* of points */
    uint32_t *corners; /* points of the triangles' corners; owned */
    uint32_t corner_count;
};

/* Joins the corners of `count` indices from `first` on. Returns false when out of memory; *weld is
 * then {0}. */
bool weld_init(struct weld *weld, const struct mesh *mesh, uint32_t first, uint32_t count);
void weld_finish(struct weld *weld); /* {0} is fine */

#endif
