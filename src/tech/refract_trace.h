/* refract_trace.h: refraction through the triangles of the whole scene. */
#ifndef TECH_REFRACT_TRACE_H
#define TECH_REFRACT_TRACE_H
#include "src/tech/technique.h"
#include "src/tech/trace_settings.h"

/* Number of straight parts of the refracted path inside objects. */
extern const struct rg_image trace_media;

/* Number of the last object of the refracted path. */
extern const struct rg_image trace_last;

extern const struct technique refract_trace;

#endif
