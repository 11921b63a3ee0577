/*
 * theme.h: the colours of the window.
 *
 * 0xRRGGBB, sRGB-encoded. Text has a contrast of at least 4.5 with every surface that carries it,
 * marks and borders of at least 3 (WCAG 2.1, 1.4.3 and 1.4.11); a test computes both.
 */
#ifndef FIRN_VIEW_UI_THEME_H
#define FIRN_VIEW_UI_THEME_H

#include <stdint.h>

struct theme {
    const char *name;
    uint32_t surround; /* around the picture */
    uint32_t panel, raised, hover, pressed;
    uint32_t text, dim; /* on all of these; dim: on panel and raised */
    uint32_t accent;    /* what can be moved */
    uint32_t changed;   /* a mark and its words */
    uint32_t error;
    uint32_t border;
};

/* Theme i; NULL: there are no more. The first is the default. */
const struct theme *theme_at(uint32_t i);

/* Contrast of two colours by WCAG's formula, 1 to 21. */
double theme_contrast(uint32_t a, uint32_t b);

#endif
