/* color_primaries.h: conversion of linear colours from other RGB primaries to Rec.709. */
#ifndef FIRN_FILE_COLOR_PRIMARIES_H
#define FIRN_FILE_COLOR_PRIMARIES_H

#include <stdbool.h>
#include <stddef.h>

/* CIE xy chromaticities of red, green, blue and white, as in EXR's attribute `chromaticities`. */
struct primaries {
    float red[2], green[2], blue[2], white[2];
};

enum primaries_kind {
    PRIMARIES_REC709, /* equal within rounding */
    PRIMARIES_OTHER,
    PRIMARIES_INVALID, /* degenerate colour space */
};

/* Computes the row-major matrix from linear colours with primaries `from` to Rec.709. White stays
 * white (Bradford adaptation). Unless PRIMARIES_OTHER is returned, the matrix is the identity. */
enum primaries_kind primaries_to_rec709(const struct primaries *from, float matrix[static 9]);

/* Computes the row-major matrix from CIE XYZ, of which D65 is white, to linear Rec.709. */
void primaries_rec709_from_xyz(float matrix[static 9]);

/* Multiplies `count` colours by a row-major matrix. */
void primaries_convert(const float matrix[static 9], float *r, float *g, float *b, size_t count);

#endif
