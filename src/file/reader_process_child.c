/* reader_process_child.c: child side of a reader process: arguments, limits and sandbox. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/reader_child.h"
#include "src/file/sandbox.h"

enum {
    /* Length of argv: program, READER_OPTION, path, kind, seconds, GiB, no_sandbox, details. */
    ARGUMENT_COUNT = 8,
};

bool reader_is_child(int argc, char **argv)
{
    return argc > 1 && strcmp(argv[1], READER_OPTION) == 0;
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
    *job = (struct reader_job){
        .kind = kind,
        .path = argv[2],
        .details = argv[7],
        .no_sandbox = numbers[3],
    };

    const bool done = reader_child_limit(numbers[1], numbers[2]);
    const bool with_folder = kind <= READER_OCIO;
    if (done && (job->no_sandbox || sandbox_enter(job->path, with_folder)))
        return true;
    log_error("%s: the system refuses %s: %s: allow it in the container%s", job->path,
              done ? "the sandbox of readers (prctl, Landlock or seccomp)"
                   : "limits of readers (setrlimit)",
              strerror(errno), done ? ", or use --sandbox off for files that you trust" : "");
    _Exit(STATUS_NO_DEVICE);
}

static bool write_to_parent(void *user, const void *bytes, size_t size)
{
    (void)user;
    return reader_child_write(bytes, size);
}

const struct pipe_sink reader_sink = { .write = write_to_parent };
