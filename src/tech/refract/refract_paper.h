/* refract_paper.h: settings of the refraction model of Seipel and Nivfors 2006. */
#ifndef FIRN_TECH_REFRACT_REFRACT_PAPER_H
#define FIRN_TECH_REFRACT_REFRACT_PAPER_H
#include "src/tech/technique.h"

extern const struct setting_group refract_paper_settings;

#endif
