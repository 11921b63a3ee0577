/* resolve.h: brings a picture made of many samples back to the device, to be tonemapped. */
#ifndef TECH_RESOLVE_H
#define TECH_RESOLVE_H
#include "src/tech/technique.h"

/* Half RGBA, rows tight, as background_color; written by the renderer. */
extern const struct rg_buffer resolve_samples;
extern const struct technique resolve;

#endif
