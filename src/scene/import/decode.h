/*
 * decode.h: files that nobody vouches for are read by another process.
 *
 * Parsers of models and pictures are large, and a broken or malicious file may make one crash, hang
 * or take all memory. So the program starts itself again, with limits of memory, time and open
 * files, no descriptor but the pipes to it, no way to write a file, and gets back meshes and texels
 * that are checked anew (mesh_pipe.h). It is started, not forked: that is sound whatever threads
 * there are, and the child has none of the parent's memory.
 *
 * Threads: any, one model at a time (see model.h).
 * Errors:  one line is logged: STATUS_NO_INPUT, or STATUS_DATA for whatever the file does to its
 *          reader, or STATUS_TRY_AGAIN when memory or processes are short here.
 */
#ifndef FIRN_SCENE_IMPORT_DECODE_H
#define FIRN_SCENE_IMPORT_DECODE_H

#include "src/scene/environment.h"
#include "src/scene/import/model.h"

/* The program's first word when it is started to read a file. */
#define DECODE_WORD "--decode"

enum {
    DECODE_SECONDS = 10,
    DECODE_MEMORY_GIB = 4,
};

struct decode_params {
    const char *program; /* file of a program whose main() hands on to decode_main() */
    uint32_t seconds;    /* by the clock, and of one CPU; 0: DECODE_SECONDS */
    uint32_t memory_gib; /* of addresses; 0: DECODE_MEMORY_GIB */
};

/* As model_load() and environment_load(); without params (NULL) they do it, in this process. */
MUST_USE enum status decode_model(struct model *model, const char *path,
                                  enum model_part everything_is,
                                  const struct decode_params *params);
MUST_USE enum status decode_environment(struct environment *environment, const char *path,
                                        const struct decode_params *params);

/* ---- in the process that reads ---- */

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

/* Whether the program was started to read a file. */
bool decode_is_wanted(int argc, char **argv);

/* What to read; from here on the limits hold. False: the words are not decode.c's. */
MUST_USE bool decode_enter(int argc, char **argv, struct decode_job *job);

/* All that a process does that was started so; its exit code. */
int decode_main(int argc, char **argv);

#endif
