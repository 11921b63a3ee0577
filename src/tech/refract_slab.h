/* refract_slab.h: refraction by a pane that stands in for the object. */
#ifndef TECH_REFRACT_SLAB_H
#define TECH_REFRACT_SLAB_H
#include "src/tech/technique.h"

extern const struct technique refract_slab[], refract_slab_bumped[];

#endif
