/* refract_paper.h: two-sided refraction by blended normals. */
#ifndef TECH_REFRACT_PAPER_H
#define TECH_REFRACT_PAPER_H
#include "src/tech/technique.h"

extern const struct setting_group refract_paper_settings;

#endif
