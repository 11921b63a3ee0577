/* scene_settings.h: parameters of the scene that belong to no technique. */
#ifndef FIRN_SCENE_SETTINGS_H
#define FIRN_SCENE_SETTINGS_H

#include "src/settings.h"

struct object_params {
    uint32_t triangles; /* of a built-in object; 0: its default */
};

struct landscape_params {
    uint32_t triangles; /* 0: its default */
};

struct sky_params {
    float strength;      /* factor on the procedural sky and its light */
    float sun_azimuth;   /* degrees; 0 on +Z, 90 on +X */
    float sun_elevation; /* degrees above the horizon */
    float sun_strength;  /* factor on the sun's light */
};

extern const struct setting_group object_settings, landscape_settings, sky_settings;

#endif
