/*
 * json.h: writes and reads profiles as JSON, with all members of struct profile. docs/profile.md
 * describes the keys. Numbers have full precision, so reading and writing a file reproduces it
 * exactly. Bytes that are not UTF-8 become '?'.
 */
#ifndef FIRN_LAB_PROFILE_JSON_H
#define FIRN_LAB_PROFILE_JSON_H

#include <stddef.h>
#include "src/lab/profile/profile_data.h"

/* Writes a profile to *text, which the caller frees. *size excludes the text's final '\0'. When out
 * of memory logs, returns STATUS_TRY_AGAIN and sets *text to NULL. */
MUST_USE enum status profile_write_json(const struct profile *profile, char **text, size_t *size);

/*
 * Reads a file of profile_write_json(). Ignores `summary` and `overhead`, which can be derived. The
 * file is untrusted: missing keys, wrong types, values out of range and wrong counts are logged and
 * return STATUS_DATA. On failure *profile is zeroed.
 */
MUST_USE enum status profile_read_json(const char *path, struct profile *profile);

#endif
