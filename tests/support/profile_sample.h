/* profile_sample.h: a profile made by hand in which every field is set. */
#ifndef TESTS_PROFILE_SAMPLE_H
#define TESTS_PROFILE_SAMPLE_H

#include "src/profile/profile.h"

enum {
    SAMPLE_RUN_COUNT = 20,
    SAMPLE_PASS_COUNT = 5
};

/*
 * Five passes (two are repetitions of one row) of 1, 1, 8, 2 and 0.5 ms, record .3, submit .1 and
 * unattributed .1, each times `scale`, with a spread of a few percent that is the same every time.
 * In run 7 the third pass takes three times as long. Rows add up to the frame in every run.
 */
void profile_sample(struct profile *profile, double scale);

#endif
