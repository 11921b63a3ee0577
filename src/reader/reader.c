/* reader.c: starts the child that reads a file, receives its data, and logs why it failed. */
#define _GNU_SOURCE /* environ, pipe2, posix_spawn_file_actions_addclosefrom_np */
#include "src/reader/reader.h"
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
    BUFFER_SIZE = 1 << 20, /* bytes, where the system allows it */
    SAID_SIZE = 32768,     /* a line for each of hundreds of extensions */
    NO_PROGRAM = 127,      /* exit code of the dynamic loader when it cannot load a library */
};

struct reader {
    struct reader_params params;
    const char *path;
    pid_t process;
    int data, words; /* descriptors of the pipes from its stdout and stderr; -1: closed */
    double deadline; /* seconds of the monotonic clock; moves on while the child makes progress */
    double cpu_seconds;   /* that the child had used when the deadline was set */
    bool is_idle;         /* made no progress until the deadline */
    char said[SAID_SIZE]; /* its stderr so far; ends at '\0' */
    size_t said_size;
    int ended; /* status of waitpid(); valid if has_ended */
    bool has_ended;
};

static struct reader_params complete(struct reader_params params)
{
    params.seconds = params.seconds ? params.seconds : READER_SECONDS;
    params.idle_seconds = params.idle_seconds ? params.idle_seconds : READER_IDLE_SECONDS;
    params.memory_gib = params.memory_gib ? params.memory_gib : READER_MEMORY_GIB;
    return params;
}

/* ---- the parent's memory ---- */

static pthread_mutex_t living_lock = PTHREAD_MUTEX_INITIALIZER;
static uint32_t living; /* readers */
static bool was_dumpable;

/* While a reader lives, no process of the same user may open the parent's memory, and a crash of
 * the parent dumps no core. */
static void count_living(int change)
{
    pthread_mutex_lock(&living_lock);
    if (living == 0) {
        was_dumpable = prctl(PR_GET_DUMPABLE) == 1;
        prctl(PR_SET_DUMPABLE, 0);
    }
    living += (uint32_t)change;
    if (living == 0 && was_dumpable)
        prctl(PR_SET_DUMPABLE, 1);
    pthread_mutex_unlock(&living_lock);
}

/* ---- start ---- */

static void close_end(int *end)
{
    if (*end >= 0)
        close(*end);
    *end = -1;
}

/* Opens a pipe with descriptors above 2, so that the child's descriptors 0 to 2 can be set in any
 * order; other programs do not inherit them. */
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

/* What the dynamic loader needs, so that the child gets the libraries of its parent, and what the
 * sanitizers read; nothing else of the environment is passed on. */
static const char *const passed_on[] = {
    "LD_LIBRARY_PATH", "LD_PRELOAD",
#ifdef READER_MAPS_SHADOWS
    "ASAN_OPTIONS",    "TSAN_OPTIONS", "UBSAN_OPTIONS",
#endif
};

enum {
    PASSED_ON_COUNT = sizeof(passed_on) / sizeof(passed_on[0])
};

/* Fills a list that ends with NULL. */
static void select_environment(char *list[static PASSED_ON_COUNT + 1])
{
    size_t count = 0;
    for (char **variable = environ; variable && *variable && count < PASSED_ON_COUNT; variable++) {
        for (size_t i = 0; i < PASSED_ON_COUNT; i++) {
            const size_t size = strlen(passed_on[i]);
            if (strncmp(*variable, passed_on[i], size) == 0 && (*variable)[size] == '=')
                list[count++] = *variable;
        }
    }
    list[count] = NULL;
}

/* Returns 0 or an errno. The child has a process group of its own, so that Ctrl-C reaches only the
 * parent. */
static int spawn(pid_t *process, const char *program, char *const *words, int out, int err)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t none, usual;
    char *variables[PASSED_ON_COUNT + 1];
    select_environment(variables);
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    sigaddset(&usual, SIGXFSZ);
    sigaddset(&usual, SIGXCPU);
    if (posix_spawn_file_actions_init(&files) != 0)
        return ENOMEM;
    if (posix_spawnattr_init(&how) != 0) {
        posix_spawn_file_actions_destroy(&files);
        return ENOMEM;
    }
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                       POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawnattr_setsigdefault(&how, &usual);
    int failed = posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!failed)
        failed = posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
    if (!failed)
        failed = posix_spawn_file_actions_adddup2(&files, err, STDERR_FILENO);
    if (!failed)
        failed = posix_spawn_file_actions_addclosefrom_np(&files, 3);
    if (!failed)
        failed = posix_spawn(process, program, &files, &how, words, variables);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return failed;
}

/* Returns 0 or an errno. */
static int start(struct reader *reader, enum reader_kind kind)
{
    int data[2] = { -1, -1 }, words[2] = { -1, -1 };
    char numbers[4][16], name[] = "firn", word[] = READER_WORD;
    const uint32_t values[] = { kind + 1u, reader->params.seconds, reader->params.memory_gib,
                                reader->params.no_sandbox };
    char *file = strdup(reader->path);
    char *details = strdup(reader->params.details ? reader->params.details : "");
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++)
        snprintf(numbers[i], sizeof(numbers[i]), "%u", values[i]);
    char *const argv[] = { name,       word,       file,    numbers[0], numbers[1],
                           numbers[2], numbers[3], details, NULL };
    int failed = file && details ? 0 : ENOMEM;
    if (!failed && (!open_pipe(data) || !open_pipe(words)))
        failed = errno;
    if (!failed) {
        fcntl(data[0], F_SETPIPE_SZ, BUFFER_SIZE); /* a smaller pipe is only slower */
        failed = spawn(&reader->process, reader->params.program, argv, data[1], words[1]);
    }
    free(file);
    free(details);
    close_end(&data[1]);
    close_end(&words[1]);
    reader->data = data[0];
    reader->words = words[0];
    return failed;
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
    count_living(1);
    const int failed = start(reader, kind);
    if (!failed) {
        *started = reader;
        return STATUS_OK;
    }
    log_error("%s: cannot start the reader process %s: %s", path, params->program,
              strerror(failed));
    count_living(-1);
    close_end(&reader->data);
    close_end(&reader->words);
    free(reader);
    return STATUS_TRY_AGAIN;
}

/* ---- receive ---- */

static void take_words(struct reader *reader)
{
    char bytes[512];
    const ssize_t count = read(reader->words, bytes, sizeof(bytes));
    if (count < 0 && errno == EINTR)
        return;
    if (count <= 0) {
        close_end(&reader->words);
        return;
    }
    for (ssize_t i = 0; i < count && reader->said_size + 1 < SAID_SIZE; i++) {
        if (bytes[i] != '\0')
            reader->said[reader->said_size++] = bytes[i];
    }
}

/* Returns whether the child has made no progress until its deadline. A child that has computed in
 * the meantime gets a later deadline. */
static bool is_idle(struct reader *reader)
{
    clockid_t clock;
    struct timespec used;
    if (clock_seconds() < reader->deadline)
        return false;
    if (clock_getcpuclockid(reader->process, &clock) != 0 || clock_gettime(clock, &used) != 0)
        return true;
    const double cpu_seconds = (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
    if (cpu_seconds <= reader->cpu_seconds)
        return true;
    reader->cpu_seconds = cpu_seconds;
    reader->deadline = clock_seconds() + reader->params.idle_seconds;
    return false;
}

/* Waits until data or their end can be read; returns false if the child makes no progress. */
static bool await(struct reader *reader)
{
    while (reader->data >= 0 || reader->words >= 0) {
        struct pollfd ends[] = {
            { .fd = reader->data, .events = POLLIN },
            { .fd = reader->words, .events = POLLIN },
        };
        reader->is_idle = reader->is_idle || is_idle(reader);
        if (reader->is_idle)
            return false;
        const double left = reader->deadline - clock_seconds();
        const int count = poll(ends, 2,
                               left > 1000 ? 1000000
                               : left > 0  ? (int)(left * 1e3) + 1
                                           : 0);
        if (count < 0 && errno != EINTR)
            return false;
        if (count > 0 && ends[1].revents)
            take_words(reader);
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
    while (size > 0 && reader->data >= 0 && await(reader)) {
        const ssize_t count = read(reader->data, next, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0) {
            close_end(&reader->data);
            break;
        }
        next += count;
        size -= (size_t)count;
        reader->deadline = clock_seconds() + reader->params.idle_seconds;
    }
    return size == 0;
}

/* Reads the rest of stderr; what the child wrote before its last data is already in the pipe. */
static void hear_rest(struct reader *reader)
{
    struct pollfd words = { .fd = reader->words, .events = POLLIN };
    while (reader->words >= 0 && clock_seconds() < reader->deadline && poll(&words, 1, 0) > 0)
        take_words(reader);
}

static void finish(struct reader *reader, enum pipe_fault fault)
{
    close_end(&reader->data);
    if (fault == PIPE_OK)
        hear_rest(reader);
    else if (fault == PIPE_SHORT)
        await(reader);
    close_end(&reader->words);
    /* A child that has closed its pipes has ended or will not end by itself. */
    kill(-reader->process, SIGKILL);
    pid_t found;
    do {
        found = waitpid(reader->process, &reader->ended, 0);
    } while (found < 0 && errno == EINTR);
    reader->has_ended = found == reader->process;
    count_living(-1);
}

/* ---- log why it failed ---- */

/* Logs at most `max` lines of the child's stderr; returns their number. */
static int repeat(const struct reader *reader, int max)
{
    static const char mark[] = "firn: ", warning[] = "warning: ";
    const size_t mark_size = sizeof(mark) - 1, warning_size = sizeof(warning) - 1;
    int count = 0;
    for (const char *line = reader->said; *line && count < max;) {
        const size_t length = strcspn(line, "\n");
        if (strncmp(line, mark, mark_size) == 0) {
            const char *text = line + mark_size;
            const int size = (int)(length - mark_size);
            if (strncmp(text, warning, warning_size) == 0)
                log_warning("%.*s", size - (int)warning_size, text + warning_size);
            else
                log_error("%.*s", size, text);
            count++;
        }
        line += length + (line[length] == '\n');
    }
    return count;
}

/* Returns whether the program was started with a limit below that of the reader. */
static bool has_own_limit(int resource, uint64_t size)
{
    struct rlimit limits;
    return getrlimit((unsigned)resource, &limits) == 0 && limits.rlim_cur < size;
}

static enum status say_own_limit(const struct reader *reader, const char *what, const char *option)
{
    log_error("%s: reading the file exceeded the %s limit that the program was started with: raise "
              "ulimit %s",
              reader->path, what, option);
    return STATUS_TRY_AGAIN;
}

static enum status say_late(const struct reader *reader)
{
    if (has_own_limit(RLIMIT_CPU, reader->params.seconds))
        return say_own_limit(reader, "time", "-t");
    log_error("%s: reading the file exceeded the limit of %u s of CPU time (raise it with "
              "--load-seconds)",
              reader->path, reader->params.seconds);
    return STATUS_DATA;
}

static enum status say_idle(const struct reader *reader)
{
    log_error("%s: nothing could be read for %u s: expected a file that does not wait for a writer",
              reader->path, reader->params.idle_seconds);
    return STATUS_DATA;
}

static enum status say_greedy(const struct reader *reader)
{
    if (has_own_limit(RLIMIT_AS, (uint64_t)reader->params.memory_gib << 30))
        return say_own_limit(reader, "memory", "-v");
    log_error(
        "%s: reading the file exceeded the memory limit of %u GiB (raise it with --load-memory)",
        reader->path, reader->params.memory_gib);
    return STATUS_DATA;
}

static enum status say_large(const struct reader *reader)
{
    log_error("%s: the picture needs more than a quarter of the memory limit of %u GiB (raise it "
              "with --load-memory)",
              reader->path, reader->params.memory_gib);
    return STATUS_DATA;
}

static enum status say_crashed(const struct reader *reader)
{
    const bool by_signal = reader->has_ended && WIFSIGNALED(reader->ended);
    log_error("%s: the reader crashed (%s %d): the file is damaged or unsupported; export it again",
              reader->path, by_signal ? "signal" : "exit code",
              by_signal ? WTERMSIG(reader->ended) : WEXITSTATUS(reader->ended));
    return STATUS_DATA;
}

/* Logs why a child sent less data than announced. */
static enum status say_why(const struct reader *reader)
{
    const int status = reader->has_ended ? reader->ended : 0;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    if (reader->is_idle)
        return say_idle(reader);
    if (signal == SIGXCPU)
        return say_late(reader);
    if (code == NO_PROGRAM || code == STATUS_USAGE) {
        log_error("%s: the reader process cannot start: raise the limits that the program was "
                  "started with (ulimit -v, -n)",
                  reader->path);
        return STATUS_TRY_AGAIN;
    }
    if (code == STATUS_TRY_AGAIN || strstr(reader->said, "bad_alloc"))
        return say_greedy(reader);
    if ((code == STATUS_DATA || code == STATUS_NO_INPUT) && repeat(reader, 1) == 1)
        return (enum status)code;
    return say_crashed(reader);
}

static enum status judge(const struct reader *reader, enum pipe_fault fault)
{
    if (fault == PIPE_SHORT)
        return say_why(reader);
    if (fault == PIPE_MEMORY)
        return log_out_of_memory(reader->path);
    if (fault == PIPE_LARGE)
        return say_large(reader);
    if (fault != PIPE_OK) {
        log_error("%s: invalid data from the reader: %s; export the file again", reader->path,
                  pipe_words(fault));
        return STATUS_DATA;
    }
    if (!reader->params.no_warnings)
        repeat(reader, SAID_SIZE);
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
    const enum status status = judge(reader, fault);
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
