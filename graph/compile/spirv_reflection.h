/* spirv_reflection.h: SPIR-V reflection of a shader's interface (Khronos, "SPIR-V Specification"
 * 1.6, sections 2.3 and 3). Malformed modules are safe: reads stay in bounds and loops terminate.
 * Private to graph/ and its tests. */
#ifndef RG_COMPILE_SPIRV_REFLECTION_H
#define RG_COMPILE_SPIRV_REFLECTION_H

#include <spirv/unified1/spirv.h>

#include "graph/compile/arena.h"
#include "graph/rg.h"

#define SPIRV_NONE UINT32_MAX

/* Accesses of shaders to the content of a storage resource (spirv_variable.access). */
enum {
    SPIRV_LOADS = 1, /* atomics load and store */
    SPIRV_STORES = 2,
};

/* A global variable of the module. */
struct spirv_variable {
    const char *name; /* else that of its block type, else "?"; borrowed from the module */
    uint32_t storage; /* SpvStorageClass */
    uint32_t type;    /* id of the type pointed to */
    uint32_t binding, set, location; /* SPIRV_NONE if there is none */
    uint32_t id;
    /* SPIRV_LOADS and SPIRV_STORES, by any function of the module. A pointer that cannot be
     * followed counts as both, except for what NonReadable and NonWritable exclude */
    uint32_t access;
    VkDescriptorType descriptor; /* VK_DESCRIPTOR_TYPE_MAX_ENUM if it is none */
    uint32_t descriptor_count;   /* array length: 1 for a single descriptor, 0 if unknown */
    bool used;                   /* referenced by the entry point's instructions */
    bool in_interface;           /* listed by the entry point */
};

struct spirv_image {
    uint32_t dim, format; /* SPIR-V Image Format; 0 if unknown */
    uint32_t depth;       /* 1: compares depths, 0: does not, 2: unknown */
    char component;       /* as rg_spirv_component() returns */
    bool arrayed, multisampled;
};

/* Parsed SPIR-V module. Initialise with {0}. Its arrays are reused when another module is read. */
struct spirv {
    const struct rg_shader *shader;
    struct spirv_variable *variables;
    uint32_t variable_count;
    struct spirv_id *ids; /* opaque, as is the rest */
    uint32_t id_room, variable_room;
    bool has_storage;    /* declares storage variables */
    bool passes_storage; /* passes pointers to them, or images, to functions */
};

/* Parses the entry point `main` of a stage and its variables. Returns NULL, or an error message.
 * After an error, or if out of memory, the functions below must not be called. */
const char *rg_spirv_read(struct spirv *s, struct arena *arena, const struct rg_shader *shader,
                          VkShaderStageFlagBits stage);

/* Returns the unpadded size in bytes of a struct, or of an array's struct; 0 for other types. */
uint32_t rg_spirv_struct_size(const struct spirv *s, uint32_t type);

/* Describes an image, sampled image or array of these in *image. Returns false for other types. */
bool rg_spirv_image(const struct spirv *s, uint32_t type, struct spirv_image *image);

/* Returns the component type of a scalar or vector: 'f' for float, 'i' or 'u' for integers of at
 * most 32 bits, else '?'. Sets *count to the number of components; `count` may be NULL. */
char rg_spirv_component(const struct spirv *s, uint32_t type, uint32_t *count);

/* Returns the number of locations that an input or output of this type occupies. */
uint32_t rg_spirv_locations(const struct spirv *s, uint32_t type);

#endif
