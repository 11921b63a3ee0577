/* thread_posix.c: threads, mutexes and condition variables on POSIX threads. */
#include "src/base/thread.h"

static void *run(void *user)
{
    const struct thread *thread = user;
    thread->fn(thread->user);
    return NULL;
}

bool thread_start(struct thread *thread, void (*fn)(void *user), void *user)
{
    thread->fn = fn;
    thread->user = user;
    return pthread_create(&thread->handle, NULL, run, thread) == 0;
}

void thread_join(struct thread *thread)
{
    pthread_join(thread->handle, NULL);
}

void mutex_init(struct mutex *mutex)
{
    pthread_mutex_init(&mutex->handle, NULL); /* cannot fail on Linux */
}

void mutex_finish(struct mutex *mutex)
{
    pthread_mutex_destroy(&mutex->handle);
}

void mutex_lock(struct mutex *mutex)
{
    pthread_mutex_lock(&mutex->handle);
}

void mutex_unlock(struct mutex *mutex)
{
    pthread_mutex_unlock(&mutex->handle);
}

void condition_init(struct condition *condition)
{
    pthread_cond_init(&condition->handle, NULL); /* cannot fail on Linux */
}

void condition_finish(struct condition *condition)
{
    pthread_cond_destroy(&condition->handle);
}

void condition_wait(struct condition *condition, struct mutex *mutex)
{
    pthread_cond_wait(&condition->handle, &mutex->handle);
}

void condition_wake_all(struct condition *condition)
{
    pthread_cond_broadcast(&condition->handle);
}
