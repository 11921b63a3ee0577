/* shader_compile.h: compiles GLSL to SPIR-V with glslc and the build's options. */
#ifndef FIRN_VIEW_SHADER_COMPILE_H
#define FIRN_VIEW_SHADER_COMPILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SHADER_COMPILE_MESSAGE_SIZE = 512,
};

/* SPIR-V code; `spirv` is NULL if there is none. */
struct shader_compile_code {
    uint32_t *spirv; /* malloc'd */
    size_t count;
};

/* Returns true if glslc can be run. */
bool shader_compile_is_possible(void);

struct embedded_origin; /* shaders/embedded.h */

/* Compiles a shader. Include files are searched in `folder`. On failure, returns false, zeroes
 * *code and writes a one-line reason to `message`. */
bool shader_compile(struct shader_compile_code *code, const char *folder,
                    const struct embedded_origin *origin,
                    char message[static SHADER_COMPILE_MESSAGE_SIZE]);

/* Returns a descriptor binding of `code` that is not in `allowed`; -1 if there is none. */
int shader_compile_new_binding(const struct shader_compile_code *code, const uint32_t *allowed,
                               size_t allowed_count);

#endif
