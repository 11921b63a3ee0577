/* worker.c: a thread for work, this one for the window. */
#include "src/view/worker.h"
#include <pthread.h>
#include <stdatomic.h>

static const double look_seconds = 0.1; /* between looks at a window where nothing happens */

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
        return work(user); /* then the window waits, too */
    while (!atomic_load(&job.done)) {
        window_wait(window, look_seconds);
        if (window_is_closed(window))
            window_hide(window);
    }
    pthread_join(thread, NULL);
    return job.status;
}
