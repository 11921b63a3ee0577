/*
 * flip_filter.h: the separable filters of FLIP.
 *
 * The paper of flip_color.h, sections 4.1.1 (contrast sensitivity) and 4.2.1 (features). Its
 * filters are square and sums of Gaussians or of their derivatives, so that lines and columns
 * can be filtered one after another. Texels beyond the border are those of the border.
 */
#ifndef FIRN_METRIC_FLIP_FILTER_H
#define FIRN_METRIC_FLIP_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FLIP_RADIUS_MAX = 64,
    FLIP_PPD_MAX = 400, /* pixels per degree whose filters fit in that radius; the least is 1 */
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

/* Computes the filters of a channel. `ppd` is pixels per degree, 1 to FLIP_PPD_MAX. */
void flip_sensitivity_init(struct flip_sensitivity *s, enum flip_channel channel, double ppd);

/*
 * The detectors of edges and points: `edge` or `point` along one axis, `smooth` along the other
 * one. Positive weights add up to 1, negative ones to -1.
 */
struct flip_features {
    struct flip_kernel smooth, edge, point;
};

void flip_features_init(struct flip_features *features, double ppd);

/* A plane whose rows are `stride` texels apart. */
struct flip_plane {
    uint32_t width, height; /* texels */
    size_t stride;
    float *texels;
};

/* Return the stride for a width, and the number of floats of flip_filter.line. */
size_t flip_stride(uint32_t width);
size_t flip_line_size(uint32_t width);

/* A separable filter and its planes, which have one size; `out` may be `in`. */
struct flip_filter {
    const struct flip_plane *in;
    const struct flip_kernel *across, *down; /* along a row; along a column */
    struct flip_plane *scratch, *out;
    float *line; /* flip_line_size() floats */
    float share; /* the result is multiplied by it */
    bool add;    /* add the result to `out` */
};

void flip_filter(const struct flip_filter *filter);

#endif
