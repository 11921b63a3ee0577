/*
 * reader_process.h: sandboxed child process that parses an untrusted file for its parent.
 *
 * Parsers of models and images are large, and a damaged or malicious file may make one crash, hang,
 * use all memory, or execute code. Therefore the program starts itself as a child process that
 * inherits no environment except what the dynamic loader needs and no descriptors except its pipes;
 * that has limits on memory, CPU time and open files; and that may only read the file, or its
 * folder, and compute (sandbox.h). The data it sends is validated again (reader_pipe.h). The child
 * is spawned rather than forked: this is safe in a multithreaded program, and no memory is shared.
 * While a reader exists, the parent is not dumpable unless it asks to stay as it is, so the child
 * cannot open the parent's memory either. Smaller limits of the program itself (RLIMIT_AS,
 * RLIMIT_CPU, RLIMIT_NOFILE, as set by batch systems) also apply to the child.
 *
 * Thread-safety: any thread; one reader is used by one thread at a time. Errors: one line is
 * logged: STATUS_NO_INPUT; STATUS_DATA if the child fails because of the file; STATUS_TRY_AGAIN if
 * the parent lacks memory or processes, or if the child reaches a limit that the program was
 * started with; STATUS_NO_DEVICE if the system refuses to start the child or its sandbox.
 */
#ifndef FIRN_FILE_READER_PROCESS_H
#define FIRN_FILE_READER_PROCESS_H

#include "src/base/status.h"
#include "src/file/reader_pipe.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define READER_MAPS_SHADOWS 1 /* sanitizers map terabytes: no RLIMIT_AS */
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define READER_MAPS_SHADOWS 1
#endif
#endif

/* First argument of the program when it runs as a reader process. */
#define READER_OPTION "--read"

enum {
    READER_SECONDS = 60,
    READER_IDLE_SECONDS = 30,
    READER_MEMORY_GIB = 4,
};

/* Task of a reader process: the type of the file and, for a model, its role in the scene. */
enum reader_kind {
    READER_OBJECT,
    READER_SURROUNDINGS,
    READER_BY_MATERIALS,
    READER_OCIO, /* the last kind that may read the folder of its file */
    READER_ENVIRONMENT,
    READER_IMAGE,       /* sends the rows of an image */
    READER_IMAGE_CHECK, /* checks an image, sends its header */
    READER_PRESET,
    READER_KIND_COUNT,
};

struct reader_params {
    const char *program; /* its main() must call sandboxed_load_main() */
    uint32_t seconds;    /* CPU time limit; 0 for READER_SECONDS */
    /* Idle limit in seconds; 0 for READER_IDLE_SECONDS. A child that uses no CPU time and sends
     * nothing for longer is stopped. For example, it may wait for a FIFO or a file server. The
     * total time that the parent waits is limited, too: to this number, plus the same number for
     * each second of CPU time and for each 64 MiB of data. */
    uint32_t idle_seconds;
    uint32_t memory_gib; /* address space; 0 for READER_MEMORY_GIB */
    bool no_sandbox;     /* for debugging: resource limits only */
    bool no_warnings;    /* do not repeat the child's warnings */
    bool stays_dumpable; /* leave the parent dumpable: set by the library */
    const char *details; /* argument of the task, or NULL */
};

struct reader;

/* Starts a reader process. `path` and `params` must outlive it. On failure *started is NULL. */
MUST_USE enum status reader_start(struct reader **started, const struct reader_params *params,
                                  enum reader_kind kind, const char *path);

/* Returns the data stream of a reader. Arrays in it may not exceed the reader's memory limit. */
struct pipe_source reader_source(struct reader *reader);

/*
 * Stops a reader process and frees `reader`. If `fault` is PIPE_OK, logs the child's warnings and
 * returns STATUS_OK. Otherwise, logs why no valid data arrived and returns the failure's status.
 */
MUST_USE enum status reader_end(struct reader *reader, enum pipe_fault fault);

/* Stops and frees a reader whose data is not used. `reader` may be NULL. */
void reader_drop(struct reader *reader);

/* Task of a child process, as given on its command line. */
struct reader_job {
    enum reader_kind kind;
    const char *path;
    const char *details; /* reader_params.details; may be "" */
    bool no_sandbox;
};

/* Returns true if the program was started as a reader process. */
bool reader_is_child(int argc, char **argv);

/* Reads the command line into *job, then applies the resource limits and the sandbox. Returns false
 * if the arguments are invalid, or if a limit or the sandbox cannot be applied. */
MUST_USE bool reader_enter(int argc, char **argv, struct reader_job *job);

/* Pipe sink with which the child process writes to its parent. */
extern const struct pipe_sink reader_sink;

#endif
