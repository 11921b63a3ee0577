/*
 * json.h: a profile as JSON: all that struct profile holds. docs/profile.md names the keys.
 *
 * Numbers have as many digits as it takes: what was read is written again byte by byte. Bytes that
 * are no UTF-8 (a file's name may hold any) are written as '?'.
 */
#ifndef FIRN_PROFILE_JSON_H
#define FIRN_PROFILE_JSON_H

#include <stddef.h>
#include "src/profile/profile.h"

/* *text ends in a newline and a 0 that *size does not count; free() it. On failure (memory) it is
 * NULL. To put it into a page, write every '<' as \u003c: strings may hold "</script>". */
MUST_USE enum status profile_write_json(const struct profile *profile, char **text, size_t *size);

/*
 * Reads what profile_write_json() wrote; `summary` and `overhead` are derived and not looked at.
 * The file is not trusted: what is missing, of another type, out of range or in another number
 * than it says is STATUS_DATA. On failure *profile is {0}.
 */
MUST_USE enum status profile_read_json(const char *path, struct profile *profile);

#endif
