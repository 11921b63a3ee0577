/* profile_sample.h: a synthetic profile in which every field is set. */
#ifndef TESTS_PROFILE_SAMPLE_H
#define TESTS_PROFILE_SAMPLE_H

#include "src/lab/profile/profile_data.h"

enum {
    SAMPLE_RUN_COUNT = 20,
    SAMPLE_PASS_COUNT = 5
};

/*
 * Fills a profile with five passes of 1, 1, 8, 2 and 0.5 ms, the first two repetitions of one pass,
 * and with 0.3 ms of recording, 0.1 of submission and 0.1 unattributed; each times `scale`, with
 * noise of a few percent. In run 7 the third pass takes three times as long. In every run the rows
 * add up to the frame time.
 */
void profile_sample(struct profile *profile, double scale);

#endif
