/* parallel.h: splits an index range over threads. */
#ifndef FIRN_BASE_PARALLEL_H
#define FIRN_BASE_PARALLEL_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

enum {
    PARALLEL_THREADS_MAX = 256
};

/* Threads that run the same function. */
struct parallel_threads {
    pthread_t threads[PARALLEL_THREADS_MAX];
    uint32_t count;
};

/* Starts up to `count` threads; fewer if the system refuses. */
void parallel_start(struct parallel_threads *threads, uint32_t count, void *(*run)(void *user),
                    void *user);
void parallel_join(struct parallel_threads *threads);
uint32_t parallel_core_count(void); /* number of processor cores, at least 1 */

/* Called by the calling thread after each of its indices. Returning false skips the rest. */
typedef bool parallel_progress_fn(void *user, uint32_t done);

/* Calls fn(user, i) for each i below `count`, in ascending order, on up to `thread_count` threads,
 * including the calling one. If `progress` returns false, returns false. `progress` may be NULL. */
bool parallel_for(uint32_t count, uint32_t thread_count, void (*fn)(void *user, uint32_t i),
                  void *user, parallel_progress_fn *progress, void *progress_user);

#endif
