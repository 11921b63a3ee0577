/* reader_child_posix.c: reader processes by posix_spawn(), pipes and resource limits. */
#define _GNU_SOURCE /* environ, pipe2, posix_spawn_file_actions_addclosefrom_np, prctl */
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <poll.h>
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
#include "src/base/thread.h"
#include "src/file/reader_child.h"

enum {
    BUFFER_SIZE = 1 << 20, /* requested pipe capacity, bytes */
    OPEN_FILE_MAX = 32,
};

struct reader_child {
    pid_t process;
    int pipes[READER_CHILD_PIPE_COUNT]; /* read ends, or -1 */
    double busy_seconds;                /* last known */
    bool stays_dumpable;
};

static struct mutex reader_count_lock = MUTEX_INITIALIZER;
static uint32_t reader_count; /* number of readers that exist */
static bool was_dumpable;

/* Adds `change` to the number of readers. While readers exist, other processes of the user cannot
 * open this process's memory, and a crash writes no core file. */
static void count_readers(int change)
{
    mutex_lock(&reader_count_lock);
    if (reader_count == 0) {
        was_dumpable = prctl(PR_GET_DUMPABLE) == 1;
        prctl(PR_SET_DUMPABLE, 0);
    }
    reader_count += (uint32_t)change;
    if (reader_count == 0 && was_dumpable)
        prctl(PR_SET_DUMPABLE, 1);
    mutex_unlock(&reader_count_lock);
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

/* Opens the pipes and spawns the child. Returns 0 or an errno. */
static int start(struct reader_child *child, const char *program, char *const *arguments)
{
    int data[2] = { -1, -1 }, messages[2] = { -1, -1 };
    int failed = open_pipe(data) && open_pipe(messages) ? 0 : errno;
    if (!failed) {
        fcntl(data[0], F_SETPIPE_SZ, BUFFER_SIZE); /* optional: larger pipes are faster */
        failed = spawn(&child->process, program, arguments, data[1], messages[1]);
    }
    close_end(&data[1]);
    close_end(&messages[1]);
    child->pipes[READER_CHILD_DATA] = data[0];
    child->pipes[READER_CHILD_MESSAGES] = messages[0];
    return failed;
}

int reader_child_start(struct reader_child **started, const struct reader_params *params,
                       char *const *arguments)
{
    struct reader_child *child = calloc(1, sizeof(*child));
    *started = NULL;
    if (!child)
        return ENOMEM;
    child->stays_dumpable = params->stays_dumpable;
    if (!child->stays_dumpable)
        count_readers(1);
    const int failed = start(child, params->program, arguments);
    if (!failed) {
        *started = child;
        return 0;
    }
    if (!child->stays_dumpable)
        count_readers(-1);
    for (int i = 0; i < READER_CHILD_PIPE_COUNT; i++)
        close_end(&child->pipes[i]);
    free(child);
    return failed;
}

bool reader_child_is_open(const struct reader_child *child, enum reader_child_pipe pipe)
{
    return child->pipes[pipe] >= 0;
}

void reader_child_close(struct reader_child *child, enum reader_child_pipe pipe)
{
    close_end(&child->pipes[pipe]);
}

bool reader_child_wait(const struct reader_child *child, double seconds,
                       bool is_ready[static READER_CHILD_PIPE_COUNT])
{
    const int milliseconds = seconds > 1000  ? 1000000
                             : seconds > 0.0 ? (int)(seconds * 1e3) + 1
                                             : 0;
    struct pollfd ends[READER_CHILD_PIPE_COUNT];
    for (int i = 0; i < READER_CHILD_PIPE_COUNT; i++)
        ends[i] = (struct pollfd){ .fd = child->pipes[i], .events = POLLIN };
    const int count = poll(ends, READER_CHILD_PIPE_COUNT, milliseconds);
    for (int i = 0; i < READER_CHILD_PIPE_COUNT; i++)
        is_ready[i] = count > 0 && ends[i].revents;
    return count >= 0 || errno == EINTR;
}

size_t reader_child_read(struct reader_child *child, enum reader_child_pipe pipe, void *bytes,
                         size_t size)
{
    ssize_t count;
    do {
        count = read(child->pipes[pipe], bytes, size);
    } while (count < 0 && errno == EINTR);
    if (count > 0)
        return (size_t)count;
    close_end(&child->pipes[pipe]);
    return 0;
}

/* Returns the time for which the child's main thread was runnable but did not run, from the second
 * number of Linux's schedstat file. Returns 0 if there is no such file. */
static double waiting_seconds(const struct reader_child *child)
{
    char path[64];
    uint64_t ran, waited = 0;
    (void)snprintf(path, sizeof(path), "/proc/%jd/schedstat", (intmax_t)child->process);
    FILE *file = fopen(path, "re");
    if (file && fscanf(file, "%" SCNu64 " %" SCNu64, &ran, &waited) != 2)
        waited = 0;
    if (file)
        fclose(file);
    return 1e-9 * (double)waited;
}

double reader_child_busy_seconds(struct reader_child *child)
{
    clockid_t clock;
    struct timespec used;
    if (clock_getcpuclockid(child->process, &clock) == 0 && clock_gettime(clock, &used) == 0) {
        const double seconds =
            (double)used.tv_sec + 1e-9 * (double)used.tv_nsec + waiting_seconds(child);
        child->busy_seconds = fmax(child->busy_seconds, seconds);
    }
    return child->busy_seconds;
}

struct reader_child_end reader_child_finish(struct reader_child *child)
{
    int status = 0;
    pid_t found;
    for (int i = 0; i < READER_CHILD_PIPE_COUNT; i++)
        close_end(&child->pipes[i]);
    kill(-child->process, SIGKILL); /* the whole process group */
    do {
        found = waitpid(child->process, &status, 0);
    } while (found < 0 && errno == EINTR);
    const bool has_ended = found == child->process;
    if (!child->stays_dumpable)
        count_readers(-1);
    free(child);
    if (!has_ended)
        return (struct reader_child_end){ 0 };
    return (struct reader_child_end){
        .code = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
        .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
        .is_out_of_time = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU,
    };
}

bool reader_child_inherits_limit(bool is_time, uint64_t limit)
{
    struct rlimit inherited;
    return getrlimit(is_time ? RLIMIT_CPU : RLIMIT_AS, &inherited) == 0 &&
           inherited.rlim_cur < limit;
}

/* ---- in the child process ---- */

static rlim_t smaller(rlim_t a, rlim_t b)
{
    return a < b ? a : b; /* RLIM_INFINITY is the maximum value */
}

/* Lowers a resource limit unless the program was started with a smaller one. */
static bool set_limit(int resource, uint64_t soft, uint64_t hard)
{
    struct rlimit limits;
    if (getrlimit((unsigned)resource, &limits) != 0)
        return false;
    limits.rlim_max = smaller(limits.rlim_max, (rlim_t)hard);
    limits.rlim_cur = smaller(smaller(limits.rlim_cur, (rlim_t)soft), limits.rlim_max);
    return setrlimit((unsigned)resource, &limits) == 0;
}

/* Returns true if the parent process, which reads this process's stdout, has ended. */
static bool is_orphan(void)
{
    struct pollfd out = { .fd = STDOUT_FILENO };
    return poll(&out, 1, 0) == 1 && out.revents & POLLERR;
}

bool reader_child_limit(uint32_t seconds, uint32_t memory_gib)
{
    (void)memory_gib; /* with sanitizers */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    bool done = !is_orphan() && set_limit(RLIMIT_CORE, 0, 0) && set_limit(RLIMIT_FSIZE, 0, 0) &&
                set_limit(RLIMIT_NOFILE, OPEN_FILE_MAX, OPEN_FILE_MAX) &&
                set_limit(RLIMIT_CPU, seconds, (uint64_t)seconds + 1);
#ifndef READER_MAPS_SHADOWS
    const uint64_t size = (uint64_t)memory_gib << 30;
    done = done && set_limit(RLIMIT_AS, size, size);
#endif
    return done;
}

bool reader_child_write(const void *bytes, size_t size)
{
    for (const char *next = bytes; size > 0;) {
        const ssize_t count = write(STDOUT_FILENO, next, size);
        if (count <= 0) /* cannot be EINTR without signal handlers */
            return false;
        next += count;
        size -= (size_t)count;
    }
    return true;
}
