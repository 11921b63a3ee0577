/*
 * furnace.h: the white furnace test: in surroundings of radiance 1, an object that neither absorbs
 * nor emits light must show 1.
 *
 * A surface whose weights of reflection and refraction add up to 1 shows 1; any difference is
 * energy that a rung or the reference loses or adds.
 */
#ifndef FIRN_LADDER_FURNACE_H
#define FIRN_LADDER_FURNACE_H

#include <stdio.h>
#include "src/ladder/ladder.h"

/* Greatest difference from 1 that is accepted in a pixel. */
extern const double furnace_tolerance;

/* Statistics of R, G and B over the object's pixels. */
struct furnace_row {
    const char *name;
    double least, mean, greatest;
    double remaining; /* greatest weight of rays that the reference terminated, missing to 1 */
    uint64_t off;     /* pixels in which value and remaining weight do not add up to 1 */
};

struct furnace {
    struct furnace_row rows[LADDER_RUNG_COUNT + 1]; /* the reference first */
    uint32_t row_count;
    uint64_t pixel_count;
};

/* Measures a ladder that was drawn in white surroundings. Names are borrowed. */
struct furnace furnace_measure(const struct ladder *ladder);

/* Returns whether no row has pixels that are off. */
bool furnace_holds(const struct furnace *furnace);

void furnace_print(const struct furnace *furnace, FILE *out);

#endif
