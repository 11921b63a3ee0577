/* refract_reference.h: the traced rung, and what --set reference.* changes. In every build. */
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
    float cutoff;     /* light of less weight is followed no further */
    uint32_t bounces; /* nor after so many surfaces; at most REFERENCE_BOUNCES_MAX */
    uint32_t normals; /* enum reference_normals, of the object */
};

extern const struct technique refract_reference;
extern const struct setting_group reference_settings;

#endif
