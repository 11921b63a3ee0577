/*
 * truth.h: the reference, traced beside the loop of a window, sample by sample.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_TRUTH_H
#define FIRN_VIEW_TRUTH_H

#include <pthread.h>
#include <stdatomic.h>
#include "src/reference/reference.h"

struct truth {
    pthread_t thread;
    bool runs;
    atomic_bool stop, done;
    struct settings settings; /* own: those of the window go on */
    struct reference_request request;
    struct renderer_shot shot;
    pthread_mutex_t lock; /* of what follows */
    struct image mean;    /* planes R, G, B; width 0: nothing yet */
    bool is_new;
    uint32_t samples;
    double noise;          /* reference.h */
    enum status status;    /* once it is done */
    uint32_t took_samples; /* of the mean that was taken last */
    double took_noise;
};

/* Begins to trace a shot; the scene must stay as it is until truth_stop(). Nothing may be running.
 * False: there is no thread for it, which is logged. */
bool truth_begin(struct truth *truth, const struct reference_request *request,
                 const struct renderer_shot *shot);

/* Ends it, and forgets what it has traced; {0} is fine. */
void truth_stop(struct truth *truth);

/* Takes the newest mean into *mean, which is finished before. False: there is no new one. */
bool truth_take(struct truth *truth, struct image *mean);

#endif
