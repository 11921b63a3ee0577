/* ladder_cost.c: measures the frame times of several renderers alternately. */
#include "src/lab/ladder/ladder_cost.h"
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/lab/profile/statistics.h"

static enum status time_frame(struct renderer *renderer, const struct renderer_shot *shot,
                              double *ms)
{
    const double start = clock_ms();
    enum status status = renderer_draw(renderer, shot);
    if (status == STATUS_OK)
        status = renderer_wait(renderer);
    *ms = clock_ms() - start;
    return status;
}

/* Stores the frame time of renderer i in run r in samples[i * run_count + r]. A warm-up run comes
 * first, whose times are overwritten by run 0. */
static enum status time_all(struct renderer *const *renderers,
                            const struct ladder_cost_request *request, double *samples,
                            renderer_progress_fn *progress, void *user)
{
    enum status status = STATUS_OK;
    for (uint32_t run = 0; run <= request->run_count && status == STATUS_OK; run++) {
        const uint32_t sample = run ? run - 1 : 0;
        for (uint32_t i = 0; i < request->count && status == STATUS_OK; i++)
            status = time_frame(renderers[i], &request->shot,
                                &samples[(size_t)i * request->run_count + sample]);
        if (status == STATUS_OK && progress && !progress(user, run, request->run_count))
            status = STATUS_FAILED;
    }
    return status;
}

enum status ladder_cost(const struct ladder_cost_request *request, double *costs,
                        renderer_progress_fn *progress, void *user)
{
    struct renderer **renderers = calloc(request->count, sizeof(struct renderer *));
    double *samples = calloc((size_t)request->count * request->run_count, sizeof(*samples));
    enum status status = samples && renderers ? STATUS_OK : log_out_of_memory(NULL);
    for (uint32_t i = 0; i < request->count && status == STATUS_OK; i++) {
        struct renderer_params params = request->renderers[i];
        params.keep = true;
        status = renderer_create(&renderers[i], &params);
    }
    if (status == STATUS_OK)
        status = time_all(renderers, request, samples, progress, user);
    for (uint32_t i = 0; i < request->count && renderers; i++) {
        if (status == STATUS_OK)
            costs[i] =
                profile_summarize(&samples[(size_t)i * request->run_count], request->run_count)
                    .median;
        renderer_destroy(renderers[i]);
    }
    free(samples);
    free(renderers);
    return status;
}
