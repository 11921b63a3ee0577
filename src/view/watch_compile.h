/* watch_compile.h: GLSL to SPIR-V with glslc, as the build does it. */
#ifndef FIRN_VIEW_WATCH_COMPILE_H
#define FIRN_VIEW_WATCH_COMPILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    WATCH_MESSAGE_SIZE = 512,
};

/* SPIR-V; words NULL: none. */
struct watch_code {
    uint32_t *words; /* malloc'd */
    size_t count;
};

/* Whether the program is in PATH. */
bool watch_compile_is_possible(void);

struct embedded_origin; /* shaders/embedded.h */

/* Compiles a file in the folder, from which its includes start, too. On failure *code is {0} and
 * the message says why, one line. */
bool watch_compile(struct watch_code *code, const char *folder,
                   const struct embedded_origin *origin, char message[static WATCH_MESSAGE_SIZE]);

/* The first binding that `code` has and `allowed` has not; -1: none. */
int watch_compile_new_binding(const struct watch_code *code, const uint32_t *allowed,
                              size_t allowed_count);

#endif
