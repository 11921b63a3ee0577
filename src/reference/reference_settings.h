/* reference_settings.h: what --set reference.* changes. In every build. */
#ifndef FIRN_REFERENCE_SETTINGS_H
#define FIRN_REFERENCE_SETTINGS_H

#include "src/settings/settings.h"

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

extern const struct setting_group reference_settings;

#endif
