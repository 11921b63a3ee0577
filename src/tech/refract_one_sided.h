/* refract_one_sided.h: refraction at the front face alone. */
#ifndef TECH_REFRACT_ONE_SIDED_H
#define TECH_REFRACT_ONE_SIDED_H
#include "src/tech/technique.h"

extern const struct technique refract_one_sided[], refract_one_sided_bumped[];

#endif
