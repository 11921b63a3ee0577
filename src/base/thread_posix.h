/* thread_posix.h: the types of thread.h on POSIX threads. */
#ifndef FIRN_BASE_THREAD_POSIX_H
#define FIRN_BASE_THREAD_POSIX_H

#include <pthread.h>

struct thread {
    pthread_t handle;
    void (*fn)(void *user);
    void *user;
};

struct mutex {
    pthread_mutex_t handle;
};

struct condition {
    pthread_cond_t handle;
};

#define MUTEX_INITIALIZER \
    { \
        PTHREAD_MUTEX_INITIALIZER \
    }

#endif
