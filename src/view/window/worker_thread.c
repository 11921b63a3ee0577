/* worker_thread.c: runs a job on a worker thread while the window handles events. */
#include "src/view/window/worker_thread.h"
#include <pthread.h>
#include <stdatomic.h>
#include "src/base/clock.h"

/* interval between checks for a closed window, and between callbacks, seconds */
static const double poll_seconds = 0.1;

struct job {
    worker_fn *work;
    void *user;
    enum status status;
    atomic_bool done;
};

static void *run(void *data)
{
    struct job *job = data;
    job->status = job->work(job->user);
    atomic_store(&job->done, true);
    window_wake();
    return NULL;
}

enum status worker_run(struct window *window, worker_fn *work, void *user)
{
    struct job job = { .work = work, .user = user };
    pthread_t thread;
    if (pthread_create(&thread, NULL, run, &job) != 0)
        return work(user); /* without a thread, the window is blocked during the job */
    const double start = clock_seconds();
    while (!atomic_load(&job.done)) {
        window_wait(window, poll_seconds);
        if (window->show_busy && !atomic_load(&job.done))
            window->show_busy(window->busy_user, clock_seconds() - start);
        if (window_is_closed(window))
            window->end(window->busy_user);
    }
    pthread_join(thread, NULL);
    return job.status;
}
