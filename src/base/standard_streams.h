/* standard_streams.h: replaces closed standard streams, and reports failed writes to stdout. */
#ifndef FIRN_BASE_STANDARD_STREAMS_H
#define FIRN_BASE_STANDARD_STREAMS_H

#include <stdbool.h>
#include "src/base/status.h"

/* Opens /dev/null for each closed standard stream. Otherwise an output file could get the stream's
 * descriptor and receive messages. Reading or writing a closed stream still fails. Ignores SIGPIPE
 * and SIGXFSZ, because closed pipes and file size limits then become write errors. Must be called
 * before any file is opened. */
void standard_streams_begin(void);

/* Returns true if stderr is a terminal. */
bool standard_streams_is_terminal(void);

/* Flushes stdout at the end of the program and returns `status`. If output was lost, logs this and
 * returns STATUS_WRITE. If the reader has gone (`firn list | head`), ends silently with SIGPIPE. */
enum status standard_streams_end(enum status status);

#endif
