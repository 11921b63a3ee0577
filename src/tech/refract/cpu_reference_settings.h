/* cpu_reference_settings.h: settings of the CPU reference ray tracer, also in builds without
 * Embree. */
#ifndef FIRN_TECH_REFRACT_CPU_REFERENCE_SETTINGS_H
#define FIRN_TECH_REFRACT_CPU_REFERENCE_SETTINGS_H
#include "src/tech/technique.h"

enum reference_normals {
    REFERENCE_NORMALS_INTERPOLATED, /* from the vertices */
    REFERENCE_NORMALS_FLAT,         /* geometric normals of the triangles */
};

enum {
    REFERENCE_BOUNCES_MAX = 256
};

struct reference_params {
    float cutoff;      /* throughput below which paths are terminated */
    uint32_t bounces;  /* maximum surfaces on a path */
    uint32_t roulette; /* 1: Russian roulette instead of termination */
    uint32_t photons;  /* sun photons for caustics; 0: off */
    uint32_t normals;  /* of the object: enum reference_normals */
};

extern const struct technique cpu_reference_settings;
extern const struct setting_group reference_settings;

#endif
