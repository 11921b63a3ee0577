/* refract_trace.h: GPU ray tracer for nested dielectrics, a refraction model. */
#ifndef FIRN_TECH_TRACE_REFRACT_TRACE_H
#define FIRN_TECH_TRACE_REFRACT_TRACE_H
#include "src/tech/technique.h"
#include "src/tech/trace/trace_settings.h"

/* Number of segments of the refracted path inside objects, per pixel. */
extern const struct rg_image trace_media;

/* Number of the object that the refracted path hits last, per pixel. */
extern const struct rg_image trace_last_object;

extern const struct technique refract_trace;

#endif
