/* reference_job.h: path-traces the reference image on a worker thread, sample by sample. Logs
 * errors. */
#ifndef FIRN_VIEW_COMPARE_REFERENCE_JOB_H
#define FIRN_VIEW_COMPARE_REFERENCE_JOB_H

#include <pthread.h>
#include <stdatomic.h>
#include "src/lab/reference/reference.h"

struct reference_job {
    pthread_t thread;
    bool runs;
    atomic_bool stop, done;
    struct settings settings; /* own copy of the viewer's settings */
    struct reference_request request;
    struct renderer_shot shot;
    pthread_mutex_t lock; /* protects the following members */
    struct image mean;    /* planes RGB; width 0 if none */
    bool is_new;
    uint32_t samples;
    double noise;           /* standard error, see reference.h */
    enum status status;     /* valid when `done` */
    uint32_t taken_samples; /* samples of the mean taken last */
    double taken_noise;
};

/* Starts to path-trace a view of a scene, which must not change before reference_job_stop(). Must
 * not be called during a job. If no thread can start, logs an error and returns false. */
bool reference_job_begin(struct reference_job *t, const struct reference_request *request,
                         const struct renderer_shot *shot);

/* Stops a running job and discards its result. */
void reference_job_stop(struct reference_job *t);

/* Replaces *mean by the newest mean image. Returns false if there is no new one. */
bool reference_job_take(struct reference_job *t, struct image *mean);

#endif
