/* reference_sums.c: the sums over a pixel's samples. */
#include "src/reference/reference_sums.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The first sums of a pixel. */
enum {
    BRIGHTNESS,
    SQUARE,
    REMAINING, /* red, green, blue */
};

void reference_sums_init(struct reference_sums *sums, uint32_t width, uint32_t height)
{
    const uint32_t remaining = (uint32_t)reference_layers_find("remaining.R");
    *sums = (struct reference_sums){ .width = width, .height = height };
    reference_sums_want(sums, REFERENCE_SUM_BRIGHTNESS);
    reference_sums_want(sums, REFERENCE_SUM_SQUARE);
    for (uint32_t c = 0; c < 3; c++)
        reference_sums_want(sums, remaining + c);
}

void reference_sums_finish(struct reference_sums *sums)
{
    free(sums->sums);
    *sums = (struct reference_sums){ 0 };
}

uint32_t reference_sums_want(struct reference_sums *sums, uint32_t value)
{
    uint32_t i = 0;
    while (i < sums->count && sums->values[i] != value)
        i++;
    if (i == sums->count)
        sums->values[sums->count++] = value;
    return i;
}

bool reference_sums_keep(struct reference_sums *sums)
{
    sums->sums = calloc((size_t)sums->width * sums->height, sums->count * sizeof(double));
    return sums->sums != NULL;
}

void reference_sums_add(const struct reference_sums *sums, double *pixel,
                        const struct reference_seen *seen)
{
    float values[REFERENCE_SEEN_COUNT];
    double brightness = 0.0;
    memcpy(values, seen, sizeof(values));
    for (int c = 0; c < 3; c++)
        brightness += fmin(fmax((double)seen->color.raw[c], 0.0), 1.0) / 3.0;
    pixel[BRIGHTNESS] += brightness;
    pixel[SQUARE] += brightness * brightness;
    for (uint32_t i = REMAINING; i < sums->count; i++)
        pixel[i] += (double)values[sums->values[i]];
}

double reference_sums_error(const double *pixel, uint32_t samples)
{
    const double n = (double)samples;
    if (samples < 2)
        return REFERENCE_ERROR_UNKNOWN;
    const double spread = pixel[SQUARE] - pixel[BRIGHTNESS] * pixel[BRIGHTNESS] / n;
    return sqrt(fmax(spread, 0.0) / (n - 1.0) / n);
}

double reference_sums_remaining(const double *pixel, uint32_t samples)
{
    double most = 0.0;
    for (int c = 0; c < 3; c++)
        most = fmax(most, pixel[REMAINING + c] / (double)samples);
    return most;
}
