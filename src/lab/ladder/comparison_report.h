/*
 * comparison_report.h: writes a model comparison as table, JSON, PNG or EXR. If out of memory,
 * functions log an error and return STATUS_TRY_AGAIN. The caller frees returned text and data,
 * which are NULL on failure.
 */
#ifndef FIRN_LAB_LADDER_COMPARISON_REPORT_H
#define FIRN_LAB_LADDER_COMPARISON_REPORT_H

#include <stdio.h>
#include "src/lab/ladder/refraction_model_comparison.h"

struct ladder_report {
    const struct ladder *ladder;
    const char *scene;   /* scene name of the command line */
    const char *command; /* command line, shell-quoted */
    const char *device;  /* GPU's name; NULL without models */
    uint32_t samples;    /* per pixel */
};

/* Writes a text table with lines of at most 100 characters. */
void ladder_table(const struct ladder_report *report, FILE *out);

MUST_USE enum status ladder_json(const struct ladder_report *report, char **text, size_t *size);

/* Encodes a PNG contact sheet: the reference, then each model's image and FLIP heat map. */
MUST_USE enum status ladder_sheet(const struct ladder_report *report, void **data, size_t *size);

/* Encodes an EXR file. R, G, B are the reference. Each model's layer has R, G, B and flip.Z. */
MUST_USE enum status ladder_exr(const struct ladder_report *report, void **data, size_t *size);

#endif
