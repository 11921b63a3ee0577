/* globals.h: the uniform buffer of a frame, which every pass may read; written once a frame. */
#ifndef SHADERS_GLOBALS_H
#define SHADERS_GLOBALS_H
#include "abi.h"
#include "cloud.h"
#include "surface.h"

#define GLOBALS_BINDING     0 /* in every row that uses the buffer */
#define GLOBALS_SKY         0 /* CONSTANT_BACKGROUND: the procedural sky */
#define GLOBALS_COLOR       1 /* one colour everywhere */
#define GLOBALS_ENVIRONMENT 2 /* the equirectangular picture */

#define GLOBALS_LIGHT_COUNT 4

struct globals {
    mat4s clip_from_world;             /* of the view */
    mat4s fitted_clip_from_world;      /* of the view, depth 0 .. 1 across the object's sphere */
    mat4s world_from_object;           /* rotates the object about its centre */
    mat4s world_from_movers;           /* rotates the objects that move around it */
    vec4s lights[GLOBALS_LIGHT_COUNT]; /* world position, metres; w: strength of its highlight */
    vec3s eye;                         /* of the view, world, metres */
    float eta;                         /* refractive index outside / inside, for green */
    vec3s forward;                     /* of the view, unit */
    vec3s background_color;            /* linear radiance */
    float sky_strength;                /* factor on the procedural sky and its light */
    vec3s sun_dir;                     /* unit, towards the sun */
    float sun_strength;      /* perpendicular irradiance of the sun, in units of the sky's */
    vec3s sun_light;         /* radiance of a matt white surface that faces the sun, by it alone */
    float sun_spread;        /* width of the distribution that reflects the sun (lit.h), at least */
    float sun_radius;        /* of the disc that is added to a panorama, radians; 0: none is */
    vec3s center;            /* of the object's bounding sphere, world, metres */
    float radius;            /* of the object's bounding sphere, metres */
    vec2s fitted;            /* near and far plane of fitted_clip_from_world, metres */
    float time;              /* seconds */
    float bump_strength;     /* factor on the slopes of the ice's bump map */
    float bump_scale;        /* tiles of the bump map per metre, or per unit of uv */
    vec3s etas;              /* refractive index outside / inside, for red, green, blue */
    float outside_in_air;    /* refractive index around the objects / that of air */
    vec3s absorb;            /* absorption coefficients of the object, 1 / metre */
    float refract_crossfade; /* share of refraction with REFRACT_FRESNEL_CROSSFADE */
    ABI_STRUCT(surface_params) surface;
    ABI_STRUCT(cloud_place) cloud; /* of the object; extinction 0: none */
    float cloud_cosine;            /* mean, of the angle by which clouds turn light */
    uint32_t cloud_steps;          /* of a part of a way, of rungs that follow no triangles */
    vec2s wide_share;              /* of the picture in ice_normal's wide maps */
    vec3s cube_center;             /* from which the environment cube was drawn, world, metres */
    vec3s local_min, local_max;    /* of the box around the object, world, metres */
    float sample_share;            /* of the samples of a pixel: even in 0 to 1, 0.5 first */
    float lod_bias; /* of textures; below 0 in interleaved tiles, which have every nth pixel */
};

#endif
