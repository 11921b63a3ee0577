/* globals.h: per-frame uniform buffer that every pass may read. */
#ifndef SHADERS_GLOBALS_H
#define SHADERS_GLOBALS_H
#include "abi.h"
#include "inclusions/medium_density.h"
#include "lighting/highlight.h"

#define GLOBALS_BINDING     0 /* binding in every pass */
#define GLOBALS_SKY         0 /* CONSTANT_BACKGROUND: procedural sky */
#define GLOBALS_COLOR       1 /* one colour everywhere */
#define GLOBALS_ENVIRONMENT 2 /* equirectangular environment map */

#define GLOBALS_BACKDROP_ENVIRONMENT 0 /* CONSTANT_BACKDROP: primary misses return its radiance */
#define GLOBALS_BACKDROP_NONE        1 /* alpha 0 */
#define GLOBALS_BACKDROP_COLOR       2 /* background_color, which lights nothing */

#define GLOBALS_LIGHT_COUNT 4

struct globals {
    mat4s clip_from_world;             /* camera */
    mat4s fitted_clip_from_world;      /* camera, depth fitted to the object */
    mat4s world_from_object;           /* object's rotation about its centre */
    mat4s world_from_movers;           /* rotation of orbiting surroundings */
    vec4s lights[GLOBALS_LIGHT_COUNT]; /* world, metres; w: highlight strength */
    vec3s eye;                         /* camera position, world, metres */
    float eta;                         /* relative index, outside to object, green */
    vec3s forward;                     /* camera direction, unit */
    vec3s background_color;            /* linear radiance */
    float sky_strength;                /* factor on the procedural sky's radiance */
    vec3s sun_dir;                     /* unit vector towards the sun */
    float sun_strength;                /* sun's irradiance relative to the sky's */
    vec3s sun_light;         /* sunlight: radiance of a white diffuse surface that faces the sun */
    float sun_spread;        /* minimum width of the sun's specular lobe (brdf.h) */
    float sun_radius;        /* added sun disc's angular radius, radians */
    vec3s center;            /* bounding sphere's centre, world, metres */
    float radius;            /* radius of the object's bounding sphere, metres */
    vec2s fitted;            /* near and far planes, metres */
    float time;              /* animation time, seconds */
    float bump_strength;     /* factor on the bump map's slopes */
    float bump_scale;        /* repetitions per metre or uv unit */
    vec3s etas;              /* `eta` for red, green, blue */
    float outside_in_air;    /* outside's index relative to air */
    vec3s absorb;            /* object's absorption, 1 / metre */
    float refract_crossfade; /* transmitted fraction with REFRACT_FRESNEL_CROSSFADE */
    ABI_STRUCT(highlight_params) highlight;
    ABI_STRUCT(medium_field) medium; /* object's medium; extinction 0: clear */
    float medium_g;                  /* Henyey-Greenstein g of scattering media */
    uint32_t medium_steps;           /* media: ray marching steps per segment */
    vec2s wide_scale;                /* image size / wide map size */
    vec3s cube_center;               /* environment cube's capture point, world, metres */
    vec3s local_min, local_max;      /* environment lookups' projection box, world, metres */
    float sample_random;             /* stratified random number; first sample: 0.5 */
    float lod_bias;                  /* mip bias; negative for interleaved tiles */
};

#endif
