/* refract_trace.h: GPU ray tracer for nested dielectrics, a refraction model. */
#ifndef FIRN_TECH_TRACE_REFRACT_TRACE_H
#define FIRN_TECH_TRACE_REFRACT_TRACE_H
#include "src/tech/technique.h"
#include "src/tech/trace/trace_settings.h"

extern const struct technique refract_trace;

#endif
