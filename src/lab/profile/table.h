/* table.h: prints a profile as a text table with lines of PROFILE_COLUMNS characters. */
#ifndef FIRN_LAB_PROFILE_TABLE_H
#define FIRN_LAB_PROFILE_TABLE_H

#include <stdbool.h>
#include <stdio.h>
#include "src/lab/profile/profile_data.h"

/* Prints the table. If `each` is true, each repetition of a pass has a line. Otherwise, a line adds
 * up all repetitions. If out of memory, logs an error and returns STATUS_TRY_AGAIN. */
MUST_USE enum status profile_table(const struct profile *profile, bool each, FILE *out);

/* Returns the number of decimals that show `greatest` with five significant digits. */
int profile_decimals(double greatest);

#endif
