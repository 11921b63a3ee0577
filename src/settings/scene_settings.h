/* scene_settings.h: parameters of the scene that belong to no technique. */
#ifndef FIRN_SETTINGS_SCENE_SETTINGS_H
#define FIRN_SETTINGS_SCENE_SETTINGS_H

#include "src/settings/setting.h"

struct object_params {
    uint32_t triangles; /* of a built-in object; 0: its default */
};

struct ice_params {
    float melt; /* share of the volume that is lost at time 0 */
};

struct landscape_params {
    uint32_t triangles; /* 0: its default */
    uint32_t flat;      /* 1: a level floor in its place */
};

struct sky_params {
    float strength;      /* factor on the procedural sky and its light */
    float sun_azimuth;   /* degrees; 0 on +Z, 90 on +X */
    float sun_elevation; /* degrees above the horizon */
    float sun_strength;  /* factor on the sun's light */
};

enum env_sun {
    ENV_SUN_FILE, /* the sun that the panorama's file names */
    ENV_SUN_OWN,  /* that of the settings below */
    ENV_SUN_NONE,
};

/* The sun of a panorama, which is a light of its own. */
struct env_params {
    uint32_t sun;        /* enum env_sun */
    float sun_strength;  /* factor on the file's, or the light of a white one */
    float sun_azimuth;   /* degrees; 0 on +Z, 90 on +X; of ENV_SUN_OWN */
    float sun_elevation; /* degrees above the horizon; of ENV_SUN_OWN */
};

struct texture_params {
    uint32_t anisotropy; /* of what the ice and its surroundings wear, at most; 1: none */
};

/* Where time goes: a frame's time is `time` plus its number over `fps`. */
struct motion_params {
    float time;     /* seconds */
    float fps;      /* frames a second */
    float ice;      /* degrees a second, about +Y through the object's centre */
    float lights;   /* the same, of the lights */
    float objects;  /* the same, of what moves around it */
    float melt;     /* retreat of the faces of ice, halves of its width a second */
    uint32_t count; /* of objects that move around it */
};

struct light_params {
    uint32_t count;  /* of lights around the object */
    float strength;  /* of their highlights */
    float azimuth;   /* of the first, degrees; 0 on +Z, 90 on +X */
    float elevation; /* degrees above the horizon */
    float distance;  /* from the object's centre, in its bounding sphere's radii */
};

/* The environment cube, which lives from frame to frame. */
struct env_cube_params {
    uint32_t dynamic; /* drawn by the frames, else once, at motion.time */
    uint32_t always;  /* in all of them */
    uint32_t faces;   /* at most, in a frame of a window */
    uint32_t size;    /* of a face, texels a side; 0: frame_face_size() */
};

/* The camera's lens. */
struct lens_params {
    float f_stop; /* 0: a pinhole */
    float focus;  /* metres along the camera's axis; 0: at the objects' middle */
};

enum ground_light {
    GROUND_OPEN,   /* as if nothing were in its way */
    GROUND_TRACED, /* by rays */
};

enum ground_shading {
    GROUND_VERTICES,
    GROUND_PIXELS,
};

/* Light on what is around the objects. */
struct ground_params {
    uint32_t light;   /* enum ground_light */
    uint32_t shading; /* enum ground_shading: where light is computed */
    uint32_t smooth;  /* 0 or 1 */
};

/* Of what is drawn before the picture and blended over it. */
struct target_params {
    float scale; /* of the view: the size of images of what is in the ice */
};

extern const struct setting_group object_settings, ice_settings, landscape_settings, sky_settings,
    env_settings, texture_settings, motion_settings, light_settings, env_cube_settings,
    ground_settings, lens_settings, target_settings;

#endif
