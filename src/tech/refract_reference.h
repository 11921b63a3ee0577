/* refract_reference.h: the traced rung and its settings, also in builds without Embree. */
#ifndef TECH_REFRACT_REFERENCE_H
#define TECH_REFRACT_REFERENCE_H
#include "src/tech/technique.h"

enum reference_normals {
    REFERENCE_NORMALS_INTERPOLATED, /* of the vertices, as rasterised */
    REFERENCE_NORMALS_FLAT,         /* of the triangles */
};

enum {
    REFERENCE_BOUNCES_MAX = 256
};

struct reference_params {
    float cutoff;      /* rays of less weight are terminated */
    uint32_t bounces;  /* surfaces after which rays are terminated; at most REFERENCE_BOUNCES_MAX */
    uint32_t roulette; /* switch: what would be terminated goes on by chance */
    uint32_t photons;  /* of the sun, where ice_caustics.light asks for its light; 0: none */
    uint32_t normals;  /* of the object: enum reference_normals */
};

extern const struct technique refract_reference;
extern const struct setting_group reference_settings;

#endif
