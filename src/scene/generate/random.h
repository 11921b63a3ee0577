/*
 * random.h: sequences of random numbers, the same on every machine.
 */
#ifndef FIRN_SCENE_GENERATE_RANDOM_H
#define FIRN_SCENE_GENERATE_RANDOM_H

#include <cglm/struct.h>
#include <stdint.h>

/* Where a sequence stands. */
struct random {
    uint32_t key, count;
};

/* Seeds give unrelated sequences, and so do parts of one seed. */
struct random random_begin(uint32_t seed, uint32_t part);

float random_unit(struct random *random); /* in [0, 1) */
vec3s random_box(struct random *random);  /* each in [-1, 1) */

/* Every rotation is as likely as any other; columns are the turned axes. */
mat3s random_rotation(struct random *random);

#endif
