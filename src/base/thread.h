/* thread.h: threads, mutexes and condition variables. The objects must not move while in use. */
#ifndef FIRN_BASE_THREAD_H
#define FIRN_BASE_THREAD_H

#include <stdbool.h>
#ifdef _WIN32
#include "src/base/thread_win.h"
#else
#include "src/base/thread_posix.h"
#endif

/* Starts a thread that calls fn(user). Returns false if the system refuses. */
bool thread_start(struct thread *thread, void (*fn)(void *user), void *user);

/* Waits for the end of a thread, once per thread. */
void thread_join(struct thread *thread);

/* A mutex may also be initialised with MUTEX_INITIALIZER. It must not be locked recursively. */
void mutex_init(struct mutex *mutex);
void mutex_finish(struct mutex *mutex);
void mutex_lock(struct mutex *mutex);
void mutex_unlock(struct mutex *mutex);

/* condition_wait() unlocks the mutex while it waits, and may return without a wake-up. */
void condition_init(struct condition *condition);
void condition_finish(struct condition *condition);
void condition_wait(struct condition *condition, struct mutex *mutex);
void condition_wake_all(struct condition *condition);

#endif
