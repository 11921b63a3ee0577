/* standard_streams_win.c: binary standard streams, and failed writes to stdout. */
#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include "src/base/log.h"
#include "src/base/standard_streams.h"

/* Text mode would write "\r\n" for '\n' into images and reports. */
void standard_streams_begin(void)
{
    (void)_setmode(_fileno(stdin), _O_BINARY);
    (void)_setmode(_fileno(stdout), _O_BINARY);
}

bool standard_streams_is_terminal(void)
{
    return _isatty(_fileno(stderr));
}

enum status standard_streams_end(enum status status)
{
    if (!fflush(stdout) && !ferror(stdout))
        return status;
    log_error("stdout: cannot be written");
    return STATUS_WRITE;
}
