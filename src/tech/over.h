/*
 * over.h: what lies in and on the ice, over the rung's picture, where the rung drew it: air,
 * bubbles, cracks and highlights, in one pass.
 */
#ifndef TECH_OVER_H
#define TECH_OVER_H
#include "shaders/over.h"
#include "src/tech/technique.h"

/* The technique for some of them (OVER_HAS_AIR ...), which come before it. NULL: for none. */
const struct technique *over_find(uint32_t layers);

#endif
