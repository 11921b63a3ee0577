/* refract_per_vertex.h: refraction at the front face, at its vertices. */
#ifndef TECH_REFRACT_PER_VERTEX_H
#define TECH_REFRACT_PER_VERTEX_H
#include "src/tech/technique.h"

extern const struct technique refract_per_vertex[];

#endif
