/* air.h: planes of air bubbles inside the ice. */
#ifndef TECH_AIR_H
#define TECH_AIR_H
#include "shaders/cloud.h"
#include "shaders/over.h"
#include "src/tech/technique.h"

extern const struct rg_image air_cover; /* opacity of all planes together */
extern const struct rg_image air_color; /* premultiplied colour, for the layer only; 0: no air */

/* The use of the environment by over.vert, which computes the light of the air from it. */
#define AIR_USE_ENVIRONMENT \
    FRAME_SAMPLE(frame_environment, OVER_ENVIRONMENT, .sampler = &frame_environment_sampler, \
                 .stages = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT)

/* The densities of the scene's clouds (shaders/cloud.h), imported; this size is that of the
 * fallback. */
extern const struct rg_image air_clouds;
extern const struct rg_sampler air_cloud_sampler;
#define AIR_USE_CLOUDS FRAME_SAMPLE(air_clouds, CLOUD_TEXELS, .sampler = &air_cloud_sampler)

/* Returns whether there is air, and it is a medium. */
bool air_is_medium(const struct settings *settings);

extern const struct technique air;
extern const struct setting_group air_settings;

enum air_model {
    AIR_PLANES, /* textures on planes */
    AIR_MEDIUM, /* a cloud that scatters light, of rungs that draw clouds */
};

struct air_params {
    uint32_t count, seed; /* number of planes; seed of their poses and textures */
    float size;           /* diameter of the largest bubbles, in diagonals of the object's box */
    float frequency;      /* of the largest bubbles along that diagonal */
    float strength;       /* opacity of a plane's bubbles at most */
    float haze;           /* opacity of a plane's haze at most */
    uint32_t model;       /* enum air_model */
    float density;        /* of a medium: extinction where it is densest, by the object's width */
    float clouds;         /* factor on material.cloud */
    float anisotropy;     /* of all clouds: mean cosine of the angle by which light is turned */
    uint32_t steps;       /* of a part of a way in clouds, but for trace; 0: they are clear */
};

#endif
