/* profile_job.h: what firn profile works on: one device, whose clock is known, for all frames. */
#ifndef FIRN_APP_PROFILE_JOB_H
#define FIRN_APP_PROFILE_JOB_H

#include "src/app/app.h"
#include "src/app/progress.h"
#include "src/profile/measure.h"
#include "src/profile/sweep.h"

struct profile_job {
    struct app_options o;
    struct gpu gpu; /* opened by the first frame, as is: */
    struct profile_clock clock;
    struct progress progress;
    struct profile baseline;
    struct profile_sweep sweep; /* {0}: none */
    char capture[MEASURE_PATH_SIZE];
};

/* Measures pictures in turn: each run of all before the next one. The profiles are {0}; after a
 * failure they may be anything that profile_finish() takes. */
MUST_USE enum status profile_job_measure(struct profile_job *job,
                                         const struct app_picture *pictures,
                                         struct profile *profiles, uint32_t count);

/* Writes the reports of job->sweep that the options name, and flushes what tables came before. */
MUST_USE enum status profile_job_write_sweep(const struct profile_job *job);

/* Tables go to stdout unless a file does. */
bool profile_job_has_table(const struct app_profile *given);

/* Writes a text, which it frees, if `made` says that there is one. */
MUST_USE enum status profile_job_write_text(const char *path, enum status made, char *text,
                                            size_t size);

/* firn profile paper: measures the paper's experiments as points of job->sweep. */
MUST_USE enum status profile_paper(struct profile_job *job);

#endif
