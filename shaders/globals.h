/* globals.h: uniform buffer of a frame that every pass may read; written once per frame. */
#ifndef SHADERS_GLOBALS_H
#define SHADERS_GLOBALS_H
#include "abi.h"
#include "inclusions/medium.h"
#include "lighting/highlight.h"

#define GLOBALS_BINDING     0 /* binding in every pass that uses the buffer */
#define GLOBALS_SKY         0 /* values of CONSTANT_BACKGROUND: procedural sky */
#define GLOBALS_COLOR       1 /* one colour everywhere */
#define GLOBALS_ENVIRONMENT 2 /* the equirectangular environment map */

#define GLOBALS_LIGHT_COUNT 4

struct globals {
    mat4s clip_from_world;             /* of the camera */
    mat4s fitted_clip_from_world;      /* depth 0 to 1 spans the object's bounding sphere */
    mat4s world_from_object;           /* rotation of the object about its centre */
    mat4s world_from_movers;           /* rotation of surroundings that orbit the object */
    vec4s lights[GLOBALS_LIGHT_COUNT]; /* world position, metres; w: strength of the highlight */
    vec3s eye;                         /* camera position, world, metres */
    float eta;              /* refractive index of the outside over that of the object, for green */
    vec3s forward;          /* camera direction, unit */
    vec3s background_color; /* linear radiance */
    float sky_strength;     /* factor on the procedural sky's radiance */
    vec3s sun_dir;          /* unit vector towards the sun */
    float sun_strength;     /* perpendicular irradiance of the sun, relative to the sky's */
    vec3s sun_light;     /* radiance of a white diffuse surface that faces the sun, without sky */
    float sun_spread;    /* minimum width of the sun's specular lobe (brdf.h) */
    float sun_radius;    /* of a sun disc added to the environment map, radians; 0 if none */
    vec3s center;        /* of the object's bounding sphere, world, metres */
    float radius;        /* of the object's bounding sphere, metres */
    vec2s fitted;        /* near and far plane of fitted_clip_from_world, metres */
    float time;          /* animation time, seconds */
    float bump_strength; /* factor on the slopes of the ice's bump map */
    float bump_scale;    /* tiles of the bump map per metre, or per unit of uv */
    vec3s etas; /* refractive index of the outside over that of the object, for red, green, blue */
    float outside_in_air;    /* refractive index of the outside relative to air */
    vec3s absorb;            /* absorption coefficients of the object, 1 / metre */
    float refract_crossfade; /* transmitted fraction with REFRACT_FRESNEL_CROSSFADE */
    ABI_STRUCT(highlight_params) highlight;
    ABI_STRUCT(medium_field) cloud; /* medium in the object; extinction 0 if it is clear */
    float medium_g;                 /* Henyey-Greenstein g of scattering media */
    uint32_t medium_steps; /* ray marching steps per path segment, in raster refraction models */
    vec2s wide_scale;      /* size of the image relative to ice_normal's wide maps */
    vec3s cube_center;     /* capture point of the environment cube, world, metres */
    vec3s local_min, local_max; /* box of projected environment lookups, world, metres */
    float sample_random;        /* sample's stratified number in 0 to 1, starting with 0.5 */
    float lod_bias;             /* mip level bias; below 0 in tiles of interleaved rendering */
};

#endif
