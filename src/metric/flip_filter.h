/*
 * flip_filter.h: the filters of FLIP, each a sum of products of two lines of weights.
 *
 * The paper of flip_color.h, sections 4.1.1 (contrast sensitivity) and 4.2.1 (features). Its
 * filters are square and sums of Gaussians or of their derivatives, so that lines and columns
 * can be filtered one after another. Beyond the border lies the nearest texel.
 */
#ifndef FIRN_METRIC_FLIP_FILTER_H
#define FIRN_METRIC_FLIP_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FLIP_RADIUS_MAX = 64,
    FLIP_PPD_MAX = 400, /* pixels per degree that fit in it; the least is 1 */
};

/* Weights of the texels from -radius to +radius. */
struct flip_kernel {
    uint32_t radius;
    float weights[2 * FLIP_RADIUS_MAX + 1];
};

enum flip_channel {
    FLIP_ACHROMATIC,  /* Y */
    FLIP_RED_GREEN,   /* Cx */
    FLIP_BLUE_YELLOW, /* Cz */
    FLIP_CHANNEL_COUNT,
};

/* Contrast sensitivity of a channel: a sum of one or two Gaussians, whose shares add up to 1. */
struct flip_sensitivity {
    uint32_t count;
    float shares[2];
    struct flip_kernel kernels[2];
};

/* ppd: pixels per degree, 1 to FLIP_PPD_MAX. */
void flip_sensitivity_init(struct flip_sensitivity *s, enum flip_channel channel, double ppd);

/*
 * What detects edges and points: across it `edge` or `point`, along it `smooth`. Positive weights
 * add up to 1, negative ones to -1.
 */
struct flip_features {
    struct flip_kernel smooth, edge, point;
};

void flip_features_init(struct flip_features *features, double ppd);

/* Rows of `stride` texels, of which `width` count. */
struct flip_plane {
    uint32_t width, height; /* texels */
    size_t stride;
    float *texels;
};

/* Texels from row to row for a width, and how many a line for flip_filter() has. */
size_t flip_stride(uint32_t width);
size_t flip_line_size(uint32_t width);

/* Planes of one size, and what they are filtered with; `out` may be `in`. */
struct flip_filter {
    const struct flip_plane *in;
    const struct flip_kernel *across, *down; /* along a row; along a column */
    struct flip_plane *scratch, *out;
    float *line; /* flip_line_size() floats */
    float share; /* the result is multiplied by it */
    bool add;    /* to what `out` has */
};

void flip_filter(const struct flip_filter *filter);

#endif
