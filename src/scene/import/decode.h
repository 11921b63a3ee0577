/*
 * decode.h: reads untrusted files in a child process.
 *
 * Parsers of models and images are large, and a damaged or malicious file may make one crash, hang
 * or use all memory. Therefore the program starts itself as a child with limits of memory, time and
 * open files, without descriptors other than the pipes to the parent and without permission to
 * write files, and receives meshes and texels, which it validates again (mesh_pipe.h). The child is
 * spawned, not forked: that is safe in a program with threads, and the child has none of the
 * parent's memory. Where the program itself runs under smaller limits (RLIMIT_AS, RLIMIT_CPU,
 * RLIMIT_NOFILE, as batch systems set them), these hold for the child.
 *
 * Thread-safety: any thread, one model at a time (see model.h).
 * Errors:        one line is logged: STATUS_NO_INPUT; STATUS_DATA if the child fails because of the
 *                file; STATUS_TRY_AGAIN if the parent lacks memory or processes, if the child
 *                cannot start, or if it reaches a limit that the program was started with.
 */
#ifndef FIRN_SCENE_IMPORT_DECODE_H
#define FIRN_SCENE_IMPORT_DECODE_H

#include "src/scene/environment.h"
#include "src/scene/import/model.h"

/* The program's first argument in the child. */
#define DECODE_WORD "--decode"

enum {
    DECODE_SECONDS = 60,
    DECODE_IDLE_SECONDS = 30,
    DECODE_MEMORY_GIB = 4,
};

struct decode_params {
    const char *program;   /* path of a program whose main() calls decode_main() in the child */
    uint32_t seconds;      /* limit of CPU time; 0: DECODE_SECONDS */
    uint32_t idle_seconds; /* limit of elapsed time in which the child neither computes nor sends,
                              since it waits for a FIFO or a file server; 0: DECODE_IDLE_SECONDS */
    uint32_t memory_gib;   /* limit of address space; 0: DECODE_MEMORY_GIB */
};

/* Load a file as model_load() and environment_load() do; if `params` is NULL, in this process. */
MUST_USE enum status decode_model(struct model *model, const char *path,
                                  enum model_part everything_is,
                                  const struct decode_params *params);
MUST_USE enum status decode_environment(struct environment *environment, const char *path,
                                        const struct decode_params *params);

/* ---- in the child ---- */

enum decode_kind {
    DECODE_OBJECT,
    DECODE_SURROUNDINGS,
    DECODE_ENVIRONMENT,
    DECODE_KIND_COUNT,
};

struct decode_job {
    enum decode_kind kind;
    const char *path;
};

/* Returns whether the program was started to read a file. */
bool decode_is_wanted(int argc, char **argv);

/* Applies the limits and returns the job in *job. Returns false if the arguments are invalid. */
MUST_USE bool decode_enter(int argc, char **argv, struct decode_job *job);

/* Does the whole work of a child, and returns its exit code. */
int decode_main(int argc, char **argv);

#endif
