/* air.h: air enclosed in the ice: textured planes of bubbles, or a scattering medium. */
#ifndef FIRN_TECH_INCLUSIONS_AIR_H
#define FIRN_TECH_INCLUSIONS_AIR_H
#include "shaders/inclusions/medium_density.h"
#include "shaders/output/composite.h"
#include "src/tech/technique.h"

extern const struct rg_image air_cover; /* combined opacity of all planes */
extern const struct rg_image air_color; /* premultiplied AOV colour; 0 without air */

/* Binding of the environment for composite.vert, which computes the air's in-scattered light. */
#define AIR_USE_ENVIRONMENT \
    FRAME_SAMPLE(frame_environment, COMPOSITE_ENVIRONMENT, .sampler = &frame_environment_sampler, \
                 .stages = VK_SHADER_STAGE_VERTEX_BIT)

/* Imported density fields of the scattering media (shaders/inclusions/medium_density.h). */
extern const struct rg_image air_media;
extern const struct rg_sampler air_media_sampler;
#define AIR_USE_MEDIA FRAME_SAMPLE(air_media, MEDIUM_TEXELS, .sampler = &air_media_sampler)

/* Returns true if the ice encloses air that is rendered as a scattering medium. */
bool air_is_medium(const struct settings *settings);

extern const struct technique air;
extern const struct setting_group air_settings;

enum air_model {
    AIR_PLANES, /* textured planes */
    AIR_MEDIUM, /* scattering medium, densest in the core; for refraction models with media */
    AIR_EVEN,   /* scattering medium of even density */
};

struct air_params {
    uint32_t count, seed;   /* number of planes; their random seed */
    float size;             /* largest bubbles, relative to object diagonal */
    float frequency;        /* largest bubbles along the object diagonal */
    float strength;         /* maximum opacity of a plane's bubbles */
    float haze;             /* maximum opacity of a plane's haze */
    uint32_t model;         /* enum air_model */
    float density;          /* maximum optical depth across the object */
    float scattering_media; /* factor on material.scattering_optical_depth */
    float anisotropy;       /* Henyey-Greenstein g of all scattering media */
    uint32_t steps;         /* ray march steps per segment in raster models; 0 renders clear ice */
};

#endif
