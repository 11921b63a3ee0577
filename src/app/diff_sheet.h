/* diff_sheet.h: the two pictures that firn diff compares, beside the picture of their errors. */
#ifndef FIRN_APP_DIFF_SHEET_H
#define FIRN_APP_DIFF_SHEET_H

#include "src/base/status.h"
#include "src/image/image.h"

struct diff_sheet {
    const struct image *reference, *test; /* linear, with R, G, B, of one size */
    const float *errors;                  /* FLIP, width * height */
    const bool *counted;                  /* the others are black; NULL: all */
    double flip;                          /* mean of those that are counted */
    float exposure;                       /* of both pictures, stops */
};

/* Encode a PNG file, *data (malloc'd, the caller frees it) of *size bytes: the errors alone, or
 * both pictures, the errors and their scale. Log: STATUS_TRY_AGAIN or STATUS_FAILED. */
MUST_USE enum status diff_sheet_heat(const struct diff_sheet *sheet, void **data, size_t *size);
MUST_USE enum status diff_sheet_all(const struct diff_sheet *sheet, void **data, size_t *size);

#endif
