/* scene_settings.h: scene settings: sky, lights, lens, motion, environment, surroundings. */
#ifndef FIRN_SETTINGS_SCENE_SETTINGS_H
#define FIRN_SETTINGS_SCENE_SETTINGS_H

#include "src/settings/setting.h"

struct object_params {
    uint32_t triangles; /* triangle count of a built-in object; 0 for its default */
};

struct ice_params {
    float melt; /* fraction of the ice's volume melted at time 0 */
};

struct landscape_params {
    uint32_t triangles; /* 0 for the default */
    uint32_t flat;      /* 1 to use a level floor instead */
};

struct sky_params {
    float strength;      /* factor on the procedural sky's radiance */
    float sun_azimuth;   /* degrees; 0 on +Z, 90 on +X */
    float sun_elevation; /* degrees above the horizon */
    float sun_strength;  /* factor on the sun's light */
};

enum env_sun {
    ENV_SUN_FILE, /* the sun stored in the panorama's file */
    ENV_SUN_OWN,  /* the sun defined by the settings below */
    ENV_SUN_NONE,
};

/* Sun of an environment panorama, a separate directional light. */
struct env_params {
    uint32_t sun;        /* enum env_sun */
    float sun_strength;  /* factor on the file's sun, or light of a white one */
    float sun_azimuth;   /* for ENV_SUN_OWN: degrees; 0 on +Z, 90 on +X */
    float sun_elevation; /* for ENV_SUN_OWN: degrees above the horizon */
};

struct texture_params {
    uint32_t anisotropy; /* maximum anisotropy of material textures; 1 is off */
};

/* Animation of the scene: the time of a frame is `time` plus frame number / `fps`. */
struct motion_params {
    float time;     /* seconds */
    float fps;      /* frames per second */
    float ice;      /* rotation of the ice about +Y, degrees per second */
    float lights;   /* orbit speed of the lights, degrees per second */
    float objects;  /* orbit speed of the objects, degrees per second */
    float melt;     /* retreat speed of the ice's faces, half widths per second */
    uint32_t count; /* number of objects that orbit the ice */
};

struct light_params {
    uint32_t count;  /* number of lights around the object */
    float strength;  /* factor on their highlights */
    float azimuth;   /* azimuth of the first light, degrees; 0 on +Z, 90 on +X */
    float elevation; /* degrees above the horizon */
    float distance;  /* distance in bounding-sphere radii of the object */
};

/* Environment cube map, which is kept from frame to frame. */
struct env_cube_params {
    uint32_t dynamic; /* redraw as the scene changes; else draw once, at motion.time */
    uint32_t always;  /* redraw in every frame */
    uint32_t faces;   /* maximum number of faces redrawn per frame of a window */
    uint32_t size;    /* texels per side of a face; 0 for frame_face_size() */
};

/* Thin lens of the camera, for depth of field. */
struct lens_params {
    float f_stop; /* f-number; 0 for a pinhole */
    float focus;  /* focus distance, metres; 0 for the objects' centre */
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
    uint32_t shading; /* enum ground_shading: shading per vertex or per pixel */
    uint32_t denoise; /* denoise, 0 or 1 */
};

/* Intermediate images that are composited over the final image. */
struct inclusion_target_params {
    float scale; /* resolution of the images of inclusions relative to the view */
};

extern const struct setting_group object_settings, ice_settings, landscape_settings, sky_settings,
    env_settings, texture_settings, motion_settings, light_settings, env_cube_settings,
    ground_settings, lens_settings, inclusion_target_settings;

#endif
