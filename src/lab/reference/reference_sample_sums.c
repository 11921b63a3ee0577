/* reference_sample_sums.c: per-pixel sums over samples, for means and standard errors. */
#include "src/lab/reference/reference_sample_sums.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/render/weighted_mean.h"

/* Indices of the per-pixel sums that are always accumulated. */
enum {
    BRIGHTNESS,
    SQUARE,
    REMAINING, /* red, green, blue */
};

void reference_sums_init(struct reference_sums *sums, uint32_t width, uint32_t height)
{
    const uint32_t remaining = (uint32_t)reference_layers_find("remaining.R");
    *sums = (struct reference_sums){ .width = width, .height = height };
    reference_sums_add_value(sums, REFERENCE_SUM_BRIGHTNESS);
    reference_sums_add_value(sums, REFERENCE_SUM_SQUARE);
    for (uint32_t c = 0; c < 3; c++)
        reference_sums_add_value(sums, remaining + c);
}

void reference_sums_finish(struct reference_sums *sums)
{
    free(sums->sums);
    *sums = (struct reference_sums){ 0 };
}

uint32_t reference_sums_add_value(struct reference_sums *sums, uint32_t value)
{
    uint32_t i = 0;
    while (i < sums->count && sums->values[i] != value)
        i++;
    if (i == sums->count)
        sums->values[sums->count++] = value;
    return i;
}

void reference_sums_add_first(struct reference_sums *sums, uint32_t value, float *texels)
{
    sums->first_values[sums->first_count] = value;
    sums->firsts[sums->first_count++] = texels;
}

bool reference_sums_allocate(struct reference_sums *sums)
{
    sums->sums = calloc((size_t)sums->width * sums->height, sums->count * sizeof(double));
    return sums->sums != NULL;
}

void reference_sums_add(const struct reference_sums *sums, double *pixel,
                        const struct reference_ray_values *seen)
{
    float values[REFERENCE_VALUE_COUNT];
    double brightness = 0.0;
    memcpy(values, seen, sizeof(*seen));
    const float rgba[4] = { seen->color.x, seen->color.y, seen->color.z, seen->alpha };
    const float weight = weighted_mean_weight(rgba, sums->weight_scale);
    for (uint32_t c = 0; c < 3; c++)
        values[REFERENCE_SUM_DISPLAY + c] = weight * rgba[c];
    values[REFERENCE_SUM_WEIGHT] = weight * rgba[3];
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

enum {
    PLANES_PER_SUM = 3, /* image planes per double */
    PLANE_BITS = 21,    /* bits per plane; first: one more */
};

uint32_t reference_sums_plane_count(const struct reference_sums *sums)
{
    return sums->count * PLANES_PER_SUM + sums->first_count;
}

void reference_sums_plane_name(const struct reference_sums *sums, uint32_t plane,
                               char name[static IMAGE_NAME_SIZE])
{
    const uint32_t sum = plane / PLANES_PER_SUM;
    if (sum >= sums->count) {
        const uint32_t value = sums->first_values[plane - sums->count * PLANES_PER_SUM];
        snprintf(name, IMAGE_NAME_SIZE, "%s", reference_layers_plane(value));
        return;
    }
    const uint32_t value = sums->values[sum];
    static const char *const names[] = {
        [REFERENCE_SUM_BRIGHTNESS - REFERENCE_RAY_VALUE_COUNT] = "brightness",
        [REFERENCE_SUM_SQUARE - REFERENCE_RAY_VALUE_COUNT] = "square",
        [REFERENCE_SUM_DISPLAY - REFERENCE_RAY_VALUE_COUNT] = "display.R",
        "display.G",
        "display.B",
        "display.weight",
    };
    const char *of = value < REFERENCE_RAY_VALUE_COUNT ? reference_layers_plane(value)
                                                       : names[value - REFERENCE_RAY_VALUE_COUNT];
    snprintf(name, IMAGE_NAME_SIZE, "%s.sum.%u", of, plane % PLANES_PER_SUM);
}

static unsigned shift_of(uint32_t plane)
{
    return PLANE_BITS * (PLANES_PER_SUM - 1 - plane % PLANES_PER_SUM);
}

void reference_sums_get_row(const struct reference_sums *sums, uint32_t plane, uint32_t y,
                            float *row)
{
    const size_t begin = (size_t)y * sums->width;
    const uint32_t sum = plane / PLANES_PER_SUM;
    if (sum >= sums->count) {
        memcpy(row, &sums->firsts[plane - sums->count * PLANES_PER_SUM][begin],
               sums->width * sizeof(*row));
        return;
    }
    for (size_t x = 0; x < sums->width; x++) {
        uint64_t bits;
        memcpy(&bits, &sums->sums[(begin + x) * sums->count + sum], sizeof(bits));
        const uint64_t shifted = bits >> shift_of(plane);
        row[x] = (float)(plane % PLANES_PER_SUM ? shifted & ((1u << PLANE_BITS) - 1) : shifted);
    }
}

bool reference_sums_set_row(struct reference_sums *sums, uint32_t plane, uint32_t y,
                            const float *row)
{
    const size_t begin = (size_t)y * sums->width;
    const uint32_t sum = plane / PLANES_PER_SUM;
    const float end = (float)(1u << (PLANE_BITS + (plane % PLANES_PER_SUM == 0)));
    if (sum >= sums->count) {
        memcpy(&sums->firsts[plane - sums->count * PLANES_PER_SUM][begin], row,
               sums->width * sizeof(*row));
        return true;
    }
    for (size_t x = 0; x < sums->width; x++) {
        double *at = &sums->sums[(begin + x) * sums->count + sum];
        uint64_t bits;
        if (!(row[x] >= 0.0f && row[x] < end) || row[x] != floorf(row[x]))
            return false;
        memcpy(&bits, at, sizeof(bits));
        bits |= (uint64_t)row[x] << shift_of(plane);
        memcpy(at, &bits, sizeof(bits));
    }
    return true;
}
