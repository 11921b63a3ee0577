/* refract_paper.h: settings of the refraction model of Seipel and Nivfors 2006. */
#ifndef TECH_REFRACT_PAPER_H
#define TECH_REFRACT_PAPER_H
#include "src/tech/technique.h"

extern const struct setting_group refract_paper_settings;

#endif
