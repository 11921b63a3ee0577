/*
 * json.h: writes and reads profiles as JSON with all of struct profile. docs/profile.md describes
 * the keys.
 *
 * Numbers have full precision: a profile that was read is written again byte by byte. Bytes that
 * are not UTF-8, which a file's name may have, are written as '?'.
 */
#ifndef FIRN_PROFILE_JSON_H
#define FIRN_PROFILE_JSON_H

#include <stddef.h>
#include "src/profile/profile.h"

/* Writes a profile to *text, which the caller frees; it ends in a newline and a 0 that *size does
 * not count. Logs and returns STATUS_TRY_AGAIN when out of memory; *text is then NULL. In a page
 * every '<' must be written as \u003c, because strings may have "</script>". */
MUST_USE enum status profile_write_json(const struct profile *profile, char **text, size_t *size);

/*
 * Reads a file of profile_write_json(); `summary` and `overhead` are derived and therefore ignored.
 * The file is not trusted: missing keys, other types, values out of range and wrong counts are a
 * logged STATUS_DATA. On failure *profile is {0}.
 */
MUST_USE enum status profile_read_json(const char *path, struct profile *profile);

#endif
