/*
 * html.h: a profile as a page: one file that needs no network, draws the profile's JSON and works
 * by keyboard, in dark mode and on paper. Its sources are in page/.
 */
#ifndef FIRN_PROFILE_HTML_H
#define FIRN_PROFILE_HTML_H

#include <stddef.h>
#include "src/profile/profile.h"
#include "src/profile/sweep.h"

/*
 * `sweep`: drawn beside the profile, which may be one of its points; may be NULL.
 * *text ends in a newline and a 0 that *size does not count; free() it. On failure
 * (STATUS_TRY_AGAIN: memory is short) it is NULL.
 */
MUST_USE enum status profile_write_html(const struct profile *profile,
                                        const struct profile_sweep *sweep, char **text,
                                        size_t *size);

#endif
