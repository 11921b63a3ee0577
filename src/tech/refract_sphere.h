/* refract_sphere.h: refraction by a sphere that stands in for the object. */
#ifndef TECH_REFRACT_SPHERE_H
#define TECH_REFRACT_SPHERE_H
#include "src/tech/technique.h"

extern const struct technique refract_sphere[], refract_sphere_bumped[];

#endif
