/* refract_wyman.h: two-sided refraction at a guessed exit. */
#ifndef TECH_REFRACT_WYMAN_H
#define TECH_REFRACT_WYMAN_H
#include "src/tech/technique.h"

extern const struct technique refract_wyman[], refract_wyman_bumped[];

#endif
