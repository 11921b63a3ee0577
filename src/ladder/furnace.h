/*
 * furnace.h: the white furnace: surrounded by radiance 1, whatever takes no light and adds none
 * shows 1.
 *
 * A surface that mixes what it reflects and what it refracts with weights that add up to 1 gives 1
 * again; what a rung or the reference loses or makes up is what is off.
 */
#ifndef FIRN_LADDER_FURNACE_H
#define FIRN_LADDER_FURNACE_H

#include <stdio.h>
#include "src/ladder/ladder.h"

/* How far from 1 a pixel may be. */
extern const double furnace_tolerance;

/* Of R, G and B of the object's pixels. */
struct furnace_row {
    const char *name;
    double least, mean, greatest;
    double remaining; /* most that the reference has not followed: part of what is missing to 1 */
    uint64_t off;     /* pixels: it and what remains do not add up to 1, within the tolerance */
};

struct furnace {
    struct furnace_row rows[LADDER_RUNG_COUNT + 1]; /* the reference first */
    uint32_t row_count;
    uint64_t pixel_count;
};

/* Of a ladder that was drawn in it. Names are borrowed. */
struct furnace furnace_measure(const struct ladder *ladder);

bool furnace_holds(const struct furnace *furnace);

void furnace_print(const struct furnace *furnace, FILE *out);

#endif
