/* air.h: planes of air bubbles inside the ice. */
#ifndef TECH_AIR_H
#define TECH_AIR_H
#include "shaders/over.h"
#include "src/tech/technique.h"

extern const struct rg_image air_cover; /* opacity of all planes together */
extern const struct rg_image air_color; /* premultiplied colour, for the layer only; 0: no air */

/* The use of the environment by over.vert, which computes the light of the air from it. */
#define AIR_USE_ENVIRONMENT \
    FRAME_SAMPLE(frame_environment, OVER_ENVIRONMENT, .sampler = &frame_environment_sampler, \
                 .stages = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT)

/* Returns whether there is air, and it is a medium. */
bool air_is_medium(const struct settings *settings);

extern const struct technique air;
extern const struct setting_group air_settings;

enum air_model {
    AIR_PLANES, /* textures on planes */
    AIR_MEDIUM, /* a cloud that scatters light: trace and the reference draw it */
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
};

#endif
