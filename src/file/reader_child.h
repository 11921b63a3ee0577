/* reader_child.h: the operating system's part of reader processes: starting the child and reading
 * its two pipes in the parent; limits and output in the child. reader_process.h describes both. */
#ifndef FIRN_FILE_READER_CHILD_H
#define FIRN_FILE_READER_CHILD_H

#include "src/file/reader_process.h"

enum reader_child_pipe {
    READER_CHILD_DATA,     /* stdout */
    READER_CHILD_MESSAGES, /* stderr */
    READER_CHILD_PIPE_COUNT,
};

/* ---- in the parent process ---- */

struct reader_child;

/* Starts params->program, whose default limits are resolved. Returns 0 or an errno. */
int reader_child_start(struct reader_child **started, const struct reader_params *params,
                       char *const *arguments);

/* Returns true until the end of a pipe was read, or reader_child_close() was called for it. */
bool reader_child_is_open(const struct reader_child *child, enum reader_child_pipe pipe);
void reader_child_close(struct reader_child *child, enum reader_child_pipe pipe);

/* Waits until an open pipe has data or has ended, at most `seconds`. Sets is_ready[] for both
 * pipes. Returns false on failure. */
bool reader_child_wait(const struct reader_child *child, double seconds,
                       bool is_ready[static READER_CHILD_PIPE_COUNT]);

/* Reads at most `size` bytes from a pipe that is ready. At its end, closes it and returns 0. */
size_t reader_child_read(struct reader_child *child, enum reader_child_pipe pipe, void *bytes,
                         size_t size);

/* Returns the child's CPU time plus the time for which its main thread waited for a core, or the
 * last known sum if it has ended. Some systems do not tell the waiting time, which then counts as
 * 0. */
double reader_child_busy_seconds(struct reader_child *child);

/* The end of a child. All members are 0 if that is unknown. */
struct reader_child_end {
    int code;            /* exit code */
    int signal;          /* that ended it, on POSIX systems */
    bool is_out_of_time; /* by its limit of CPU time */
};

/* Kills the child if it still runs, and frees `child`. If the child is already exiting, its exit
 * code is kept. */
struct reader_child_end reader_child_finish(struct reader_child *child);

/* Returns true if this process was started with a smaller limit of CPU time, in seconds, or else of
 * address space, in bytes. */
bool reader_child_inherits_limit(bool is_time, uint64_t limit);

/* ---- in the child process ---- */

/* Applies the limits. Returns false if that fails or if the parent has ended. */
MUST_USE bool reader_child_limit(uint32_t seconds, uint32_t memory_gib);

/* Writes to the parent. Returns false on failure. */
bool reader_child_write(const void *bytes, size_t size);

#endif
