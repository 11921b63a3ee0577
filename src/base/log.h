/*
 * log.h: logs messages for the user on stderr, one line each. Any thread may log. Each line is
 * written with one call, because lines of several threads must not mix.
 */
#ifndef FIRN_BASE_LOG_H
#define FIRN_BASE_LOG_H

#include "src/base/status.h"

/* Replaces control characters, including bidirectional ones, by '?' in place. Use it for texts from
 * files and for file names. */
void log_sanitize(char *text);

/* Writes "firn: ", the formatted and sanitised message, and a newline. */
void log_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Writes "firn: warning: ", the formatted and sanitised message, and a newline. */
void log_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Writes an informative message: "firn: note: ", the formatted and sanitised text, a newline. */
void log_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Logs "WHAT: out of memory" and returns STATUS_TRY_AGAIN. If `what` is NULL, logs "out of memory".
 * The definition is inline, because static analysers must see that the result is not STATUS_OK. */
static inline enum status log_out_of_memory(const char *what)
{
    if (what)
        log_error("%s: out of memory", what);
    else
        log_error("out of memory");
    return STATUS_TRY_AGAIN;
}

#endif
