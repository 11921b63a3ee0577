/* over.h: what lies over the picture of the ice. */
#ifndef TECH_OVER_H
#define TECH_OVER_H

#include "src/settings/settings.h"

struct technique;

/* Returns CONSTANT_OVER: bits of the layers that are drawn beside a rung (NULL: one that meets no
 * tree). */
uint32_t over_layers(const struct settings *settings, const struct technique *rung);

#endif
