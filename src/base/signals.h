/* signals.h: termination signals that do not interrupt the writing of a file. SIGHUP, SIGINT and
 * SIGTERM end the program at once, whatever the device is doing, but not while a file is being
 * written: exit code 129, 130 or 143. SIGUSR1, which batch systems send before the time limit, ends
 * it with 75: retry later. Signals that were ignored at the start (nohup) stay so. */
#ifndef FIRN_BASE_SIGNALS_H
#define FIRN_BASE_SIGNALS_H

#include <stdbool.h>
#include "src/base/status.h"
#include "src/base/thread.h"

struct signals {
    struct thread thread; /* waits for the blocked signals */
    struct mutex writing;
    bool begun;
    void (*last)(void *user, int code); /* callback before a signal ends the program; may be NULL */
    void *user;
};

/* Blocks the termination signals and starts the thread that waits for them. Must be called before
 * other threads exist, because they inherit the signal mask. Only `last` and `user` may be set in
 * *stop. *stop must not move afterwards. On failure, logs why and returns STATUS_TRY_AGAIN. */
MUST_USE enum status signals_begin(struct signals *stop);

/* Stops the waiting thread. The signals stay blocked and do nothing. *stop may be {0}. */
void signals_end(struct signals *stop);

/* Ends the program at once, as a signal does, but not while a file is being written. */
_Noreturn void signals_exit(struct signals *stop, int code);

/* Delays signals until signals_release(), for example while a file is written. */
void signals_hold(struct signals *stop);
void signals_release(struct signals *stop);

#endif
