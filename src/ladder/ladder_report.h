/*
 * ladder_report.h: writes a ladder as table, JSON, contact sheet, plot, page and layers.
 *
 * Functions that return a status log errors and return STATUS_TRY_AGAIN when out of memory. Texts
 * and bytes are malloc'd, and the caller frees them; they are NULL on failure.
 */
#ifndef FIRN_LADDER_LADDER_REPORT_H
#define FIRN_LADDER_LADDER_REPORT_H

#include <stdio.h>
#include "src/ladder/ladder.h"

struct ladder_report {
    const struct ladder *ladder;
    const char *scene;   /* its name on the command line */
    const char *command; /* the whole command line, quoted for a shell */
    const char *device;  /* the device that drew the rungs; NULL without rungs */
    uint32_t samples;    /* per pixel */
};

/* Writes a table of at most 100 columns. */
void ladder_table(const struct ladder_report *report, FILE *out);

MUST_USE enum status ladder_json(const struct ladder_report *report, char **text, size_t *size);

/* Writes FLIP against cost, both on logarithmic axes, as an SVG file, which can be an element of a
 * page. Rungs whose cost was not measured are left out. */
MUST_USE enum status ladder_svg(const struct ladder_report *report, char **text, size_t *size);

/* Encodes a PNG file: the reference, and each rung's picture beside its FLIP in heat.h's
 * colours. */
MUST_USE enum status ladder_sheet(const struct ladder_report *report, void **data, size_t *size);

/* Writes one HTML file with table, plot, sheet, and each rung beside the reference. */
MUST_USE enum status ladder_page(const struct ladder_report *report, char **text, size_t *size);

/* Encodes an EXR file: the reference as R, G, B; each rung as RUNG.R, RUNG.G, RUNG.B and
 * RUNG.flip.Z. */
MUST_USE enum status ladder_exr(const struct ladder_report *report, void **data, size_t *size);

#endif
