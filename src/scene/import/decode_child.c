/* decode_child.c: the child that reads one file, within limits. */
#define _GNU_SOURCE /* for prctl.h's and resource.h's names */
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>
#include "src/base/log.h"
#include "src/scene/import/decode.h"
#include "src/scene/import/mesh_pipe.h"

enum {
    OPEN_FILE_MAX = 32,
    WORD_COUNT = 6, /* arguments: program, DECODE_WORD, kind, path, seconds, GiB */
};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MAPS_SHADOWS 1 /* sanitizers map terabytes of address space */
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MAPS_SHADOWS 1
#endif
#endif

bool decode_is_wanted(int argc, char **argv)
{
    return argc > 1 && strcmp(argv[1], DECODE_WORD) == 0;
}

static rlim_t smaller(rlim_t a, rlim_t b)
{
    return a < b ? a : b; /* RLIM_INFINITY is the largest value */
}

/* Sets a limit; where the caller of the program has set a smaller one, that stays. */
static bool limit(int resource, uint64_t soft, uint64_t hard)
{
    struct rlimit limits;
    if (getrlimit((unsigned)resource, &limits) != 0)
        return false;
    limits.rlim_max = smaller(limits.rlim_max, (rlim_t)hard);
    limits.rlim_cur = smaller(smaller(limits.rlim_cur, (rlim_t)soft), limits.rlim_max);
    return setrlimit((unsigned)resource, &limits) == 0;
}

/* Returns whether the parent, which reads what is written to stdout, has ended. */
static bool is_orphan(void)
{
    struct pollfd out = { .fd = STDOUT_FILENO };
    return poll(&out, 1, 0) == 1 && out.revents & POLLERR;
}

static bool parse_number(const char *word, uint32_t max, uint32_t *number)
{
    char *end;
    unsigned long value = strtoul(word, &end, 10);
    *number = (uint32_t)value;
    return *end == '\0' && value > 0 && value <= max;
}

bool decode_enter(int argc, char **argv, struct decode_job *job)
{
    uint32_t kind, seconds, memory_gib;
    if (argc != WORD_COUNT || !parse_number(argv[2], DECODE_KIND_COUNT, &kind) ||
        !parse_number(argv[4], 1u << 20, &seconds) || !parse_number(argv[5], 1u << 20, &memory_gib))
        return false;
    *job = (struct decode_job){ .kind = (enum decode_kind)(kind - 1), .path = argv[3] };

    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    bool done = !is_orphan() && limit(RLIMIT_CORE, 0, 0) && limit(RLIMIT_FSIZE, 0, 0) &&
                limit(RLIMIT_NOFILE, OPEN_FILE_MAX, OPEN_FILE_MAX) &&
                limit(RLIMIT_CPU, seconds, seconds + 1);
#ifndef MAPS_SHADOWS
    const uint64_t size = (uint64_t)memory_gib << 30;
    done = done && limit(RLIMIT_AS, size, size);
#endif
    return done;
}

static bool write_all(void *user, const void *bytes, size_t size)
{
    (void)user;
    for (const char *next = bytes; size > 0;) {
        const ssize_t count = write(STDOUT_FILENO, next, size);
        if (count <= 0) /* not EINTR, because no signal has a handler */
            return false;
        next += count;
        size -= (size_t)count;
    }
    return true;
}

static const struct mesh_pipe_sink sink = { .write = write_all };

static enum status send_model(const struct decode_job *job)
{
    const enum model_part part = job->kind == DECODE_OBJECT ? MODEL_OBJECT : MODEL_SURROUNDINGS;
    struct model model;
    enum status status = model_load(&model, job->path, part);
    if (status == STATUS_OK && !mesh_pipe_write_model(&sink, &model))
        status = STATUS_WRITE;
    model_finish(&model);
    return status;
}

static enum status send_environment(const struct decode_job *job)
{
    struct environment environment;
    enum status status = environment_load(&environment, job->path);
    if (status == STATUS_OK && !mesh_pipe_write_environment(&sink, &environment))
        status = STATUS_WRITE;
    environment_finish(&environment);
    return status;
}

int decode_main(int argc, char **argv)
{
    struct decode_job job;
    if (!decode_enter(argc, argv, &job)) {
        log_error(DECODE_WORD ": for internal use by firn only");
        return STATUS_USAGE;
    }
    const enum status status =
        job.kind == DECODE_ENVIRONMENT ? send_environment(&job) : send_model(&job);
    _exit((int)status); /* no exit handler runs in a process that has parsed the file */
}
