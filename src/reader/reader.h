/*
 * reader.h: reads untrusted files in a child process.
 *
 * Parsers of models and images are large, and a damaged or malicious file may make one crash, hang
 * or use all memory, or take it over. Therefore the program starts itself as a child, which
 * receives no environment but what the dynamic loader needs, and no descriptors but its pipes; has
 * limits of memory, time and open files; and may do nothing but read the file, or its folder, and
 * compute (sandbox.h). What it sends is validated again (pipe.h). The child is spawned, not forked:
 * that is safe in a program with threads, and the child has none of the parent's memory; nor can it
 * open that memory, for while a reader lives, the parent is not dumpable. Where the program itself
 * runs under smaller limits (RLIMIT_AS, RLIMIT_CPU, RLIMIT_NOFILE, as batch systems set them),
 * these hold for the child.
 *
 * Thread-safety: any thread; one reader is used by one thread at a time.
 * Errors:        one line is logged: STATUS_NO_INPUT; STATUS_DATA if the child fails because of the
 *                file; STATUS_TRY_AGAIN if the parent lacks memory or processes, if the child
 *                cannot start, or if it reaches a limit that the program was started with.
 */
#ifndef FIRN_READER_READER_H
#define FIRN_READER_READER_H

#include "src/base/status.h"
#include "src/reader/pipe.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define READER_MAPS_SHADOWS 1 /* a sanitizer maps terabytes: no limit of address space */
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define READER_MAPS_SHADOWS 1
#endif
#endif

/* The program's first argument in the child. */
#define READER_WORD "--read"

enum {
    READER_SECONDS = 60,
    READER_IDLE_SECONDS = 30,
    READER_MEMORY_GIB = 4,
};

/* What a reader does. */
enum reader_kind {
    READER_OBJECT,
    READER_SURROUNDINGS,
    READER_BY_MATERIALS,
    READER_ENVIRONMENT,
    READER_PICTURE,       /* sends its rows */
    READER_PICTURE_CHECK, /* reads it to its end, but sends only its header */
    READER_PRESET,
    READER_KIND_COUNT,
};

struct reader_params {
    const char *program;   /* path of a program whose main() calls decode_main() in the child */
    uint32_t seconds;      /* limit of CPU time; 0: READER_SECONDS */
    uint32_t idle_seconds; /* limit of elapsed time in which the child neither computes nor sends,
                              since it waits for a FIFO or a file server; 0: READER_IDLE_SECONDS */
    uint32_t memory_gib;   /* limit of address space; 0: READER_MEMORY_GIB */
    bool no_sandbox;       /* for debugging: limits alone */
    bool no_warnings;      /* of the child: not repeated */
    const char *details;   /* what the child's kind needs to know beside the path; NULL: "" */
};

struct reader;

/* Starts a reader of a file; `path` and `params` must outlive it. On failure *reader is NULL. */
MUST_USE enum status reader_start(struct reader **reader, const struct reader_params *params,
                                  enum reader_kind kind, const char *path);

/* Returns what the reader sends; the limit of size is that of its memory. */
struct pipe_source reader_source(struct reader *reader);

/*
 * Ends the reader, and frees it. If `fault` is PIPE_OK, repeats its warnings; else logs why no
 * valid data came, and returns the status for that.
 */
MUST_USE enum status reader_end(struct reader *reader, enum pipe_fault fault);

/* Ends a reader whose data are not wanted any more, and frees it. It may be NULL. */
void reader_drop(struct reader *reader);

/* ---- in the child ---- */

struct reader_job {
    enum reader_kind kind;
    const char *path;
    const char *details; /* of the parameters; may be "" */
    bool no_sandbox;
};

/* Returns whether the program was started to read a file. */
bool reader_is_wanted(int argc, char **argv);

/* Applies the limits and the sandbox and returns the job in *job. Returns false if the arguments
 * are invalid, or a limit or the sandbox cannot be set. */
MUST_USE bool reader_enter(int argc, char **argv, struct reader_job *job);

/* Writes to the parent. */
extern const struct pipe_sink reader_sink;

#endif
