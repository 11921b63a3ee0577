/*
 * ladder_report.h: a ladder as table, JSON, contact sheet, plot, page and layers.
 *
 * Everything that returns a status logs: STATUS_TRY_AGAIN when memory is short. Texts and bytes are
 * malloc'd, the caller frees them; NULL on failure.
 */
#ifndef FIRN_LADDER_LADDER_REPORT_H
#define FIRN_LADDER_LADDER_REPORT_H

#include <stdio.h>
#include "src/ladder/ladder.h"

struct ladder_report {
    const struct ladder *ladder;
    const char *scene;   /* as the command line names it */
    const char *command; /* the whole command line, as a shell takes it */
    const char *device;  /* that drew the rungs; NULL without rungs */
    uint32_t samples;    /* a pixel */
};

/* In 100 columns. */
void ladder_table(const struct ladder_report *report, FILE *out);

MUST_USE enum status ladder_json(const struct ladder_report *report, char **text, size_t *size);

/* FLIP against cost, both on logarithmic axes: an SVG file, or the element of a page. Rungs whose
 * cost was not measured are not there. */
MUST_USE enum status ladder_svg(const struct ladder_report *report, char **text, size_t *size);

/* PNG: the reference, and of each rung its picture beside its FLIP in the colours of heat.h. */
MUST_USE enum status ladder_sheet(const struct ladder_report *report, void **data, size_t *size);

/* One HTML file: table, plot, sheet. */
MUST_USE enum status ladder_page(const struct ladder_report *report, char **text, size_t *size);

/* EXR: the reference as R, G, B; each rung as RUNG.R, RUNG.G, RUNG.B and RUNG.flip.Z. */
MUST_USE enum status ladder_exr(const struct ladder_report *report, void **data, size_t *size);

#endif
