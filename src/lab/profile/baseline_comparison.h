/* baseline_comparison.h: compares a profile with a baseline; significance tests separate changes
 * from noise. */
#ifndef FIRN_LAB_PROFILE_BASELINE_COMPARISON_H
#define FIRN_LAB_PROFILE_BASELINE_COMPARISON_H

#include <stdbool.h>
#include <stdio.h>
#include "src/lab/profile/profile_data.h"

/*
 * Writes a table of PROFILE_COLUMNS columns: medians, their ratio, and a verdict by the
 * Mann-Whitney test at 1 %, with Holm's correction for the number of tests. Passes are matched by
 * name and, if `each`, by repetition; otherwise repetitions are added up. Also lists different
 * conditions: device, size, clock, settings ... Sets *is_slower (may be NULL) if a pass or the
 * frame is significantly slower. When out of memory logs and returns STATUS_TRY_AGAIN.
 */
MUST_USE enum status profile_compare(const struct profile *base, const struct profile *now,
                                     bool each, FILE *out, bool *is_slower);

#endif
