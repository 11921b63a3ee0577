/* random.h: random number sequences, bit-identical on every machine. */
#ifndef FIRN_SCENE_GENERATE_RANDOM_H
#define FIRN_SCENE_GENERATE_RANDOM_H

#include <cglm/types-struct.h>
#include <stdint.h>

/* State of a random number sequence. */
struct random {
    uint32_t key, count;
};

/* Starts sequence number `part` of a seed. Sequences of other seeds or parts are uncorrelated. */
struct random random_begin(uint32_t seed, uint32_t part);

float random_unit(struct random *random); /* in [0, 1) */
vec3s random_box(struct random *random);  /* each coordinate in [-1, 1) */

/* Returns a uniformly distributed rotation. */
mat3s random_rotation(struct random *random);

#endif
