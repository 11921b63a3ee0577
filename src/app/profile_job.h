/* profile_job.h: state of firn profile: one device and clock that all measured frames share. */
#ifndef FIRN_APP_PROFILE_JOB_H
#define FIRN_APP_PROFILE_JOB_H

#include "src/app/app.h"
#include "src/app/progress.h"
#include "src/lab/profile/measure_frames.h"
#include "src/lab/profile/sweep_power_law.h"

struct profile_job {
    struct app_options o;
    struct gpu gpu;      /* opened by the first frame */
    enum rg_clock clock; /* RG_CLOCK_EXACT or RG_CLOCK_SUBMITS */
    struct progress progress;
    struct profile baseline;
    struct profile_sweep sweep; /* {0} if there is no sweep */
    char capture[MEASURE_PATH_SIZE];
};

/* Measures all images in turn, several times. The profiles must be empty. The caller frees the
 * profiles with profile_finish(), even after a failure. */
MUST_USE enum status profile_job_measure(struct profile_job *job, const struct setup_image *images,
                                         struct profile *profiles, uint32_t count);

/* Writes the sweep's report files that the options name. */
MUST_USE enum status profile_job_write_sweep(const struct profile_job *job);

/* Returns true if stdout is free for tables, because no report is written there. */
bool profile_job_has_table(const struct app_profile *options);

/* Writes the text to a file if `made` is STATUS_OK, else returns `made`. Always frees the text. */
MUST_USE enum status profile_job_write_text(const char *path, enum status made, char *text,
                                            size_t size);

/* Runs firn profile paper: measures the paper's experiments as points of job->sweep. */
MUST_USE enum status profile_paper(struct profile_job *job);

#endif
