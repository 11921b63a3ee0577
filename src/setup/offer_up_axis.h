/* offer_up_axis.h: suggests --up z for a model that lies on its side. */
#ifndef FIRN_SETUP_OFFER_UP_AXIS_H
#define FIRN_SETUP_OFFER_UP_AXIS_H

#include "src/scene/geometry/mesh.h"

/* Logs a note that offers --up z for an OBJ, PLY or STL file whose mesh stands on its -Z side. The
 * up axis of these formats is not defined. */
void offer_up_axis(const char *path, const struct mesh *mesh);

#endif
