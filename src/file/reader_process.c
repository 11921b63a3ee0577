/* reader_process.c: starts a reader process, receives its data, and logs why it failed. */
#include "src/file/reader_process.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/file/reader_child.h"

enum {
    LOG_SIZE = 32768, /* maximum stderr stored, hundreds of lines */
    NO_PROGRAM = 127, /* dynamic loader's exit code: missing library */
};

/* Number of received bytes that extends the time limit as much as a second for which the child is
 * busy. */
#define PATIENCE_SIZE 0x1p26

struct reader {
    struct reader_params params;
    const char *path;
    struct reader_child *child; /* NULL once it has ended */
    double deadline;            /* monotonic clock, seconds; extended on progress */
    double busy_seconds;        /* reader_child_busy_seconds() at `deadline`'s update */
    double waited;              /* seconds spent waiting for data */
    double received;            /* bytes */
    bool is_idle;               /* deadline missed without progress */
    bool is_slow;               /* the total waiting time exceeded its limit */
    char log_text[LOG_SIZE];    /* child's stderr, terminated by '\0' */
    size_t log_size;
    struct reader_child_end end;
};

static struct reader_params complete(struct reader_params params)
{
    params.seconds = params.seconds ? params.seconds : READER_SECONDS;
    params.idle_seconds = params.idle_seconds ? params.idle_seconds : READER_IDLE_SECONDS;
    params.memory_gib = params.memory_gib ? params.memory_gib : READER_MEMORY_GIB;
    return params;
}

/* Starts the child with its arguments. Returns 0 or an errno. */
static int start(struct reader *reader, enum reader_kind kind)
{
    char numbers[4][16], name[] = "firn", option_name[] = READER_OPTION;
    const uint32_t values[] = { kind + 1u, reader->params.seconds, reader->params.memory_gib,
                                reader->params.no_sandbox };
    char *file = strdup(reader->path);
    char *details = strdup(reader->params.details ? reader->params.details : "");
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++)
        snprintf(numbers[i], sizeof(numbers[i]), "%u", values[i]);
    char *const argv[] = { name,       option_name, file,    numbers[0], numbers[1],
                           numbers[2], numbers[3],  details, NULL };
    const int failed =
        file && details ? reader_child_start(&reader->child, &reader->params, argv) : ENOMEM;
    free(file);
    free(details);
    return failed;
}

/* Logs why the child could not be started. A lack of memory, processes or descriptors may be
 * temporary. */
static enum status report_no_start(const struct reader *reader, int failed)
{
    const bool is_temporary = failed == EAGAIN || failed == ENOMEM || failed == EMFILE ||
                              failed == ENFILE || failed == EINTR;
    const bool is_itself = !strcmp(reader->params.program, "/proc/self/exe");
    const char *advice = failed == ENOENT && is_itself ? ": mount /proc"
                         : failed == ENOENT ? ": set FIRN_READER to the program firn-reader"
                         : is_temporary     ? ""
                                            : ": the system must allow to start processes";
    log_error("%s: cannot start the reader process %s: %s%s", reader->path, reader->params.program,
              strerror(failed), advice);
    return is_temporary ? STATUS_TRY_AGAIN : STATUS_NO_DEVICE;
}

enum status reader_start(struct reader **started, const struct reader_params *params,
                         enum reader_kind kind, const char *path)
{
    struct reader *reader = calloc(1, sizeof(*reader));
    *started = NULL;
    if (!reader)
        return log_out_of_memory(path);
    reader->params = complete(*params);
    reader->path = path;
    reader->deadline = clock_seconds() + reader->params.idle_seconds;
    const int failed = start(reader, kind);
    if (!failed) {
        *started = reader;
        return STATUS_OK;
    }
    const enum status status = report_no_start(reader, failed);
    free(reader);
    return status;
}

static void receive_stderr(struct reader *reader)
{
    char bytes[512];
    const size_t count =
        reader_child_read(reader->child, READER_CHILD_MESSAGES, bytes, sizeof(bytes));
    for (size_t i = 0; i < count && reader->log_size + 1 < LOG_SIZE; i++) {
        if (bytes[i] != '\0')
            reader->log_text[reader->log_size++] = bytes[i];
    }
}

/* Returns true if the child missed its deadline. A child that ran or waited for a core gets a new
 * deadline. */
static bool is_idle(struct reader *reader)
{
    if (clock_seconds() < reader->deadline)
        return false;
    const double busy_seconds = reader_child_busy_seconds(reader->child);
    if (busy_seconds <= reader->busy_seconds)
        return true;
    reader->busy_seconds = busy_seconds;
    reader->deadline = clock_seconds() + reader->params.idle_seconds;
    return false;
}

/* Returns true if the total waiting time is too long for the time that the child was busy and the
 * data that it sent. This ends children that send single bytes, which are never idle. */
static bool is_slow(const struct reader *reader)
{
    const double idle_seconds = reader->params.idle_seconds;
    if (reader->waited <= idle_seconds)
        return false;
    const double busy_seconds = reader_child_busy_seconds(reader->child);
    return reader->waited > idle_seconds * (1.0 + busy_seconds + reader->received / PATIENCE_SIZE);
}

/* Waits until a pipe has data or reaches its end. Returns false if the child makes no progress in
 * time, or if both pipes are at their end. */
static bool wait_for_data(struct reader *reader)
{
    while (reader_child_is_open(reader->child, READER_CHILD_DATA) ||
           reader_child_is_open(reader->child, READER_CHILD_MESSAGES)) {
        bool is_ready[READER_CHILD_PIPE_COUNT];
        reader->is_idle = reader->is_idle || is_idle(reader);
        reader->is_slow = reader->is_slow || is_slow(reader);
        if (reader->is_idle || reader->is_slow)
            return false;
        const double begin = clock_seconds();
        const bool ok = reader_child_wait(reader->child, reader->deadline - begin, is_ready);
        reader->waited += clock_seconds() - begin;
        if (!ok)
            return false;
        if (is_ready[READER_CHILD_MESSAGES])
            receive_stderr(reader);
        if (is_ready[READER_CHILD_DATA])
            return true;
    }
    return false;
}

static bool read_data(void *user, void *bytes, size_t size)
{
    struct reader *reader = user;
    char *next = bytes;
    reader->deadline = clock_seconds() + reader->params.idle_seconds;
    while (size > 0 && reader_child_is_open(reader->child, READER_CHILD_DATA) &&
           wait_for_data(reader)) {
        const size_t count = reader_child_read(reader->child, READER_CHILD_DATA, next, size);
        next += count;
        size -= count;
        reader->received += (double)count;
        if (count)
            reader->deadline = clock_seconds() + reader->params.idle_seconds;
    }
    return size == 0;
}

/* Reads what is left of the child's stderr, without waiting for more. */
static void drain_stderr(struct reader *reader)
{
    bool is_ready[READER_CHILD_PIPE_COUNT];
    while (reader_child_is_open(reader->child, READER_CHILD_MESSAGES) &&
           clock_seconds() < reader->deadline && reader_child_wait(reader->child, 0, is_ready) &&
           is_ready[READER_CHILD_MESSAGES])
        receive_stderr(reader);
}

static void finish(struct reader *reader, enum pipe_fault fault)
{
    reader_child_close(reader->child, READER_CHILD_DATA);
    if (fault == PIPE_OK)
        drain_stderr(reader);
    else if (fault == PIPE_SHORT)
        wait_for_data(reader);
    reader->end = reader_child_finish(reader->child);
    reader->child = NULL;
}

/* Logs the child's stderr as this process's messages, up to the first error. `no_warnings` leaves
 * out warnings and notes. Returns true if there was an error. */
static bool repeat_log(const struct reader *reader)
{
    static const char prefix[] = "firn: ", warning[] = "warning: ", note[] = "note: ";
    const size_t prefix_size = sizeof(prefix) - 1, warning_size = sizeof(warning) - 1;
    const size_t note_size = sizeof(note) - 1;
    const bool is_quiet = reader->params.no_warnings;
    bool is_error = false;
    for (const char *line = reader->log_text; *line && !is_error;) {
        const size_t length = strcspn(line, "\r\n");
        if (strncmp(line, prefix, prefix_size) == 0) {
            const char *text = line + prefix_size;
            const int size = (int)(length - prefix_size);
            const bool is_warning = strncmp(text, warning, warning_size) == 0;
            const bool is_note = strncmp(text, note, note_size) == 0;
            is_error = !is_warning && !is_note;
            if (is_error)
                log_error("%.*s", size, text);
            else if (is_warning && !is_quiet)
                log_warning("%.*s", size - (int)warning_size, text + warning_size);
            else if (is_note && !is_quiet)
                log_note("%.*s", size - (int)note_size, text + note_size);
        }
        line += length;
        line += strspn(line, "\r\n");
    }
    return is_error;
}

/* Logs that the child exceeded its limit of CPU time or memory, or that of the program itself. */
static enum status report_limit(const struct reader *reader, bool is_time)
{
    const uint32_t value = is_time ? reader->params.seconds : reader->params.memory_gib;
    const uint64_t limit = is_time ? value : (uint64_t)value << 30;
    if (reader_child_inherits_limit(is_time, limit)) {
        log_error("%s: reading the file exceeded the %s limit that the program was started with: "
                  "raise ulimit %s",
                  reader->path, is_time ? "time" : "memory", is_time ? "-t" : "-v");
        return STATUS_TRY_AGAIN;
    }
    log_error("%s: reading the file exceeded the limit of %u %s (raise it with --load-%s)",
              reader->path, value, is_time ? "s of CPU time" : "GiB of memory",
              is_time ? "seconds" : "memory");
    return STATUS_DATA;
}

/* Logs why the child sent too little data: it reached a limit, crashed or reported an error. */
static enum status report_failure(const struct reader *reader)
{
    const int signal = reader->end.signal, code = reader->end.code;
    if (reader->is_idle) {
        log_error("%s: no data arrived for %u s: expected a regular file, not a pipe that waits "
                  "for a writer",
                  reader->path, reader->params.idle_seconds);
        return STATUS_DATA;
    }
    if (reader->is_slow) {
        log_error("%s: the data arrives too slowly (%.0f bytes in %.0f s): expected a regular file "
                  "on a disk that answers",
                  reader->path, reader->received, reader->waited);
        return STATUS_DATA;
    }
    if (reader->end.is_out_of_time)
        return report_limit(reader, true);
    if (code == NO_PROGRAM || code == STATUS_USAGE) {
        log_error("%s: the reader process cannot start: raise the limits that the program was "
                  "started with (ulimit -v, -n)",
                  reader->path);
        return STATUS_TRY_AGAIN;
    }
    if (code == STATUS_TRY_AGAIN || strstr(reader->log_text, "bad_alloc"))
        return report_limit(reader, false);
    if ((code == STATUS_DATA || code == STATUS_NO_INPUT || code == STATUS_NO_DEVICE) &&
        repeat_log(reader))
        return (enum status)code;
    log_error("%s: the reader crashed (%s %d): the file is damaged or unsupported; export it again",
              reader->path, signal ? "signal" : "exit code", signal ? signal : code);
    return STATUS_DATA;
}

static enum status report_result(const struct reader *reader, enum pipe_fault fault)
{
    if (fault == PIPE_SHORT)
        return report_failure(reader);
    if (fault == PIPE_MEMORY)
        return log_out_of_memory(reader->path);
    if (fault == PIPE_LARGE) {
        log_error("%s: the image needs more than a quarter of the memory limit of %u GiB (raise it "
                  "with --load-memory)",
                  reader->path, reader->params.memory_gib);
        return STATUS_DATA;
    }
    if (fault != PIPE_OK) {
        log_error("%s: the file's data is invalid: %s; export the file again", reader->path,
                  pipe_fault_text(fault));
        return STATUS_DATA;
    }
    repeat_log(reader);
    return STATUS_OK;
}

struct pipe_source reader_source(struct reader *reader)
{
    return (struct pipe_source){
        .read = read_data,
        .user = reader,
        .size_max = (uint64_t)reader->params.memory_gib << 30,
    };
}

enum status reader_end(struct reader *reader, enum pipe_fault fault)
{
    finish(reader, fault);
    const enum status status = report_result(reader, fault);
    free(reader);
    return status;
}

void reader_drop(struct reader *reader)
{
    if (!reader)
        return;
    finish(reader, PIPE_END);
    free(reader);
}
