/* standard_streams.h: stdin, stdout and stderr of a program, whatever it was started with. */
#ifndef FIRN_APP_STANDARD_STREAMS_H
#define FIRN_APP_STANDARD_STREAMS_H

#include "src/base/status.h"

/* Before any file is opened: puts something in the place of each that is closed, so that no file
 * takes its number, and words for people end up in a picture. It can be used no more than what it
 * stands for. From then on, a pipe without a reader and a file beyond `ulimit -f` are write errors
 * instead of signals. */
void standard_streams_begin(void);

/* At the end: the status, or STATUS_WRITE (logged) if stdout did not take all that was printed.
 * Where its reader has gone (`firn list | head`) the program ends by SIGPIPE and says nothing. */
enum status standard_streams_end(enum status status);

#endif
