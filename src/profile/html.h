/*
 * html.h: writes a profile as a self-contained HTML page, which draws the profile's JSON, needs no
 * network and works by keyboard, in dark mode and on paper. Its sources are in page/.
 */
#ifndef FIRN_PROFILE_HTML_H
#define FIRN_PROFILE_HTML_H

#include <stddef.h>
#include "src/profile/profile.h"
#include "src/profile/sweep.h"

/*
 * Writes the page to *text, which the caller frees; it ends in a newline and a 0 that *size does
 * not count. `sweep`, which may be NULL, is drawn beside the profile, which may be one of its
 * points. Logs and returns STATUS_TRY_AGAIN when out of memory; *text is then NULL.
 */
MUST_USE enum status profile_write_html(const struct profile *profile,
                                        const struct profile_sweep *sweep, char **text,
                                        size_t *size);

#endif
