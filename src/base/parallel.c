/* parallel.c: splits an index range over threads. */
#include "src/base/parallel.h"
#include <stdatomic.h>
#include <unistd.h>

struct range {
    uint32_t count;
    atomic_uint next, done;
    atomic_bool is_stopped;
    void (*fn)(void *user, uint32_t i);
    void *user;
};

void parallel_start(struct parallel_threads *threads, uint32_t count, void *(*run)(void *user),
                    void *user)
{
    threads->count = 0;
    while (threads->count < count && threads->count < PARALLEL_THREADS_MAX &&
           !pthread_create(&threads->threads[threads->count], NULL, run, user))
        threads->count++;
}

void parallel_join(struct parallel_threads *threads)
{
    while (threads->count)
        pthread_join(threads->threads[--threads->count], NULL);
}

uint32_t parallel_core_count(void)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 0 ? (uint32_t)cores : 1;
}

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

static void *run(void *user)
{
    while (process_next(user)) {
    }
    return NULL;
}

bool parallel_for(uint32_t count, uint32_t thread_count, void (*fn)(void *user, uint32_t i),
                  void *user, parallel_progress_fn *progress, void *progress_user)
{
    struct range range = { .count = count, .fn = fn, .user = user };
    struct parallel_threads threads;
    const uint32_t thread_max = thread_count < count ? thread_count : count;
    parallel_start(&threads, thread_max ? thread_max - 1 : 0, run, &range);
    while (process_next(&range)) {
        if (progress && !progress(progress_user, atomic_load(&range.done)))
            atomic_store(&range.is_stopped, true);
    }
    parallel_join(&threads);
    return !atomic_load(&range.is_stopped);
}
