/* thread_win.c: threads, mutexes and condition variables on Windows. */
#include <process.h>
#include <stdint.h>
#include <windows.h>
#include "src/base/thread.h"

_Static_assert(sizeof(struct mutex) == sizeof(SRWLOCK), "");
_Static_assert(sizeof(struct condition) == sizeof(CONDITION_VARIABLE), "");

static unsigned __stdcall run(void *user)
{
    const struct thread *thread = user;
    thread->fn(thread->user);
    return 0;
}

bool thread_start(struct thread *thread, void (*fn)(void *user), void *user)
{
    thread->fn = fn;
    thread->user = user;
    thread->handle = (HANDLE)_beginthreadex(NULL, 0, run, thread, 0, NULL);
    return thread->handle;
}

void thread_join(struct thread *thread)
{
    (void)WaitForSingleObject(thread->handle, INFINITE);
    (void)CloseHandle(thread->handle);
}

void mutex_init(struct mutex *mutex)
{
    *mutex = (struct mutex)MUTEX_INITIALIZER;
}

void mutex_finish(struct mutex *mutex)
{
    (void)mutex;
}

void mutex_lock(struct mutex *mutex)
{
    AcquireSRWLockExclusive((SRWLOCK *)(void *)mutex);
}

void mutex_unlock(struct mutex *mutex)
{
    ReleaseSRWLockExclusive((SRWLOCK *)(void *)mutex);
}

void condition_init(struct condition *condition)
{
    *condition = (struct condition){ 0 };
}

void condition_finish(struct condition *condition)
{
    (void)condition;
}

void condition_wait(struct condition *condition, struct mutex *mutex)
{
    (void)SleepConditionVariableSRW((CONDITION_VARIABLE *)(void *)condition,
                                    (SRWLOCK *)(void *)mutex, INFINITE, 0);
}

void condition_wake_all(struct condition *condition)
{
    WakeAllConditionVariable((CONDITION_VARIABLE *)(void *)condition);
}
