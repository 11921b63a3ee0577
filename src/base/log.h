/*
 * log.h: words for people, one line each, to stderr.
 *
 * Thread-safety: a line is written with one call and never torn.
 */
#ifndef FIRN_BASE_LOG_H
#define FIRN_BASE_LOG_H

#include "src/base/status.h"

/* Writes "firn: " and the formatted message and a newline. Control characters of the message
 * (a file name may hold any) are written as '?'. */
void log_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same, beginning "firn: warning: ". */
void log_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Logs "WHAT: out of memory", or without a subject (NULL) "out of memory". Inline, so that readers
 * and analyzers see that it never returns STATUS_OK. */
static inline enum status log_out_of_memory(const char *what)
{
    if (what)
        log_error("%s: out of memory", what);
    else
        log_error("out of memory");
    return STATUS_TRY_AGAIN;
}

#endif
