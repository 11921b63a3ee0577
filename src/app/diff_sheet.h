/* diff_sheet.h: draws two compared images and the image of their errors side by side into a PNG. */
#ifndef FIRN_APP_DIFF_SHEET_H
#define FIRN_APP_DIFF_SHEET_H

#include "src/base/status.h"
#include "src/file/image.h"

struct diff_sheet {
    const struct image *reference, *test; /* linear RGB of one size */
    const float *errors;                  /* FLIP, width * height */
    const bool *counted;                  /* pixels to compare; NULL: all */
    double flip;                          /* mean over the compared pixels */
    float exposure;                       /* exposure of both images, stops */
};

/* Encode the image of errors as a PNG file in *data, which the caller frees. diff_sheet_all() adds
 * both images and a colour scale. If encoding fails, both functions log and return an error. */
MUST_USE enum status diff_sheet_heat(const struct diff_sheet *sheet, void **data, size_t *size);
MUST_USE enum status diff_sheet_all(const struct diff_sheet *sheet, void **data, size_t *size);

#endif
