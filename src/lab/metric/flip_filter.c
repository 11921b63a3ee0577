/* flip_filter.c: separable contrast sensitivity and feature filters of FLIP. */
#include "src/lab/metric/flip_filter.h"
#include <assert.h>
#include <math.h>
#include <string.h>

/* Number of texels per inner loop. It is constant, so that compilers can vectorise the loop. */
enum {
    LANES = 16
};

static const double pi = 3.14159265358979323846;

/* Coefficients of the contrast sensitivity functions, table 1 of the FLIP paper. */
static const struct {
    uint32_t count;
    double a[2], b[2];
} gaussians[FLIP_CHANNEL_COUNT] = {
    [FLIP_ACHROMATIC] = { 1, { 1.0 }, { 0.0047 } },
    [FLIP_RED_GREEN] = { 1, { 1.0 }, { 0.0053 } },
    [FLIP_BLUE_YELLOW] = { 2, { 34.1, 13.5 }, { 0.04, 0.025 } },
};

/* Sets normalised Gaussian weights, proportional to exp(-x^2 / (2 * deviation^2)) for x in texels.
 * Returns the sum of the weights before normalisation. */
static double make_gaussian(struct flip_kernel *kernel, uint32_t radius, double deviation)
{
    double values[2 * FLIP_RADIUS_MAX + 1], sum = 0.0;
    assert(radius <= FLIP_RADIUS_MAX);
    kernel->radius = radius;
    for (uint32_t i = 0; i <= 2 * radius; i++) {
        const double x = ((double)i - radius) / deviation;
        values[i] = exp(-0.5 * x * x);
        sum += values[i];
    }
    for (uint32_t i = 0; i <= 2 * radius; i++)
        kernel->weights[i] = (float)(values[i] / sum);
    return sum;
}

void flip_sensitivity_init(struct flip_sensitivity *s, enum flip_channel channel, double ppd)
{
    const double b_max = 0.04; /* maximum b of table 1 */
    const uint32_t radius = (uint32_t)ceil(3.0 * sqrt(b_max / 2.0) / pi * ppd);
    double fractions[2] = { 0.0 };
    s->count = gaussians[channel].count;
    for (uint32_t i = 0; i < s->count; i++) {
        const double a = gaussians[channel].a[i], b = gaussians[channel].b[i];
        const double sum = make_gaussian(&s->kernels[i], radius, sqrt(b / 2.0) / pi * ppd);
        fractions[i] = a * sqrt(pi / b) * sum * sum;
    }
    for (uint32_t i = 0; i < s->count; i++)
        s->fractions[i] = (float)(fractions[i] / (fractions[0] + fractions[1]));
}

/* Normalises positive weights to a sum of 1 and negative weights to a sum of -1. */
static void normalise_signed(struct flip_kernel *kernel, const double *values)
{
    double above = 0.0, below = 0.0;
    for (uint32_t i = 0; i <= 2 * kernel->radius; i++) {
        above += fmax(values[i], 0.0);
        below += fmax(-values[i], 0.0);
    }
    for (uint32_t i = 0; i <= 2 * kernel->radius; i++)
        kernel->weights[i] = (float)(values[i] / (values[i] > 0.0 ? above : below));
}

void flip_features_init(struct flip_features *features, double ppd)
{
    /* The peaks of an edge filter are 0.082 degrees apart. */
    const double deviation = 0.5 * 0.082 * ppd;
    const uint32_t radius = (uint32_t)ceil(3.0 * deviation);
    double first[2 * FLIP_RADIUS_MAX + 1], second[2 * FLIP_RADIUS_MAX + 1];
    make_gaussian(&features->smooth, radius, deviation);
    for (uint32_t i = 0; i <= 2 * radius; i++) {
        const double x = ((double)i - radius) / deviation, g = exp(-0.5 * x * x);
        first[i] = -x * g;
        second[i] = (x * x - 1.0) * g;
    }
    features->edge.radius = features->point.radius = radius;
    normalise_signed(&features->edge, first);
    normalise_signed(&features->point, second);
}

size_t flip_stride(uint32_t width)
{
    return ((size_t)width + LANES - 1) / LANES * LANES;
}

size_t flip_line_size(uint32_t width)
{
    return flip_stride(width) + 2 * (size_t)FLIP_RADIUS_MAX;
}

/* Copies a row to `line` and extends it on both sides by clamping to the edge. */
static void make_line(float *line, const float *row, uint32_t width, uint32_t radius)
{
    for (uint32_t i = 0; i < radius; i++) {
        line[i] = row[0];
        line[radius + width + i] = row[width - 1];
    }
    memcpy(line + radius, row, width * sizeof(*line));
}

static void filter_rows(const struct flip_filter *filter)
{
    const struct flip_kernel *kernel = filter->across;
    const struct flip_plane *in = filter->in;
    for (uint32_t y = 0; y < in->height; y++) {
        float *out = filter->scratch->texels + y * in->stride;
        make_line(filter->line, in->texels + y * in->stride, in->width, kernel->radius);
        for (size_t x = 0; x < in->stride; x += LANES) {
            float sums[LANES] = { 0 };
            for (uint32_t i = 0; i <= 2 * kernel->radius; i++) {
                for (size_t lane = 0; lane < LANES; lane++)
                    sums[lane] += kernel->weights[i] * filter->line[x + i + lane];
            }
            memcpy(out + x, sums, sizeof(sums));
        }
    }
}

/* Lists the rows within `radius` of row y, clamped to the plane. */
static void find_rows(const struct flip_plane *plane, uint32_t y, uint32_t radius,
                      const float *rows[static 2 * FLIP_RADIUS_MAX + 1])
{
    for (uint32_t i = 0; i <= 2 * radius; i++) {
        uint32_t row = y + i > radius ? y + i - radius : 0;
        if (row >= plane->height)
            row = plane->height - 1;
        rows[i] = plane->texels + row * plane->stride;
    }
}

static void filter_columns(const struct flip_filter *filter)
{
    const struct flip_kernel *kernel = filter->down;
    const struct flip_plane *in = filter->scratch;
    const float *rows[2 * FLIP_RADIUS_MAX + 1];
    for (uint32_t y = 0; y < in->height; y++) {
        float *out = filter->out->texels + y * in->stride;
        find_rows(in, y, kernel->radius, rows);
        for (size_t x = 0; x < in->stride; x += LANES) {
            float sums[LANES] = { 0 };
            for (uint32_t i = 0; i <= 2 * kernel->radius; i++) {
                for (size_t lane = 0; lane < LANES; lane++)
                    sums[lane] += kernel->weights[i] * rows[i][x + lane];
            }
            for (size_t lane = 0; lane < LANES; lane++)
                out[x + lane] = filter->scale * sums[lane] + (filter->add ? out[x + lane] : 0.0f);
        }
    }
}

void flip_filter(const struct flip_filter *filter)
{
    filter_rows(filter);
    filter_columns(filter);
}
