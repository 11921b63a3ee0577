/* model_shells.h: shells (edge-connected components) of the triangles that may bound one medium:
 * welding, orientation, nesting and holes. */
#ifndef FIRN_SCENE_IMPORT_MODEL_SHELLS_H
#define FIRN_SCENE_IMPORT_MODEL_SHELLS_H

#include "src/scene/import/shell_edges.h"

/* Numbers of changed shells and triangles. */
struct shell_counts {
    uint32_t flipped; /* wound inside out, and flipped */
    uint32_t unified; /* wound inconsistently, and made consistent */
    uint32_t shared;  /* collapsed triangles, which two solids of a part shared */
};

/* Finds the shells of parts that have the same medium and node. Parts that are open but close
 * together become one object, and so do a solid and its cavities. Vertices on the edges of holes
 * are welded if their positions are equal within rounding. An outermost shell of negative volume is
 * flipped. A shell of negative volume within a solid is a cavity. With `collapses_shared`,
 * triangles that two solids of a part share get equal corners. Returns false when out of memory. */
bool model_shells_find(struct mesh *mesh, struct shell_part *parts, uint32_t part_count,
                       bool collapses_shared, struct shell_counts *counts);

#endif
