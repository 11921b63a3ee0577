/* parallel.c: splits an index range over threads. */
#include "src/base/parallel.h"
#include <stdatomic.h>
#include "src/base/log.h"
#include "src/base/thread.h"

enum {
    THREADS_MAX = 256
};

struct range {
    uint32_t count;
    atomic_uint next, done;
    atomic_bool is_stopped;
    void (*fn)(void *user, uint32_t i);
    void *user;
    struct log_sink *sink; /* of the calling thread */
};

/* Processes the next index. Returns false if none is left. */
static bool process_next(struct range *range)
{
    const uint32_t i = atomic_fetch_add(&range->next, 1);
    if (i >= range->count || atomic_load(&range->is_stopped))
        return false;
    range->fn(range->user, i);
    atomic_fetch_add(&range->done, 1);
    return true;
}

static void run(void *user)
{
    struct range *range = user;
    log_set_sink(range->sink);
    while (process_next(range)) {
    }
}

bool parallel_for(uint32_t count, uint32_t thread_count, void (*fn)(void *user, uint32_t i),
                  void *user, parallel_progress_fn *progress, void *progress_user)
{
    struct range range = { .count = count, .fn = fn, .user = user, .sink = log_get_sink() };
    struct thread threads[THREADS_MAX];
    uint32_t started = 0;
    const uint32_t thread_max = thread_count < count ? thread_count : count;
    /* the calling thread works, too; the system may refuse further ones */
    while (started + 1 < thread_max && started < THREADS_MAX &&
           thread_start(&threads[started], run, &range))
        started++;
    while (process_next(&range)) {
        if (progress && !progress(progress_user, atomic_load(&range.done)))
            atomic_store(&range.is_stopped, true);
    }
    while (started)
        thread_join(&threads[--started]);
    return !atomic_load(&range.is_stopped);
}
