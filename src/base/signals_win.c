/* signals_win.c: console events that end the program: Ctrl+C, Ctrl+Break, closing, logging off. */
#include <stdatomic.h>
#include <stdlib.h>
#include <windows.h>
#include "src/base/log.h"
#include "src/base/signals.h"

/* The struct that signals_begin() got, because the handler of console events has no argument. */
static struct signals *_Atomic active;

static BOOL WINAPI handle_event(DWORD event)
{
    enum {
        INTERRUPTED = 130,
        TERMINATED = 143
    };
    struct signals *stop = atomic_load(&active);
    const int code = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT ? INTERRUPTED : TERMINATED;
    if (!stop)
        return FALSE;
    mutex_lock(&stop->writing);
    if (stop->last)
        stop->last(stop->user, code);
    _Exit(code);
}

enum status signals_begin(struct signals *stop)
{
    mutex_init(&stop->writing);
    atomic_store(&active, stop);
    stop->begun = SetConsoleCtrlHandler(handle_event, TRUE);
    if (stop->begun)
        return STATUS_OK;
    log_error("cannot wait for console events: error %lu", GetLastError());
    mutex_finish(&stop->writing);
    return STATUS_TRY_AGAIN;
}

void signals_end(struct signals *stop)
{
    if (!stop->begun)
        return;
    (void)SetConsoleCtrlHandler(handle_event, FALSE);
    atomic_store(&active, NULL);
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

void signals_exit(struct signals *stop, int code)
{
    mutex_lock(&stop->writing);
    _Exit(code);
}
