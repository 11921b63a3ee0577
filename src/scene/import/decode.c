/* decode.c: starts the child that reads a file, receives its data, and logs why it failed. */
#define _GNU_SOURCE /* environ, pipe2, posix_spawn_file_actions_addclosefrom_np */
#include "src/scene/import/decode.h"
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/scene/import/mesh_pipe.h"

enum {
    PIPE_SIZE = 1 << 20, /* bytes, where the system allows it */
    SAID_SIZE = 4096,
    NO_PROGRAM = 127, /* exit code of the dynamic loader when it cannot load a library */
};

struct child {
    pid_t process;
    int data, words; /* descriptors of the pipes from its stdout and stderr; -1: closed */
    double deadline; /* seconds of the monotonic clock; moves on while the child makes progress */
    double cpu_seconds; /* that the child had used when the deadline was set */
    uint32_t idle_seconds;
    bool is_idle;         /* made no progress until the deadline */
    char said[SAID_SIZE]; /* its stderr so far; ends at '\0' */
    size_t said_size;
    int ended; /* status of waitpid(); valid if has_ended */
    bool has_ended;
};

static uint32_t seconds_of(const struct decode_params *params)
{
    return params->seconds ? params->seconds : DECODE_SECONDS;
}

static uint32_t memory_gib_of(const struct decode_params *params)
{
    return params->memory_gib ? params->memory_gib : DECODE_MEMORY_GIB;
}

static uint32_t idle_seconds_of(const struct decode_params *params)
{
    return params->idle_seconds ? params->idle_seconds : DECODE_IDLE_SECONDS;
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

/* Returns 0 or an errno. The child has a process group of its own, so that Ctrl-C reaches only the
 * parent. */
static int spawn(pid_t *process, const char *program, char *const *words, int out, int err)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t none, usual;
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
        failed = posix_spawn(process, program, &files, &how, words, environ);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return failed;
}

static enum status start(struct child *child, const struct decode_params *params,
                         enum decode_kind kind, const char *path)
{
    int data[2] = { -1, -1 }, words[2] = { -1, -1 };
    char numbers[3][16], name[] = "firn", word[] = DECODE_WORD;
    char *file = strdup(path);
    *child = (struct child){
        .data = -1,
        .words = -1,
        .deadline = clock_seconds() + idle_seconds_of(params),
        .idle_seconds = idle_seconds_of(params),
    };
    snprintf(numbers[0], sizeof(numbers[0]), "%d", (int)kind + 1);
    snprintf(numbers[1], sizeof(numbers[1]), "%u", seconds_of(params));
    snprintf(numbers[2], sizeof(numbers[2]), "%u", memory_gib_of(params));
    char *const argv[] = { name, word, numbers[0], file, numbers[1], numbers[2], NULL };
    int failed = file ? 0 : ENOMEM;
    if (!failed && (!open_pipe(data) || !open_pipe(words)))
        failed = errno;
    if (!failed) {
        fcntl(data[0], F_SETPIPE_SZ, PIPE_SIZE); /* a smaller pipe is only slower */
        failed = spawn(&child->process, params->program, argv, data[1], words[1]);
    }
    free(file);
    close_end(&data[1]);
    close_end(&words[1]);
    child->data = data[0];
    child->words = words[0];
    if (!failed)
        return STATUS_OK;
    close_end(&child->data);
    close_end(&child->words);
    log_error("%s: cannot start the reader process %s: %s", path, params->program,
              strerror(failed));
    return STATUS_TRY_AGAIN;
}

/* ---- receive ---- */

static void take_words(struct child *child)
{
    char bytes[512];
    const ssize_t count = read(child->words, bytes, sizeof(bytes));
    if (count < 0 && errno == EINTR)
        return;
    if (count <= 0) {
        close_end(&child->words);
        return;
    }
    for (ssize_t i = 0; i < count && child->said_size + 1 < SAID_SIZE; i++) {
        if (bytes[i] != '\0')
            child->said[child->said_size++] = bytes[i];
    }
}

/* Returns whether the child has made no progress until its deadline. A child that has computed in
 * the meantime gets a later deadline. */
static bool is_idle(struct child *child)
{
    clockid_t clock;
    struct timespec used;
    if (clock_seconds() < child->deadline)
        return false;
    if (clock_getcpuclockid(child->process, &clock) != 0 || clock_gettime(clock, &used) != 0)
        return true;
    const double cpu_seconds = (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
    if (cpu_seconds <= child->cpu_seconds)
        return true;
    child->cpu_seconds = cpu_seconds;
    child->deadline = clock_seconds() + child->idle_seconds;
    return false;
}

/* Waits until data or their end can be read; returns false if the child makes no progress. */
static bool await(struct child *child)
{
    while (child->data >= 0 || child->words >= 0) {
        struct pollfd ends[] = {
            { .fd = child->data, .events = POLLIN },
            { .fd = child->words, .events = POLLIN },
        };
        child->is_idle = child->is_idle || is_idle(child);
        if (child->is_idle)
            return false;
        const double left = child->deadline - clock_seconds();
        const int count = poll(ends, 2,
                               left > 1000 ? 1000000
                               : left > 0  ? (int)(left * 1e3) + 1
                                           : 0);
        if (count < 0 && errno != EINTR)
            return false;
        if (count > 0 && ends[1].revents)
            take_words(child);
        if (count > 0 && ends[0].revents)
            return true;
    }
    return false;
}

static bool read_data(void *user, void *bytes, size_t size)
{
    struct child *child = user;
    char *next = bytes;
    while (size > 0 && child->data >= 0 && await(child)) {
        const ssize_t count = read(child->data, next, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0) {
            close_end(&child->data);
            break;
        }
        next += count;
        size -= (size_t)count;
        child->deadline = clock_seconds() + child->idle_seconds;
    }
    return size == 0;
}

/* Reads the rest of stderr; what the child wrote before its last data is already in the pipe. */
static void hear_rest(struct child *child)
{
    struct pollfd words = { .fd = child->words, .events = POLLIN };
    while (child->words >= 0 && clock_seconds() < child->deadline && poll(&words, 1, 0) > 0)
        take_words(child);
}

static void finish(struct child *child, enum mesh_pipe_fault fault)
{
    close_end(&child->data);
    if (fault == MESH_PIPE_OK)
        hear_rest(child);
    else if (fault == MESH_PIPE_SHORT)
        await(child);
    close_end(&child->words);
    /* A child that has closed its pipes has ended or will not end by itself. */
    kill(child->process, SIGKILL);
    pid_t found;
    do {
        found = waitpid(child->process, &child->ended, 0);
    } while (found < 0 && errno == EINTR);
    child->has_ended = found == child->process;
}

/* ---- log why it failed ---- */

/* Logs at most `max` lines of the child's stderr; returns their number. */
static int repeat(const struct child *child, int max)
{
    static const char mark[] = "firn: ", warning[] = "warning: ";
    const size_t mark_size = sizeof(mark) - 1, warning_size = sizeof(warning) - 1;
    int count = 0;
    for (const char *line = child->said; *line && count < max;) {
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

static enum status say_own_limit(const char *path, const char *what, const char *option)
{
    log_error("%s: reading the file exceeded the %s limit that the program was started with: raise "
              "ulimit %s",
              path, what, option);
    return STATUS_TRY_AGAIN;
}

static enum status say_late(const char *path, const struct decode_params *params)
{
    if (has_own_limit(RLIMIT_CPU, seconds_of(params)))
        return say_own_limit(path, "time", "-t");
    log_error("%s: reading the file exceeded the limit of %u s of CPU time (raise it with "
              "--load-seconds)",
              path, seconds_of(params));
    return STATUS_DATA;
}

static enum status say_idle(const char *path, const struct child *child)
{
    log_error("%s: nothing could be read for %u s: expected a file that does not wait for a writer",
              path, child->idle_seconds);
    return STATUS_DATA;
}

static enum status say_greedy(const char *path, const struct decode_params *params)
{
    if (has_own_limit(RLIMIT_AS, (uint64_t)memory_gib_of(params) << 30))
        return say_own_limit(path, "memory", "-v");
    log_error(
        "%s: reading the file exceeded the memory limit of %u GiB (raise it with --load-memory)",
        path, memory_gib_of(params));
    return STATUS_DATA;
}

static enum status say_crashed(const char *path, const struct child *child)
{
    const bool by_signal = child->has_ended && WIFSIGNALED(child->ended);
    log_error("%s: the reader crashed (%s %d): the file is damaged or unsupported; export it again",
              path, by_signal ? "signal" : "exit code",
              by_signal ? WTERMSIG(child->ended) : WEXITSTATUS(child->ended));
    return STATUS_DATA;
}

/* Logs why a child sent less data than announced. */
static enum status say_why(const char *path, const struct decode_params *params,
                           const struct child *child)
{
    const int signal = child->has_ended && WIFSIGNALED(child->ended) ? WTERMSIG(child->ended) : 0;
    const int code = child->has_ended && WIFEXITED(child->ended) ? WEXITSTATUS(child->ended) : 0;
    if (child->is_idle)
        return say_idle(path, child);
    if (signal == SIGXCPU)
        return say_late(path, params);
    if (code == NO_PROGRAM || code == STATUS_USAGE) {
        log_error("%s: the reader process cannot start: raise the limits that the program was "
                  "started with (ulimit -v, -n)",
                  path);
        return STATUS_TRY_AGAIN;
    }
    if (code == STATUS_TRY_AGAIN || strstr(child->said, "bad_alloc"))
        return say_greedy(path, params);
    if ((code == STATUS_DATA || code == STATUS_NO_INPUT) && repeat(child, 1) == 1)
        return (enum status)code;
    return say_crashed(path, child);
}

static enum status judge(const char *path, const struct decode_params *params,
                         const struct child *child, enum mesh_pipe_fault fault)
{
    if (fault == MESH_PIPE_SHORT)
        return say_why(path, params, child);
    if (fault == MESH_PIPE_MEMORY)
        return log_out_of_memory(path);
    if (fault != MESH_PIPE_OK) {
        log_error("%s: invalid data from the reader: %s; export the file again", path,
                  mesh_pipe_words(fault));
        return STATUS_DATA;
    }
    repeat(child, SAID_SIZE);
    return STATUS_OK;
}

static struct mesh_pipe_source source_of(struct child *child, const struct decode_params *params)
{
    return (struct mesh_pipe_source){
        .read = read_data,
        .user = child,
        .size_max = (uint64_t)memory_gib_of(params) << 30,
    };
}

enum status decode_model(struct model *model, const char *path, enum model_part everything_is,
                         const struct decode_params *params)
{
    struct child child;
    if (!params)
        return model_load(model, path, everything_is);
    *model = (struct model){ 0 };
    const enum decode_kind kind =
        everything_is == MODEL_OBJECT ? DECODE_OBJECT : DECODE_SURROUNDINGS;
    enum status status = start(&child, params, kind, path);
    if (status != STATUS_OK)
        return status;
    const struct mesh_pipe_source source = source_of(&child, params);
    const enum mesh_pipe_fault fault = mesh_pipe_read_model(&source, model);
    finish(&child, fault);
    return judge(path, params, &child, fault);
}

enum status decode_environment(struct environment *environment, const char *path,
                               const struct decode_params *params)
{
    struct child child;
    if (!params)
        return environment_load(environment, path);
    *environment = (struct environment){ 0 };
    enum status status = start(&child, params, DECODE_ENVIRONMENT, path);
    if (status != STATUS_OK)
        return status;
    const struct mesh_pipe_source source = source_of(&child, params);
    const enum mesh_pipe_fault fault = mesh_pipe_read_environment(&source, environment);
    finish(&child, fault);
    return judge(path, params, &child, fault);
}
