/* profile_sample.h: a synthetic profile in which every field is set. */
#ifndef TESTS_PROFILE_SAMPLE_H
#define TESTS_PROFILE_SAMPLE_H

#include "src/profile/profile.h"

enum {
    SAMPLE_RUN_COUNT = 20,
    SAMPLE_PASS_COUNT = 5
};

/*
 * Five passes (two are repetitions of one row) of 1, 1, 8, 2 and 0.5 ms, record 0.3, submit 0.1 and
 * unattributed 0.1, each times `scale`, with deterministic noise of a few percent. In run 7 the
 * third pass takes three times as long. In every run the rows add up to the frame time.
 */
void profile_sample(struct profile *profile, double scale);

#endif
