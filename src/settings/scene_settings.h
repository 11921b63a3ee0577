/* scene_settings.h: scene settings: sky, lights, lens, motion, environment, surroundings. */
#ifndef FIRN_SETTINGS_SCENE_SETTINGS_H
#define FIRN_SETTINGS_SCENE_SETTINGS_H

#include "src/settings/setting.h"

struct object_params {
    uint32_t triangles; /* of built-in objects; 0 for default */
};

struct ice_params {
    float melt; /* volume fraction melted at time 0 */
};

struct landscape_params {
    uint32_t triangles; /* 0 for the default */
    uint32_t flat;      /* 1 for a level floor */
};

struct sky_params {
    float strength;      /* factor on the procedural sky's radiance */
    float sun_azimuth;   /* degrees; +Z is 0 */
    float sun_elevation; /* degrees above the horizon */
    float sun_strength;  /* factor on the sun's light */
};

enum env_sun {
    ENV_SUN_FILE,   /* sun stored in the panorama's file */
    ENV_SUN_CUSTOM, /* sun_azimuth and sun_elevation below */
    ENV_SUN_NONE,
};

/* Environment panorama: its sun, rendered as a separate directional light, and its blur. */
struct env_params {
    uint32_t sun;        /* enum env_sun */
    float sun_strength;  /* factor on the sun's light */
    float sun_azimuth;   /* for ENV_SUN_CUSTOM, degrees; +Z is 0 */
    float sun_elevation; /* ENV_SUN_CUSTOM: degrees above the horizon */
    float blur;          /* of the panorama as background, degrees; 0 for none */
};

struct texture_params {
    uint32_t anisotropy; /* maximum texture anisotropy; 1 is off */
};

/* Scene animation: a frame's time is `time` plus frame number / `fps`. */
struct motion_params {
    float time;     /* seconds */
    float fps;      /* frames per second */
    float ice;      /* rotation about +Y, degrees per second */
    float lights;   /* lights' orbit, degrees per second */
    float objects;  /* objects' orbit, degrees per second */
    float melt;     /* melting speed, half widths per second */
    uint32_t count; /* objects that orbit the ice */
};

struct light_params {
    uint32_t count;  /* lights around the object */
    float strength;  /* factor on highlights */
    float azimuth;   /* first light, degrees; 0 on +Z */
    float elevation; /* degrees above the horizon */
    float distance;  /* in bounding-sphere radii of the object */
};

/* Environment cube map. Its contents persist from frame to frame. */
struct env_cube_params {
    uint32_t dynamic; /* redraw when the scene changes */
    uint32_t always;  /* redraw in every frame */
    uint32_t size;    /* face size, texels; 0 for frame_face_size() */
};

/* Thin lens of the camera, for depth of field. */
struct lens_params {
    float f_stop; /* f-number; 0 for a pinhole */
    float focus;  /* metres; 0 for the objects' centre */
};

enum ground_light {
    GROUND_UNOCCLUDED, /* unoccluded */
    GROUND_TRACED,     /* ray-traced */
};

enum ground_shading {
    GROUND_VERTICES,
    GROUND_PIXELS,
};

/* Lighting of the surroundings. */
struct ground_params {
    uint32_t light;   /* enum ground_light */
    uint32_t shading; /* enum ground_shading: per vertex or pixel */
    uint32_t denoise; /* denoise, 0 or 1 */
};

/* Extra render targets for inclusions in the ice, composited over the final image. */
struct inclusion_target_params {
    float scale; /* resolution relative to the view */
};

extern const struct setting_group object_settings, ice_settings, landscape_settings, sky_settings,
    env_settings, texture_settings, motion_settings, light_settings, env_cube_settings,
    ground_settings, lens_settings, inclusions_settings;

/* Values of tonemap.resolve. */
enum tonemap_resolve {
    TONEMAP_RESOLVE_WEIGHTED, /* bright samples have smaller weights */
    TONEMAP_RESOLVE_LINEAR,   /* mean of linear radiance, as in EXR files */
    TONEMAP_RESOLVE_FILTERED, /* weighted, and filtered over neighbouring pixels */
};

#endif
