/*
 * comparison_report.h: writes a comparison of refraction models as table, JSON, PNG, SVG, HTML or
 * EXR.
 *
 * Functions that return a status log errors and return STATUS_TRY_AGAIN when out of memory. Text
 * and data are allocated by malloc and freed by the caller; they are NULL on failure.
 */
#ifndef FIRN_LADDER_COMPARISON_REPORT_H
#define FIRN_LADDER_COMPARISON_REPORT_H

#include <stdio.h>
#include "src/ladder/model_comparison.h"

struct ladder_report {
    const struct ladder *ladder;
    const char *scene;   /* scene name as on the command line */
    const char *command; /* whole command line, quoted for a shell */
    const char *device;  /* GPU that rendered the models; NULL if there are none */
    uint32_t samples;    /* per pixel */
};

/* Writes a text table of at most 100 columns. */
void ladder_table(const struct ladder_report *report, FILE *out);

MUST_USE enum status ladder_json(const struct ladder_report *report, char **text, size_t *size);

/* Writes FLIP over cost, both on logarithmic axes, as an SVG file that can also be embedded in
 * HTML. Models without measured cost are omitted. */
MUST_USE enum status ladder_svg(const struct ladder_report *report, char **text, size_t *size);

/* Encodes a contact sheet as PNG: the reference; each model's image and its FLIP heat map. */
MUST_USE enum status ladder_sheet(const struct ladder_report *report, void **data, size_t *size);

/* Writes one HTML file with table, plot, contact sheet, and a slider over each model's image. */
MUST_USE enum status ladder_page(const struct ladder_report *report, char **text, size_t *size);

/* Encodes an EXR file: the reference as R, G, B; each model as layer NAME with R, G, B, flip.Z. */
MUST_USE enum status ladder_exr(const struct ladder_report *report, void **data, size_t *size);

#endif
