/* parallel.h: splits an index range over threads. */
#ifndef FIRN_BASE_PARALLEL_H
#define FIRN_BASE_PARALLEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Called by the calling thread after each of its indices. Returning false skips the rest. */
typedef bool parallel_progress_fn(void *user, uint32_t done);

/* Calls fn(user, i) for each i below `count`, in ascending order, on up to `thread_count` threads,
 * including the calling one. If `progress` returns false, returns false. `progress` may be NULL. */
bool parallel_for(uint32_t count, uint32_t thread_count, void (*fn)(void *user, uint32_t i),
                  void *user, parallel_progress_fn *progress, void *progress_user);

#endif
