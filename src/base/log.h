/*
 * log.h: logs messages for the user on stderr, or to the calling thread's sink, one line each. Any
 * thread may log. Each line is written with one call, because lines of several threads must not
 * mix.
 */
#ifndef FIRN_BASE_LOG_H
#define FIRN_BASE_LOG_H

#include "src/base/status.h"

enum log_level {
    LOG_ERROR,
    LOG_WARNING,
    LOG_NOTE,
};

/* Receiver of messages instead of stderr. */
struct log_sink {
    /* receives a sanitised message without newline; may be called by several threads at once */
    void (*write)(struct log_sink *sink, enum log_level level, const char *text);
};

/* Sets the sink of the calling thread and returns the earlier one; NULL stands for stderr. A thread
 * that works for another one must set that thread's sink. */
struct log_sink *log_set_sink(struct log_sink *sink);

/* Returns the sink of the calling thread, or NULL. */
struct log_sink *log_get_sink(void);

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
