/*
 * html_page.h: writes a profile as a self-contained HTML page with plots, which needs no network
 * and supports keyboard, dark mode and printing. Its sources are in page/.
 */
#ifndef FIRN_PROFILE_HTML_PAGE_H
#define FIRN_PROFILE_HTML_PAGE_H

#include <stddef.h>
#include "src/profile/profile.h"
#include "src/profile/sweep.h"

/*
 * Writes the page to *text, which the caller frees; it ends with a newline and a '\0' that *size
 * does not count. Unless NULL, `sweep` is also plotted; `profile` may be one of its points. When
 * out of memory logs, returns STATUS_TRY_AGAIN and sets *text to NULL.
 */
MUST_USE enum status profile_write_html(const struct profile *profile,
                                        const struct profile_sweep *sweep, char **text,
                                        size_t *size);

#endif
