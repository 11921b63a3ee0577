/*
 * json.h: writes and reads profiles as JSON, with all members of struct profile. docs/profile.md
 * describes the keys. Numbers have full precision, so a file that is read and written again does
 * not change. Bytes that are not UTF-8 become '?'.
 */
#ifndef FIRN_LAB_PROFILE_JSON_H
#define FIRN_LAB_PROFILE_JSON_H

#include <stddef.h>
#include "src/lab/profile/profile_data.h"

/* Writes a profile to *text, which the caller frees. *size excludes the final '\0'. If out of
 * memory, logs an error, sets *text to NULL and returns STATUS_TRY_AGAIN. */
MUST_USE enum status profile_write_json(const struct profile *profile, char **text, size_t *size);

/*
 * Reads a file written by profile_write_json(). The file is untrusted. If keys are missing or data
 * are invalid, logs an error and returns STATUS_DATA. Ignores `summary` and `overhead`, because
 * they can be derived. On failure *profile is zeroed.
 */
MUST_USE enum status profile_read_json(const char *path, struct profile *profile);

#endif
