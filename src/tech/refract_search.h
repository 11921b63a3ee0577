/* refract_search.h: two-sided refraction at an exit that is searched. */
#ifndef TECH_REFRACT_SEARCH_H
#define TECH_REFRACT_SEARCH_H
#include "src/tech/technique.h"

extern const struct technique refract_search[], refract_search_bumped[];
extern const struct setting_group refract_search_settings;

#endif
