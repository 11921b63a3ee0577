/*
 * log.h: messages for people, one line each, to stderr.
 *
 * Thread-safety: any thread may log; a line is written with one call, so lines do not mix.
 */
#ifndef FIRN_BASE_LOG_H
#define FIRN_BASE_LOG_H

#include "src/base/status.h"

/* Replaces each control character of a text for a terminal, and each that changes the direction of
 * text, by '?'; names of files, and those in them, may hold any. */
void log_clean(char *text);

/* Writes "firn: " and the formatted message, cleaned, and a newline. */
void log_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Writes "firn: warning: " and the formatted message and a newline, as log_error() does. */
void log_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Writes "firn: note: " and the formatted message and a newline: what nobody has to mend. */
void log_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Logs "WHAT: out of memory", or "out of memory" if `what` is NULL, and returns STATUS_TRY_AGAIN.
 * It is inline, so that analyzers see that it never returns STATUS_OK. */
static inline enum status log_out_of_memory(const char *what)
{
    if (what)
        log_error("%s: out of memory", what);
    else
        log_error("out of memory");
    return STATUS_TRY_AGAIN;
}

#endif
