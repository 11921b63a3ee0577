/* compare.h: two profiles side by side, and whether they differ by more than the noise. */
#ifndef FIRN_PROFILE_COMPARE_H
#define FIRN_PROFILE_COMPARE_H

#include <stdbool.h>
#include <stdio.h>
#include "src/profile/profile.h"

/*
 * Writes a table of PROFILE_COLUMNS columns: medians, ratio, and a verdict by the Mann-Whitney test
 * at 1 %, after Holm's correction for as many tests. Passes go by their names, and, if `each`, by
 * their repetitions, which are else added up. Says what differs in the conditions: device, size,
 * clock, settings and so on. *is_slower (may be NULL): a pass or the frame is, beyond the noise.
 */
MUST_USE enum status profile_compare(const struct profile *base, const struct profile *now,
                                     bool each, FILE *out, bool *is_slower);

#endif
