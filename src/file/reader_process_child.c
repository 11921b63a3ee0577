/* reader_process_child.c: child side of a reader process: arguments, resource limits, output pipe.
 */
#define _GNU_SOURCE /* for names of prctl.h and resource.h */
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>
#include "src/base/log.h"
#include "src/file/reader_process.h"
#include "src/file/sandbox.h"

enum {
    OPEN_FILE_MAX = 32,
    /* Length of argv: program, READER_OPTION, path, kind, seconds, GiB, no_sandbox, details. */
    ARGUMENT_COUNT = 8,
};

bool reader_is_child(int argc, char **argv)
{
    return argc > 1 && strcmp(argv[1], READER_OPTION) == 0;
}

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

static bool parse_number(const char *text, uint32_t min, uint32_t max, uint32_t *number)
{
    char *end;
    unsigned long value = strtoul(text, &end, 10);
    *number = (uint32_t)value;
    return end > text && *end == '\0' && value >= min && value <= max;
}

bool reader_enter(int argc, char **argv, struct reader_job *job)
{
    uint32_t numbers[4];
    static const uint32_t min_values[4] = { 1, 1, 1, 0 };
    static const uint32_t max_values[4] = { READER_KIND_COUNT, 1u << 20, 1u << 20, 1 };
    if (argc != ARGUMENT_COUNT)
        return false;
    for (size_t i = 0; i < 4; i++) {
        if (!parse_number(argv[3 + i], min_values[i], max_values[i], &numbers[i]))
            return false;
    }
    const enum reader_kind kind = (enum reader_kind)(numbers[0] - 1);
    const uint32_t seconds = numbers[1];
    *job = (struct reader_job){
        .kind = kind,
        .path = argv[2],
        .details = argv[7],
        .no_sandbox = numbers[3],
    };

    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (is_orphan())
        return false;
    bool done = set_limit(RLIMIT_CORE, 0, 0) && set_limit(RLIMIT_FSIZE, 0, 0) &&
                set_limit(RLIMIT_NOFILE, OPEN_FILE_MAX, OPEN_FILE_MAX) &&
                set_limit(RLIMIT_CPU, seconds, seconds + 1);
#ifndef READER_MAPS_SHADOWS
    const uint64_t size = (uint64_t)numbers[2] << 30;
    done = done && set_limit(RLIMIT_AS, size, size);
#endif
    const bool with_folder = kind <= READER_OCIO;
    if (done && (job->no_sandbox || sandbox_enter(job->path, with_folder)))
        return true;
    log_error("%s: the system refuses %s: %s: allow it in the container%s", job->path,
              done ? "the sandbox of readers (prctl, Landlock or seccomp)"
                   : "limits of readers (setrlimit)",
              strerror(errno), done ? ", or use --sandbox off for files that you trust" : "");
    _exit(STATUS_NO_DEVICE);
}

static bool write_all(void *user, const void *bytes, size_t size)
{
    (void)user;
    for (const char *next = bytes; size > 0;) {
        const ssize_t count = write(STDOUT_FILENO, next, size);
        if (count <= 0) /* cannot be EINTR without signal handlers */
            return false;
        next += count;
        size -= (size_t)count;
    }
    return true;
}

const struct pipe_sink reader_sink = { .write = write_all };
