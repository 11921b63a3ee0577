/* thread_win.h: the types of thread.h on Windows, without <windows.h>. */
#ifndef FIRN_BASE_THREAD_WIN_H
#define FIRN_BASE_THREAD_WIN_H

struct thread {
    void *handle;
    void (*fn)(void *user);
    void *user;
};

struct mutex {
    void *lock; /* SRWLOCK */
};

struct condition {
    void *variable; /* CONDITION_VARIABLE */
};

#define MUTEX_INITIALIZER \
    { \
        0 \
    }

#endif
