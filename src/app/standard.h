/* standard.h: stdin, stdout and stderr of a program, whatever it was started with. */
#ifndef FIRN_APP_STANDARD_H
#define FIRN_APP_STANDARD_H

#include "src/status.h"

/* Before any file is opened: puts something in the place of each that is closed, so that no file
 * takes its number, and words for people end up in a picture. It can be used no more than what it
 * stands for. */
void standard_begin(void);

/* At the end: the status, or STATUS_WRITE (logged) if stdout did not take all that was printed. */
enum status standard_end(enum status status);

#endif
