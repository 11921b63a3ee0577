/*
 * flip_filter.h: the filters of FLIP: contrast sensitivity (section 4.1.1) and feature detection
 * (section 4.2.1). flip_color.h cites the paper. Filters clamp to the edge. They filter rows and
 * columns separately, because they are sums of Gaussians or of Gaussian derivatives.
 */
#ifndef FIRN_LAB_METRIC_FLIP_FILTER_H
#define FIRN_LAB_METRIC_FLIP_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FLIP_RADIUS_MAX = 64,
    FLIP_PPD_MAX = 400, /* maximum pixels per degree */
};

/* Weights of a 1D filter, from texel -radius to +radius. */
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

/* Contrast sensitivity filter of a channel: one or two Gaussians whose weights add up to 1. */
struct flip_sensitivity {
    uint32_t count;
    float fractions[2];
    struct flip_kernel kernels[2];
};

/* Computes a channel's filter for `ppd` pixels per degree, 1 to FLIP_PPD_MAX. */
void flip_sensitivity_init(struct flip_sensitivity *s, enum flip_channel channel, double ppd);

/*
 * Filters that detect edges and points. A filter applies `edge` or `point` along one axis and
 * `smooth` along the perpendicular axis. Positive weights add up to 1 and negative weights to -1.
 */
struct flip_features {
    struct flip_kernel smooth, edge, point;
};

void flip_features_init(struct flip_features *features, double ppd);

/* Single-channel image; consecutive rows are `stride` texels apart. */
struct flip_plane {
    uint32_t width, height; /* texels */
    size_t stride;
    float *texels;
};

/* Returns the distance between consecutive rows, in texels. */
size_t flip_stride(uint32_t width);
size_t flip_line_size(uint32_t width); /* of flip_filter.line */

/* Separable filter with input and output of equal size. `out` may be the same plane as `in`. */
struct flip_filter {
    const struct flip_plane *in;
    const struct flip_kernel *across, *down; /* kernels along rows and along columns */
    struct flip_plane *scratch, *out;
    float *line; /* scratch memory, flip_line_size() floats */
    float scale; /* factor applied to the result */
    bool add;    /* add to `out` instead of replacing */
};

void flip_filter(const struct flip_filter *filter);

#endif
