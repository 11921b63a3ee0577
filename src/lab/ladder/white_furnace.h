/*
 * white_furnace.h: the white furnace test, which checks energy conservation. If the environment has
 * radiance 1, an object that neither absorbs nor emits light has radiance 1 everywhere. Deviations
 * show that a refraction model or the reference loses or creates energy.
 */
#ifndef FIRN_LAB_LADDER_WHITE_FURNACE_H
#define FIRN_LAB_LADDER_WHITE_FURNACE_H

#include <stdio.h>
#include "src/lab/ladder/refraction_model_comparison.h"

/* Maximum deviation from 1 at which a pixel passes. */
extern const double furnace_tolerance;

/* Furnace test statistics over R, G and B of the object's pixels. */
struct furnace_row {
    const char *name;
    double min, mean, max;
    double remaining; /* maximum of the layer `remaining` */
    double error;     /* standard error of `mean` */
    uint64_t off;     /* pixels that fail the test */
    bool passes;
};

struct furnace {
    struct furnace_row rows[LADDER_MODEL_COUNT + 1]; /* the reference first */
    uint32_t row_count;
    uint64_t pixel_count;
};

/* Evaluates the furnace test on a comparison in a white environment. Borrows the model names. */
struct furnace furnace_measure(const struct ladder *ladder);

/* Returns true if the pixels of all models pass: each pixel, or, where the ray tracer chooses paths
 * at random, their mean within three standard errors. */
bool furnace_passes(const struct furnace *furnace);

void furnace_print(const struct furnace *furnace, FILE *out);

#endif
