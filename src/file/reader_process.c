/* reader_process.c: starts a reader process, receives its data, and logs why it failed. */
#define _GNU_SOURCE /* environ, pipe2, posix_spawn_file_actions_addclosefrom_np */
#include "src/file/reader_process.h"
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include "src/base/clock.h"
#include "src/base/log.h"

enum {
    BUFFER_SIZE = 1 << 20, /* requested pipe capacity, bytes */
    LOG_SIZE = 32768,      /* maximum stderr stored, hundreds of lines */
    NO_PROGRAM = 127,      /* dynamic loader's exit code: missing library */
};

/* Number of received bytes that extends the time limit as much as a second of the child's CPU
 * time. */
#define PATIENCE_SIZE 0x1p26

struct reader {
    struct reader_params params;
    const char *path;
    pid_t process;
    int data, messages;      /* child's stdout and stderr; or -1 */
    double deadline;         /* monotonic clock, seconds; extended on progress */
    double cpu_seconds;      /* child's CPU time at `deadline`'s update */
    double waited;           /* seconds spent waiting for data */
    double received;         /* bytes */
    bool is_idle;            /* deadline missed without progress */
    bool is_slow;            /* the total waiting time exceeded its limit */
    char log_text[LOG_SIZE]; /* child's stderr, terminated by '\0' */
    size_t log_size;
    int exit_status; /* from waitpid(), if has_ended */
    bool has_ended;
};

static struct reader_params complete(struct reader_params params)
{
    params.seconds = params.seconds ? params.seconds : READER_SECONDS;
    params.idle_seconds = params.idle_seconds ? params.idle_seconds : READER_IDLE_SECONDS;
    params.memory_gib = params.memory_gib ? params.memory_gib : READER_MEMORY_GIB;
    return params;
}

static pthread_mutex_t reader_count_lock = PTHREAD_MUTEX_INITIALIZER;
static uint32_t reader_count; /* number of readers that exist */
static bool was_dumpable;

/* Adds `change` to the number of readers. While readers exist, other processes of the user cannot
 * open this process's memory, and a crash writes no core file. */
static void count_readers(int change)
{
    pthread_mutex_lock(&reader_count_lock);
    if (reader_count == 0) {
        was_dumpable = prctl(PR_GET_DUMPABLE) == 1;
        prctl(PR_SET_DUMPABLE, 0);
    }
    reader_count += (uint32_t)change;
    if (reader_count == 0 && was_dumpable)
        prctl(PR_SET_DUMPABLE, 1);
    pthread_mutex_unlock(&reader_count_lock);
}

static void close_end(int *end)
{
    if (*end >= 0)
        close(*end);
    *end = -1;
}

/* Opens a pipe whose descriptors are above 2, because the child replaces descriptors 0 to 2. Other
 * child processes do not inherit the pipe. */
static bool open_pipe(int ends[2])
{
    int low[2];
    if (pipe2(low, O_CLOEXEC) != 0)
        return false;
    for (int i = 0; i < 2; i++) {
        ends[i] = fcntl(low[i], F_DUPFD_CLOEXEC, 3);
        close(low[i]);
    }
    return ends[0] >= 0 && ends[1] >= 0;
}

/* Environment variables that the child inherits: library paths for the dynamic loader, and options
 * of the sanitizers. */
static const char *const passed_variables[] = {
    "LD_LIBRARY_PATH", "LD_PRELOAD",
#ifdef READER_MAPS_SHADOWS
    "ASAN_OPTIONS",    "TSAN_OPTIONS", "UBSAN_OPTIONS",
#endif
};

enum {
    PASSED_VARIABLE_COUNT = sizeof(passed_variables) / sizeof(passed_variables[0])
};

/* Fills a NULL-terminated list with the environment variables to pass to the child. */
static void select_environment(char *list[static PASSED_VARIABLE_COUNT + 1])
{
    size_t count = 0;
    for (char **variable = environ; variable && *variable && count < PASSED_VARIABLE_COUNT;
         variable++) {
        for (size_t i = 0; i < PASSED_VARIABLE_COUNT; i++) {
            const size_t size = strlen(passed_variables[i]);
            if (strncmp(*variable, passed_variables[i], size) == 0 && (*variable)[size] == '=')
                list[count++] = *variable;
        }
    }
    list[count] = NULL;
}

/* Spawns the child in its own process group, which Ctrl-C does not end. Returns 0 or an errno. */
static int spawn(pid_t *process, const char *program, char *const *arguments, int out, int err)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t no_signals, default_signals;
    char *variables[PASSED_VARIABLE_COUNT + 1];
    select_environment(variables);
    sigemptyset(&no_signals);
    sigemptyset(&default_signals);
    sigaddset(&default_signals, SIGPIPE);
    sigaddset(&default_signals, SIGXFSZ);
    sigaddset(&default_signals, SIGXCPU);
    if (posix_spawn_file_actions_init(&files) != 0)
        return ENOMEM;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&files);
        return ENOMEM;
    }
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                              POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setsigmask(&attributes, &no_signals);
    posix_spawnattr_setsigdefault(&attributes, &default_signals);
    int failed = posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!failed)
        failed = posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
    if (!failed)
        failed = posix_spawn_file_actions_adddup2(&files, err, STDERR_FILENO);
    if (!failed)
        failed = posix_spawn_file_actions_addclosefrom_np(&files, 3);
    if (!failed)
        failed = posix_spawn(process, program, &files, &attributes, arguments, variables);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return failed;
}

/* Opens the pipes and spawns the child with its arguments. Returns 0 or an errno. */
static int start(struct reader *reader, enum reader_kind kind)
{
    int data[2] = { -1, -1 }, messages[2] = { -1, -1 };
    char numbers[4][16], name[] = "firn", option_name[] = READER_OPTION;
    const uint32_t values[] = { kind + 1u, reader->params.seconds, reader->params.memory_gib,
                                reader->params.no_sandbox };
    char *file = strdup(reader->path);
    char *details = strdup(reader->params.details ? reader->params.details : "");
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++)
        snprintf(numbers[i], sizeof(numbers[i]), "%u", values[i]);
    char *const argv[] = { name,       option_name, file,    numbers[0], numbers[1],
                           numbers[2], numbers[3],  details, NULL };
    int failed = file && details ? 0 : ENOMEM;
    if (!failed && (!open_pipe(data) || !open_pipe(messages)))
        failed = errno;
    if (!failed) {
        fcntl(data[0], F_SETPIPE_SZ, BUFFER_SIZE); /* optional: larger pipes are faster */
        failed = spawn(&reader->process, reader->params.program, argv, data[1], messages[1]);
    }
    free(file);
    free(details);
    close_end(&data[1]);
    close_end(&messages[1]);
    reader->data = data[0];
    reader->messages = messages[0];
    return failed;
}

/* Logs why the child could not be started. A lack of memory, processes or descriptors may be
 * temporary. */
static enum status report_no_start(const struct reader *reader, int failed)
{
    const bool is_temporary = failed == EAGAIN || failed == ENOMEM || failed == EMFILE ||
                              failed == ENFILE || failed == EINTR;
    const char *advice = failed == ENOENT ? ": mount /proc, or install firn again"
                         : is_temporary   ? ""
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
    if (!params->stays_dumpable)
        count_readers(1);
    const int failed = start(reader, kind);
    if (!failed) {
        *started = reader;
        return STATUS_OK;
    }
    const enum status status = report_no_start(reader, failed);
    if (!params->stays_dumpable)
        count_readers(-1);
    close_end(&reader->data);
    close_end(&reader->messages);
    free(reader);
    return status;
}

static void receive_stderr(struct reader *reader)
{
    char bytes[512];
    const ssize_t count = read(reader->messages, bytes, sizeof(bytes));
    if (count < 0 && errno == EINTR)
        return;
    if (count <= 0) {
        close_end(&reader->messages);
        return;
    }
    for (ssize_t i = 0; i < count && reader->log_size + 1 < LOG_SIZE; i++) {
        if (bytes[i] != '\0')
            reader->log_text[reader->log_size++] = bytes[i];
    }
}

/* Returns the child's CPU time, or the last known one if it has ended. */
static double child_cpu_seconds(const struct reader *reader)
{
    clockid_t clock;
    struct timespec used;
    if (clock_getcpuclockid(reader->process, &clock) != 0 || clock_gettime(clock, &used) != 0)
        return reader->cpu_seconds;
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

/* Returns true if the child missed its deadline. A child that used CPU time gets a new deadline. */
static bool is_idle(struct reader *reader)
{
    if (clock_seconds() < reader->deadline)
        return false;
    const double cpu_seconds = child_cpu_seconds(reader);
    if (cpu_seconds <= reader->cpu_seconds)
        return true;
    reader->cpu_seconds = cpu_seconds;
    reader->deadline = clock_seconds() + reader->params.idle_seconds;
    return false;
}

/* Returns true if the total waiting time is too long for the CPU time that the child used and the
 * data that it sent. This ends children that send single bytes, which are never idle. */
static bool is_slow(const struct reader *reader)
{
    const double idle_seconds = reader->params.idle_seconds;
    return reader->waited > idle_seconds &&
           reader->waited >
               idle_seconds * (1.0 + child_cpu_seconds(reader) + reader->received / PATIENCE_SIZE);
}

/* Waits for data or end of file. Returns false if the child makes no progress in time. */
static bool wait_for_data(struct reader *reader)
{
    while (reader->data >= 0 || reader->messages >= 0) {
        struct pollfd ends[] = {
            { .fd = reader->data, .events = POLLIN },
            { .fd = reader->messages, .events = POLLIN },
        };
        reader->is_idle = reader->is_idle || is_idle(reader);
        reader->is_slow = reader->is_slow || is_slow(reader);
        if (reader->is_idle || reader->is_slow)
            return false;
        const double begin = clock_seconds(), remaining = reader->deadline - begin;
        const int count = poll(ends, 2,
                               remaining > 1000 ? 1000000
                               : remaining > 0  ? (int)(remaining * 1e3) + 1
                                                : 0);
        reader->waited += clock_seconds() - begin;
        if (count < 0 && errno != EINTR)
            return false;
        if (count > 0 && ends[1].revents)
            receive_stderr(reader);
        if (count > 0 && ends[0].revents)
            return true;
    }
    return false;
}

static bool read_data(void *user, void *bytes, size_t size)
{
    struct reader *reader = user;
    char *next = bytes;
    reader->deadline = clock_seconds() + reader->params.idle_seconds;
    while (size > 0 && reader->data >= 0 && wait_for_data(reader)) {
        const ssize_t count = read(reader->data, next, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0) {
            close_end(&reader->data);
            break;
        }
        next += count;
        size -= (size_t)count;
        reader->received += (double)count;
        reader->deadline = clock_seconds() + reader->params.idle_seconds;
    }
    return size == 0;
}

/* Reads what is left of the child's stderr, without waiting for more. */
static void drain_stderr(struct reader *reader)
{
    struct pollfd messages = { .fd = reader->messages, .events = POLLIN };
    while (reader->messages >= 0 && clock_seconds() < reader->deadline && poll(&messages, 1, 0) > 0)
        receive_stderr(reader);
}

static void finish(struct reader *reader, enum pipe_fault fault)
{
    close_end(&reader->data);
    if (fault == PIPE_OK)
        drain_stderr(reader);
    else if (fault == PIPE_SHORT)
        wait_for_data(reader);
    close_end(&reader->messages);
    /* Kills the child if it still runs. If it is already exiting, its exit status is kept. */
    kill(-reader->process, SIGKILL);
    pid_t found;
    do {
        found = waitpid(reader->process, &reader->exit_status, 0);
    } while (found < 0 && errno == EINTR);
    reader->has_ended = found == reader->process;
    if (!reader->params.stays_dumpable)
        count_readers(-1);
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
        const size_t length = strcspn(line, "\n");
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
        line += length + (line[length] == '\n');
    }
    return is_error;
}

/* Logs that the child exceeded its limit of CPU time or memory, or that of the program itself. */
static enum status report_limit(const struct reader *reader, bool is_time)
{
    const uint32_t value = is_time ? reader->params.seconds : reader->params.memory_gib;
    const uint64_t limit = is_time ? value : (uint64_t)value << 30;
    struct rlimit inherited;
    if (getrlimit(is_time ? RLIMIT_CPU : RLIMIT_AS, &inherited) == 0 &&
        inherited.rlim_cur < limit) {
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
    const int status = reader->has_ended ? reader->exit_status : 0;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
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
    if (signal == SIGXCPU)
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
