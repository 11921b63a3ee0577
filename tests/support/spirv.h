/*
 * spirv.h: reads the interface of a SPIR-V module and the layout of its structs, for tests.
 * (Khronos, "SPIR-V Specification" 1.6, sections 2.3 and 3, which define the enums below.)
 */
#ifndef TESTS_SPIRV_H
#define TESTS_SPIRV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "graph/rg.h"

enum {
    SPIRV_UNIFORM_CONSTANT = 0, /* storage classes */
    SPIRV_INPUT = 1,
    SPIRV_UNIFORM = 2,
    SPIRV_OUTPUT = 3,
    SPIRV_PUSH_CONSTANT = 9,
    SPIRV_STORAGE_BUFFER = 12,
    SPIRV_DIM_CUBE = 3,
};

#define SPIRV_NONE UINT32_MAX

struct spirv_variable {
    uint32_t storage;
    uint32_t type;                   /* pointed to */
    uint32_t binding, set, location; /* SPIRV_NONE if it has none */
    bool used;                       /* by a function's instructions */
};

struct spirv_member {
    const char *name;
    uint32_t type;
    uint32_t offset, size; /* bytes; SPIRV_NONE if it has no offset */
};

struct spirv_image {
    uint32_t dim;
    bool arrayed, sampled; /* with a sampler; else a storage image */
};

/* Opaque but for the variables. */
struct spirv {
    struct spirv_variable *variables; /* those outside functions */
    uint32_t variable_count;
    const struct rg_shader *shader;
    struct spirv_id *ids;
};

/* False for what is no SPIR-V, or too short of memory to look at it; then there is nothing to
 * finish. The words of the shader are borrowed. */
bool spirv_init(struct spirv *s, const struct rg_shader *shader);
void spirv_finish(struct spirv *s);

/* Name and number of members of a struct type; NULL for other types. */
const char *spirv_struct(const struct spirv *s, uint32_t type, uint32_t *member_count);
struct spirv_member spirv_member(const struct spirv *s, uint32_t type, uint32_t index);

/* False for types that are no image, sampled or not. */
bool spirv_image(const struct spirv *s, uint32_t type, struct spirv_image *image);

/* Of a number or vector, the type of its components: 'f' float, 'i' or 'u' integer; else '?'. */
char spirv_component(const struct spirv *s, uint32_t type);

#endif
