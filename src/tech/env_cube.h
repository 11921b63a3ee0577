/* env_cube.h: the scene without the ice, seen from its centre in all directions. */
#ifndef TECH_ENV_CUBE_H
#define TECH_ENV_CUBE_H
#include "src/tech/technique.h"

extern const struct rg_image env_cube_color; /* linear radiance; a: 1 / distance, 1 / metre */
extern const struct rg_image env_cube_baked; /* the same, its faces as large as the view */
extern const struct technique env_cube;
extern const struct technique env_cube_bake;  /* env_cube_baked */
extern const struct technique env_cube_shine; /* in the light of ice_caustics.h */
extern const struct setting_group env_cube_settings;

struct env_cube_params {
    uint32_t dynamic; /* drawn by the frames, else once, at motion.time */
    uint32_t always;  /* in all of them */
    uint32_t faces;   /* at most, in a frame of a window */
};

#endif
