/*
 * signals.h: SIGHUP, SIGINT and SIGTERM end the program at once, whatever the device is doing, but
 * not while a file is being written: exit code 129, 130 or 143. So does SIGUSR1, with 75: whoever
 * sends it wants the same to be started again later, as batch systems do before the time is up. A
 * signal that was ignored when the program began (nohup, a shell's background job) stays ignored.
 */
#ifndef FIRN_APP_SIGNALS_H
#define FIRN_APP_SIGNALS_H

#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include "src/base/status.h"

struct signals {
    pthread_t thread; /* waits for the signals, which all other threads block */
    pthread_mutex_t writing;
    sigset_t signals;
    bool begun;
    void (*last)(void *user, int code); /* called before a signal ends the program; may be NULL */
    void *user;
};

/*
 * Before any other thread exists, for it must inherit what is blocked. *stop is {0} but for `last`
 * and `user`, and must not move afterwards. Logs: STATUS_TRY_AGAIN.
 */
MUST_USE enum status signals_begin(struct signals *stop);

/* From here on the signals are blocked and do nothing. {0} is fine. */
void signals_end(struct signals *stop);

/* Around the writing of a file, and the changing of what `last` reads. */
void signals_hold(struct signals *stop);
void signals_release(struct signals *stop);

#endif
