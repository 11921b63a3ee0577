/* first_surface.h: layers of the first visible surface, including motion vectors. */
#ifndef FIRN_TECH_OUTPUT_FIRST_SURFACE_H
#define FIRN_TECH_OUTPUT_FIRST_SURFACE_H

#include "shaders/output/first_surface.h"
#include "src/tech/frame_resources.h"

/* Returns the number of rows of FIRST_SURFACE_WIDTH texels for the vertices of a model. */
uint32_t first_surface_rows(const struct model *model);

/* Writes a struct first_surface_previous, the transformations of the previous frame. */
void first_surface_write(void *memory, const struct frame_view *view,
                         const struct globals *globals);

#endif
