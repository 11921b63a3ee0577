/*
 * spirv.h: reads the interface of a shader from its SPIR-V. Private to graph/ and its tests.
 * (Khronos, "SPIR-V Specification" 1.6, sections 2.3 and 3, which define the numbers below.)
 *
 * No word is trusted: whatever a module holds, nothing beyond it is read, and every walk ends.
 */
#ifndef RG_COMPILE_SPIRV_H
#define RG_COMPILE_SPIRV_H

#include "graph/compile/arena.h"
#include "graph/rg.h"

enum {
    SPIRV_UNIFORM_CONSTANT = 0, /* storage classes */
    SPIRV_INPUT = 1,
    SPIRV_UNIFORM = 2,
    SPIRV_OUTPUT = 3,
    SPIRV_PUSH_CONSTANT = 9,
    SPIRV_STORAGE_BUFFER = 12,
    SPIRV_DIM_2D = 1, /* of images */
    SPIRV_DIM_3D = 2,
    SPIRV_DIM_CUBE = 3,
    SPIRV_DIM_BUFFER = 5,
};

#define SPIRV_NONE UINT32_MAX

/* A variable outside of functions. */
struct spirv_variable {
    const char *name; /* "" if it has none; borrowed from the module */
    uint32_t storage;
    uint32_t type;                   /* pointed to */
    uint32_t binding, set, location; /* SPIRV_NONE if it has none */
    bool used;                       /* by the entry point, as far as instructions tell */
    bool in_interface;               /* listed by the entry point */
};

struct spirv_constant {
    uint32_t id;   /* as of VkSpecializationMapEntry */
    uint32_t size; /* bytes */
};

struct spirv_member {
    const char *name;
    uint32_t type;
    uint32_t offset, size; /* bytes; SPIRV_NONE if it has no offset */
};

struct spirv_image {
    uint32_t dim, format; /* the format as of SPIR-V; 0: unknown */
    char component;       /* as of rg_spirv_component() */
    bool arrayed, multisampled;
};

/* A module. Start with {0}; it may be read into again, which uses its arrays again. */
struct spirv {
    const struct rg_shader *shader;
    struct spirv_variable *variables;
    struct spirv_constant *constants; /* specialization constants */
    uint32_t variable_count, constant_count;
    struct spirv_id *ids; /* the rest is opaque */
    uint32_t id_room, variable_room, constant_room;
};

/* Reads the entry point `main` of a stage, and what it can reach. Returns NULL, or what is wrong
 * with the module; then, or if memory is short, the rest must not be called. */
const char *rg_spirv_read(struct spirv *s, struct arena *arena, const struct rg_shader *shader,
                          VkShaderStageFlagBits stage);

/* Returns the descriptor of a variable, and the number of them in *count (0: not known from the
 * code); VK_DESCRIPTOR_TYPE_MAX_ENUM: it is none. */
VkDescriptorType rg_spirv_descriptor(const struct spirv *s, const struct spirv_variable *v,
                                     uint32_t *count);

/* Returns the name of a variable, or of the block that has none itself; "?" without names. */
const char *rg_spirv_name(const struct spirv *s, const struct spirv_variable *v);

/* Name and number of members of a struct type; NULL for other types. */
const char *rg_spirv_struct(const struct spirv *s, uint32_t type, uint32_t *member_count);
struct spirv_member rg_spirv_member(const struct spirv *s, uint32_t type, uint32_t index);

/* Returns the bytes of a struct, or of each in an array, without padding behind its last
 * member; 0 of anything else. */
uint32_t rg_spirv_struct_size(const struct spirv *s, uint32_t type);

/* Returns false for types that are no image, sampled or not, and no array of them. */
bool rg_spirv_image(const struct spirv *s, uint32_t type, struct spirv_image *image);

/* Of a number or vector: the type of its components ('f' float, 'i' or 'u' integer of 32 bits or
 * less, else '?') and, unless `count` is NULL, their number. */
char rg_spirv_component(const struct spirv *s, uint32_t type, uint32_t *count);

/* Returns the number of locations that an input or output of a type takes. */
uint32_t rg_spirv_locations(const struct spirv *s, uint32_t type);

#endif
