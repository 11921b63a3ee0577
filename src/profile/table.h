/* table.h: prints a profile as a table of PROFILE_COLUMNS columns. */
#ifndef FIRN_PROFILE_TABLE_H
#define FIRN_PROFILE_TABLE_H

#include <stdbool.h>
#include <stdio.h>
#include "src/profile/profile.h"

/* Prints the table. Repetitions of a pass (cube faces) are added up in one line, unless `each`.
 * Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status profile_table(const struct profile *profile, bool each, FILE *out);

/* Returns the number of decimals with which `greatest` has five digits, for a column of numbers. */
int profile_decimals(double greatest);

#endif
