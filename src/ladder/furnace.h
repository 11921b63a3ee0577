/*
 * furnace.h: the white furnace test, which checks energy conservation: in an environment of
 * radiance 1, an object that neither absorbs nor emits light must have radiance 1 everywhere.
 *
 * The weights of reflection and refraction must add up to 1. Any deviation is energy that a
 * refraction model or the reference loses or creates.
 */
#ifndef FIRN_LADDER_FURNACE_H
#define FIRN_LADDER_FURNACE_H

#include <stdio.h>
#include "src/ladder/model_comparison.h"

/* Largest deviation from 1 at which a pixel passes. */
extern const double furnace_tolerance;

/* Statistics of R, G and B over the object's pixels. */
struct furnace_row {
    const char *name;
    double least, mean, greatest;
    double remaining; /* maximum throughput of terminated rays of the reference */
    uint64_t off;     /* pixels in which radiance and remaining throughput do not add up to 1 */
};

struct furnace {
    struct furnace_row rows[LADDER_MODEL_COUNT + 1]; /* the reference first */
    uint32_t row_count;
    uint64_t pixel_count;
};

/* Measures a comparison that was rendered in a white environment. Names are borrowed. */
struct furnace furnace_measure(const struct ladder *ladder);

/* Returns true if every pixel passes. */
bool furnace_holds(const struct furnace *furnace);

void furnace_print(const struct furnace *furnace, FILE *out);

#endif
