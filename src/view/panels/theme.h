/* theme.h: colour themes of the user interface. Colours are 0xRRGGBB, sRGB-encoded. Contrast with
 * the background is at least 4.5 for text. For marks and borders, the contrast is at least 3. WCAG
 * 2.1 requires these limits (1.4.3, 1.4.11). */
#ifndef FIRN_VIEW_PANELS_THEME_H
#define FIRN_VIEW_PANELS_THEME_H

#include <stdint.h>

struct theme {
    const char *name;
    uint32_t surround; /* margins around the image */
    uint32_t panel, raised, hover, pressed;
    uint32_t text, dim; /* dim only on panel and raised */
    uint32_t accent;    /* draggable elements */
    uint32_t changed;   /* mark and text of changed settings */
    uint32_t error;
    uint32_t border;
};

/* Returns theme i; NULL after the last. The first is the default. */
const struct theme *theme_at(uint32_t i);

#endif
