/* table.h: prints a profile as a text table of PROFILE_COLUMNS columns. */
#ifndef FIRN_PROFILE_TABLE_H
#define FIRN_PROFILE_TABLE_H

#include <stdbool.h>
#include <stdio.h>
#include "src/profile/profile.h"

/* Prints the table. Repetitions of a pass, such as cube faces, are added up in one line unless
 * `each` is true. When out of memory logs and returns STATUS_TRY_AGAIN. */
MUST_USE enum status profile_table(const struct profile *profile, bool each, FILE *out);

/* Returns the number of decimals with which `greatest` has five significant digits. */
int profile_decimals(double greatest);

#endif
