/* standard_streams.c: stdin, stdout and stderr. */
#include "src/app/standard_streams.h"
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>
#include "src/base/log.h"

void standard_streams_begin(void)
{
    for (int file = STDIN_FILENO; file <= STDERR_FILENO; file++) {
        /* the lowest number that is free is the one that is looked at */
        if (fcntl(file, F_GETFD) < 0)
            (void)open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

enum status standard_streams_end(enum status status)
{
    if (!fflush(stdout) && !ferror(stdout))
        return status;
    log_error("stdout: cannot be written");
    return STATUS_WRITE;
}
