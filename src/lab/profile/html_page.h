/*
 * html_page.h: writes a profile as one HTML page with plots. The page needs no network and supports
 * keyboard, dark mode and printing. The sources of the page are in page/.
 */
#ifndef FIRN_LAB_PROFILE_HTML_PAGE_H
#define FIRN_LAB_PROFILE_HTML_PAGE_H

#include <stddef.h>
#include "src/lab/profile/profile_data.h"
#include "src/lab/profile/sweep_power_law.h"

/*
 * Writes the page to *text, which the caller frees. *size is the length of the text with its final
 * newline, but without its '\0'. If `sweep` is not NULL, the page also plots it. `profile` may be a
 * point of the sweep. When out of memory logs, returns STATUS_TRY_AGAIN and sets *text to NULL.
 */
MUST_USE enum status profile_write_html(const struct profile *profile,
                                        const struct profile_sweep *sweep, char **text,
                                        size_t *size);

#endif
