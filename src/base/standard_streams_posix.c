/* standard_streams_posix.c: replaces closed standard streams; reports failed writes to stdout. */
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>
#include "src/base/log.h"
#include "src/base/standard_streams.h"

void standard_streams_begin(void)
{
    for (int file = STDIN_FILENO; file <= STDERR_FILENO; file++) {
        /* open() returns the lowest free descriptor, which is `file` */
        if (fcntl(file, F_GETFD) < 0)
            (void)open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
    (void)signal(SIGPIPE, SIG_IGN);
    (void)signal(SIGXFSZ, SIG_IGN);
}

bool standard_streams_is_terminal(void)
{
    return isatty(STDERR_FILENO);
}

/* Returns true if the reader of stdout has closed its end of the pipe. */
static bool is_abandoned(void)
{
    struct pollfd out = { .fd = STDOUT_FILENO, .events = POLLOUT };
    return poll(&out, 1, 0) == 1 && out.revents & POLLERR;
}

/* Ends the program with SIGPIPE and no message, like programs that do not ignore the signal. */
static void end_by_signal(void)
{
    sigset_t pipe_signal;
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    (void)signal(SIGPIPE, SIG_DFL);
    (void)pthread_sigmask(SIG_UNBLOCK, &pipe_signal, NULL);
    (void)raise(SIGPIPE);
}

enum status standard_streams_end(enum status status)
{
    const bool whole = !fflush(stdout);
    if (whole && !ferror(stdout))
        return status;
    if (is_abandoned())
        end_by_signal();
    log_error("stdout: cannot be written");
    return STATUS_WRITE;
}
