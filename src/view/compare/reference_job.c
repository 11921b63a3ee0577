/* reference_job.c: worker thread that path-traces the reference image. */
#include "src/view/compare/reference_job.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/base/parallel.h"
#include "src/lab/reference/reference_sample_sums.h"
#include "src/render/weighted_mean.h"
#include "src/view/window/window.h"

static const char *const names[] = { "R", "G", "B", "A" };

/* Returns the sums of a value of reference_sample_sums.h; NULL if there are none. */
static const double *find_sum(const struct reference_sums *sums, size_t value)
{
    for (uint32_t i = 0; i < sums->count; i++) {
        if (sums->values[i] == value)
            return &sums->sums[i];
    }
    return NULL;
}

/* Writes the image to display: the weighted mean of the samples if it is summed, else the linear
 * mean. Returns false when out of memory. */
static bool make_mean(const struct reference_sums *sums, const struct settings *settings,
                      struct image *mean)
{
    const size_t size = (size_t)sums->width * sums->height;
    const double *alpha = find_sum(sums, reference_layers_find("A"));
    const double *weight = find_sum(sums, REFERENCE_SUM_WEIGHT);
    const bool is_weighted = alpha && weight;
    image_init(mean, sums->width, sums->height);
    for (size_t c = 0; c < 4; c++) {
        const bool is_weighed = is_weighted && c < 3; /* alpha is not */
        const double *sum = find_sum(sums, is_weighed ? REFERENCE_SUM_DISPLAY + c
                                                      : reference_layers_find(names[c]));
        float *texels = sum ? image_add_plane(mean, names[c], false) : NULL;
        if (!texels) {
            image_finish(mean);
            return false;
        }
        for (size_t i = 0; i < size; i++) {
            const size_t at = i * sums->count;
            const double factor = is_weighed
                                      ? weighted_mean_factor(alpha[at], weight[at], sums->samples)
                                      : 1.0 / sums->samples;
            texels[i] = (float)(sum[at] * factor);
        }
    }
    return !is_weighted || sums->samples < 2 || !weighted_mean_is_filtered(settings) ||
           weighted_mean_filter(mean, sums->weight_scale);
}

static double noise_of(const struct reference_sums *sums)
{
    const size_t size = (size_t)sums->width * sums->height;
    double sum = 0.0;
    for (size_t i = 0; i < size; i++)
        sum += reference_sums_error(&sums->sums[i * sums->count], sums->samples);
    return sum / (double)size;
}

static enum status save(void *user, const struct reference_sums *sums, bool is_last)
{
    struct reference_job *t = user;
    struct image mean;
    (void)is_last;
    if (!make_mean(sums, &t->settings, &mean))
        return log_out_of_memory("reference");
    const double noise = noise_of(sums);
    pthread_mutex_lock(&t->lock);
    image_finish(&t->mean);
    t->mean = mean;
    t->samples = sums->samples;
    t->noise = noise;
    t->is_new = true;
    pthread_mutex_unlock(&t->lock);
    window_wake();
    return STATUS_OK;
}

static bool goes_on(void *user, uint32_t done, uint32_t all)
{
    struct reference_job *t = user;
    (void)done;
    (void)all;
    return !atomic_load(&t->stop);
}

static void *run(void *user)
{
    struct reference_job *t = user;
    struct reference *reference = NULL;
    struct render_result result = { 0 };
    struct reference_session session = { .save = save, .user = t };
    enum status status = reference_create(&reference, &t->request);
    if (status == STATUS_OK)
        status = reference_continue(reference, &t->shot, &result, &session, goes_on, t);
    render_result_finish(&result);
    reference_destroy(reference);
    t->status = atomic_load(&t->stop) ? STATUS_OK : status;
    atomic_store(&t->done, true);
    window_wake();
    return NULL;
}

/* Returns the number of threads for path tracing. One core is left to the window's thread. */
static uint32_t thread_count(void)
{
    const uint32_t cores = machine_core_count();
    return cores > 2 ? cores - 1 : 1;
}

bool reference_job_begin(struct reference_job *t, const struct reference_request *request,
                         const struct renderer_shot *shot)
{
    *t = (struct reference_job){ .settings = *request->settings,
                                 .request = *request,
                                 .shot = *shot };
    t->request.settings = &t->settings;
    t->request.threads = thread_count();
    t->request.linear = true;
    if (pthread_mutex_init(&t->lock, NULL) != 0) {
        (void)log_out_of_memory("reference");
        return false;
    }
    t->runs = pthread_create(&t->thread, NULL, run, t) == 0;
    if (!t->runs) {
        pthread_mutex_destroy(&t->lock);
        (void)log_out_of_memory("reference");
    }
    return t->runs;
}

void reference_job_stop(struct reference_job *t)
{
    if (!t->runs)
        return;
    atomic_store(&t->stop, true);
    pthread_join(t->thread, NULL);
    pthread_mutex_destroy(&t->lock);
    image_finish(&t->mean);
    t->runs = false;
}

bool reference_job_take(struct reference_job *t, struct image *mean)
{
    if (!t->runs)
        return false;
    pthread_mutex_lock(&t->lock);
    const bool is_new = t->is_new;
    if (is_new) {
        image_finish(mean);
        *mean = t->mean;
        t->mean = (struct image){ 0 };
        t->is_new = false;
        t->taken_samples = t->samples;
        t->taken_noise = t->noise;
    }
    pthread_mutex_unlock(&t->lock);
    return is_new;
}
