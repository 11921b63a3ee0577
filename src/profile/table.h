/* table.h: a profile as a table for people, in PROFILE_COLUMNS columns. */
#ifndef FIRN_PROFILE_TABLE_H
#define FIRN_PROFILE_TABLE_H

#include <stdbool.h>
#include <stdio.h>
#include "src/profile/profile.h"

/* Repetitions of a pass (cube faces) are added up in one line, unless `each`. */
MUST_USE enum status profile_table(const struct profile *profile, bool each, FILE *out);

/* Decimals that show a number of this size, and smaller ones beside it, with five digits. */
int profile_decimals(double greatest);

#endif
