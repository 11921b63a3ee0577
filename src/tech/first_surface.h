/* first_surface.h: what the nearest surface is, and where it was in the frame before. */
#ifndef FIRN_TECH_FIRST_SURFACE_H
#define FIRN_TECH_FIRST_SURFACE_H

#include "shaders/first_surface.h"
#include "src/tech/frame.h"

extern const struct rg_image first_surface_object; /* the layer object */

/* Fills a struct first_surface_earlier. */
void first_surface_write(void *memory, const struct frame_view *view,
                         const struct globals *globals);

#endif
