/* signals.c: waits for termination signals in a thread. A handler would need global state. */
#include "src/base/signals.h"
#include <string.h>
#include <unistd.h>
#include "src/base/log.h"

static void *wait_for_signals(void *user)
{
    struct signals *stop = user;
    int number;
    if (sigwait(&stop->signals, &number) != 0)
        return NULL;
    pthread_mutex_lock(&stop->writing);
    /* end the line of the progress bar */
    const ssize_t written = isatty(STDERR_FILENO) ? write(STDERR_FILENO, "\n", 1) : 0;
    (void)written;
    const int code = number == SIGUSR1 ? STATUS_TRY_AGAIN : 128 + number;
    if (stop->last)
        stop->last(stop->user, code);
    _exit(code);
}

static bool is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

enum status signals_begin(struct signals *stop)
{
    static const int numbers[] = { SIGHUP, SIGINT, SIGTERM, SIGUSR1 };
    sigemptyset(&stop->signals);
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
        if (!is_ignored(numbers[i]))
            sigaddset(&stop->signals, numbers[i]);
    }
    pthread_mutex_init(&stop->writing, NULL); /* cannot fail on Linux */
    int error = pthread_sigmask(SIG_BLOCK, &stop->signals, NULL);
    if (!error)
        error = pthread_create(&stop->thread, NULL, wait_for_signals, stop);
    if (error) {
        log_error("cannot start the thread that waits for signals: %s", strerror(error));
        pthread_mutex_destroy(&stop->writing);
        return STATUS_TRY_AGAIN;
    }
    stop->begun = true;
    return STATUS_OK;
}

void signals_end(struct signals *stop)
{
    if (!stop->begun)
        return;
    pthread_cancel(stop->thread);
    pthread_join(stop->thread, NULL);
    pthread_mutex_destroy(&stop->writing);
    stop->begun = false;
}

void signals_hold(struct signals *stop)
{
    pthread_mutex_lock(&stop->writing);
}

void signals_release(struct signals *stop)
{
    pthread_mutex_unlock(&stop->writing);
}
