/* signals_posix.c: waits for termination signals in a thread. A handler would need global state. */
#include <signal.h>
#include <string.h>
#include <unistd.h>
#include "src/base/log.h"
#include "src/base/signals.h"

static bool is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

/* Returns the termination signals that the program does not ignore. */
static sigset_t termination_signals(void)
{
    static const int numbers[] = { SIGHUP, SIGINT, SIGTERM, SIGUSR1 };
    sigset_t signals;
    sigemptyset(&signals);
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
        if (!is_ignored(numbers[i]))
            sigaddset(&signals, numbers[i]);
    }
    return signals;
}

static void wait_for_signals(void *user)
{
    struct signals *stop = user;
    const sigset_t signals = termination_signals();
    int number;
    if (sigwait(&signals, &number) != 0)
        return;
    mutex_lock(&stop->writing);
    /* end the line of the progress bar */
    const ssize_t written = isatty(STDERR_FILENO) ? write(STDERR_FILENO, "\n", 1) : 0;
    (void)written;
    const int code = number == SIGUSR1 ? STATUS_TRY_AGAIN : 128 + number;
    if (stop->last)
        stop->last(stop->user, code);
    _exit(code);
}

void signals_exit(struct signals *stop, int code)
{
    mutex_lock(&stop->writing);
    _exit(code);
}

enum status signals_begin(struct signals *stop)
{
    const sigset_t signals = termination_signals();
    const int error = pthread_sigmask(SIG_BLOCK, &signals, NULL);
    mutex_init(&stop->writing);
    if (!error && thread_start(&stop->thread, wait_for_signals, stop)) {
        stop->begun = true;
        return STATUS_OK;
    }
    log_error("cannot start the thread that waits for signals: %s",
              error ? strerror(error) : "the limit of threads is reached (ulimit -u)");
    mutex_finish(&stop->writing);
    return STATUS_TRY_AGAIN;
}

void signals_end(struct signals *stop)
{
    if (!stop->begun)
        return;
    pthread_cancel(stop->thread.handle);
    thread_join(&stop->thread);
    mutex_finish(&stop->writing);
    stop->begun = false;
}

void signals_hold(struct signals *stop)
{
    mutex_lock(&stop->writing);
}

void signals_release(struct signals *stop)
{
    mutex_unlock(&stop->writing);
}
