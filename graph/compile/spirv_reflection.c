/* spirv_reflection.c: SPIR-V parser that derives a shader's interface. */
#include "graph/compile/spirv_reflection.h"
#include <string.h>

enum {
    OP_NAME = 5,
    OP_MEMBER_NAME = 6,
    OP_ENTRY_POINT = 15,
    OP_TYPE_BOOL = 20,
    OP_TYPE_INT = 21,
    OP_TYPE_FLOAT = 22,
    OP_TYPE_VECTOR = 23,
    OP_TYPE_MATRIX = 24,
    OP_TYPE_IMAGE = 25,
    OP_TYPE_SAMPLER = 26,
    OP_TYPE_SAMPLED_IMAGE = 27,
    OP_TYPE_ARRAY = 28,
    OP_TYPE_RUNTIME_ARRAY = 29,
    OP_TYPE_STRUCT = 30,
    OP_TYPE_POINTER = 32,
    OP_CONSTANT = 43,
    OP_SPEC_CONSTANT = 50,
    OP_FUNCTION = 54,
    OP_FUNCTION_PARAMETER = 55,
    OP_FUNCTION_CALL = 57,
    OP_VARIABLE = 59,
    OP_IMAGE_TEXEL_POINTER = 60,
    OP_LOAD = 61,
    OP_STORE = 62,
    OP_COPY_MEMORY = 63,
    OP_ACCESS_CHAIN = 65,
    OP_IN_BOUNDS_ACCESS_CHAIN = 66,
    OP_PTR_ACCESS_CHAIN = 67,
    OP_ARRAY_LENGTH = 68,
    OP_DECORATE = 71,
    OP_MEMBER_DECORATE = 72,
    OP_COPY_OBJECT = 83,
    OP_IMAGE_READ = 98,
    OP_IMAGE_WRITE = 99,
    OP_SELECT = 169,
    OP_ATOMIC_LOAD = 227,
    OP_ATOMIC_STORE = 228,
    OP_ATOMIC_XOR = 242,
    OP_PHI = 245,
    OP_RETURN_VALUE = 254,
    OP_IMAGE_SPARSE_READ = 320,
    OP_TYPE_ACCELERATION_STRUCTURE = 5341,
    OP_ATOMIC_FLOAT_MIN = 5614,
    OP_ATOMIC_FLOAT_MAX = 5615,
    OP_ATOMIC_FLOAT_ADD = 6035,
    DECORATION_BUFFER_BLOCK = 3,
    DECORATION_ROW_MAJOR = 4,
    DECORATION_ARRAY_STRIDE = 6,
    DECORATION_MATRIX_STRIDE = 7,
    DECORATION_NON_WRITABLE = 24,
    DECORATION_NON_READABLE = 25,
    DECORATION_LOCATION = 30,
    DECORATION_BINDING = 33,
    DECORATION_SET = 34,
    DECORATION_OFFSET = 35,
    DIM_SUBPASS = 6,
    STORAGE_FUNCTION = 7, /* storage class of local variables */
    HEADER_WORDS = 5,
    MAGIC = 0x07230203,
    VERSION_1_4 = 0x00010400, /* entry points list all globals */
    MAX_DEPTH = 16,           /* nesting of types */
    MAX_CALLS = 64,           /* nesting of calls */
};

/* Parsed properties of a SPIR-V id. `definition` and `name` are word indices; 0 means none. */
struct spirv_id {
    uint32_t definition; /* word index of the defining instruction */
    uint32_t name;
    uint32_t stride;                 /* of an array in bytes */
    uint32_t binding, set, location; /* decorations plus 1; 0: not decorated */
    uint32_t variable;               /* `variables` index plus 1, or 0 */
    uint32_t root;              /* base variable or parameter of a pointer or image; 0 if none */
    uint16_t unread, unwritten; /* of a struct: members that are NonReadable, NonWritable */
    uint8_t access, denied;     /* of a root: SPIRV_LOADS, SPIRV_STORES; `denied` by decorations */
    bool buffer_block, in_interface;
};

/* An instruction; its first word holds the opcode and the word count. */
struct instruction {
    uint32_t op, count;
    const uint32_t *words;
};

/* Advances `in`, initially zero, to the next instruction. Returns false at the end or on error. */
static inline bool next(const struct rg_shader *shader, struct instruction *in)
{
    const uint32_t *end = shader->words + shader->word_count;
    in->words = in->words ? in->words + in->count : shader->words + HEADER_WORDS;
    if (in->words >= end)
        return false;
    in->op = in->words[0] & 0xffff;
    in->count = in->words[0] >> 16;
    return in->count && in->count <= (size_t)(end - in->words);
}

static struct spirv_id *find_id(const struct spirv *s, uint32_t id)
{
    return id < s->shader->words[3] ? &s->ids[id] : NULL;
}

/* Returns the string at a word of an instruction; NULL if it is unterminated. */
static const char *text_of(const struct instruction *in, uint32_t word)
{
    if (in->count <= word || !memchr(&in->words[word], 0, (in->count - word) * sizeof(uint32_t)))
        return NULL;
    return (const char *)&in->words[word];
}

/* ---- types ---- */

/* Returns an id's definition if its opcode is `op` and it has at least `count` words, else NULL. */
static const uint32_t *definition(const struct spirv *s, uint32_t id, uint32_t op, uint32_t count)
{
    const struct spirv_id *i = find_id(s, id);
    const uint32_t *words = i && i->definition ? &s->shader->words[i->definition] : NULL;
    return words && (words[0] & 0xffff) == op && words[0] >> 16 >= count ? words : NULL;
}

const char *rg_spirv_struct(const struct spirv *s, uint32_t type, uint32_t *member_count)
{
    const uint32_t *words = definition(s, type, OP_TYPE_STRUCT, 2);
    *member_count = words ? (words[0] >> 16) - 2 : 0;
    if (!words)
        return NULL;
    return s->ids[type].name ? (const char *)&s->shader->words[s->ids[type].name] : "";
}

/* Returns the length and the element type of an array type; length 0 for all other types. */
static uint32_t array_length(const struct spirv *s, uint32_t type, uint32_t *element)
{
    const uint32_t *array = definition(s, type, OP_TYPE_ARRAY, 4);
    const uint32_t *length = array ? definition(s, array[3], OP_CONSTANT, 4) : NULL;
    if (array && !length)
        length = definition(s, array[3], OP_SPEC_CONSTANT, 4);
    *element = array ? array[2] : SPIRV_NONE;
    return length ? length[3] : 0;
}

/* Memory layout of a struct member. */
struct member_layout {
    uint32_t offset, stride; /* bytes; `stride` between matrix columns/rows */
    bool row_major;
    const char *name;
};

static struct member_layout member_layout_of(const struct spirv *s, uint32_t type, uint32_t index)
{
    struct member_layout layout = { .offset = SPIRV_NONE, .name = "" };
    struct instruction in = { 0 };
    while (next(s->shader, &in) && in.op != OP_FUNCTION) {
        if (in.count < 4 || in.words[1] != type || in.words[2] != index)
            continue;
        if (in.op == OP_MEMBER_NAME && text_of(&in, 3))
            layout.name = text_of(&in, 3);
        if (in.op != OP_MEMBER_DECORATE)
            continue;
        if (in.words[3] == DECORATION_ROW_MAJOR)
            layout.row_major = true;
        if (in.words[3] == DECORATION_OFFSET && in.count > 4)
            layout.offset = in.words[4];
        if (in.words[3] == DECORATION_MATRIX_STRIDE && in.count > 4)
            layout.stride = in.words[4];
    }
    return layout;
}

static uint32_t struct_size(const struct spirv *s, uint32_t type, uint32_t depth);

/* Returns a type's size in bytes without trailing padding; may wrap around for malformed types. */
static uint32_t size_of(const struct spirv *s, uint32_t type, const struct member_layout *layout,
                        uint32_t depth)
{
    uint32_t count, element;
    const uint32_t *words = definition(s, type, OP_TYPE_MATRIX, 4);
    if (depth == MAX_DEPTH)
        return 0;
    if (words) {
        rg_spirv_component(s, words[2], &count);
        return (layout->row_major ? count : words[3]) * layout->stride;
    }
    if ((words = definition(s, type, OP_TYPE_VECTOR, 4)))
        return words[3] * size_of(s, words[2], layout, depth + 1);
    count = array_length(s, type, &element);
    if (count)
        return count *
               (s->ids[type].stride ? s->ids[type].stride : size_of(s, element, layout, depth + 1));
    if ((words = definition(s, type, OP_TYPE_INT, 4)) ||
        (words = definition(s, type, OP_TYPE_FLOAT, 3)))
        return words[2] / 8;
    return struct_size(s, type, depth + 1);
}

/* Returns the index of the struct member with the largest offset. */
static uint32_t last_member(const struct spirv *s, uint32_t type)
{
    uint32_t last = 0;
    uint32_t most = 0;
    struct instruction in = { 0 };
    while (next(s->shader, &in) && in.op != OP_FUNCTION) {
        if (in.op == OP_MEMBER_DECORATE && in.count > 4 && in.words[1] == type &&
            in.words[3] == DECORATION_OFFSET && in.words[4] >= most) {
            last = in.words[2];
            most = in.words[4];
        }
    }
    return last;
}

static uint32_t struct_size(const struct spirv *s, uint32_t type, uint32_t depth)
{
    const uint32_t *words = definition(s, type, OP_TYPE_STRUCT, 3);
    uint32_t last = words ? last_member(s, type) : 0;
    if (!words || last >= (words[0] >> 16) - 2)
        return 0;
    const struct member_layout layout = member_layout_of(s, type, last);
    return (layout.offset == SPIRV_NONE ? 0 : layout.offset) +
           size_of(s, words[2 + last], &layout, depth);
}

/* Returns the element type of an array type; any other type unchanged. */
static uint32_t element_of(const struct spirv *s, uint32_t type)
{
    const uint32_t *array = definition(s, type, OP_TYPE_RUNTIME_ARRAY, 3);
    if (!array)
        array = definition(s, type, OP_TYPE_ARRAY, 4);
    return array ? array[2] : type;
}

uint32_t rg_spirv_struct_size(const struct spirv *s, uint32_t type)
{
    return struct_size(s, element_of(s, type), 0);
}

struct spirv_member rg_spirv_member(const struct spirv *s, uint32_t type, uint32_t index)
{
    const uint32_t *words = definition(s, type, OP_TYPE_STRUCT, 3 + index);
    if (!words)
        return (struct spirv_member){ .name = "", .offset = SPIRV_NONE };
    const struct member_layout layout = member_layout_of(s, type, index);
    return (struct spirv_member){ layout.name, words[2 + index], layout.offset,
                                  size_of(s, words[2 + index], &layout, 0) };
}

bool rg_spirv_image(const struct spirv *s, uint32_t type, struct spirv_image *image)
{
    type = element_of(s, type);
    const uint32_t *sampled = definition(s, type, OP_TYPE_SAMPLED_IMAGE, 3);
    const uint32_t *words = definition(s, sampled ? sampled[2] : type, OP_TYPE_IMAGE, 9);
    if (!words)
        return false;
    *image = (struct spirv_image){
        .dim = words[3],
        .format = words[8],
        .depth = words[4],
        .component = rg_spirv_component(s, words[2], NULL),
        .arrayed = words[5],
        .multisampled = words[6],
    };
    return true;
}

char rg_spirv_component(const struct spirv *s, uint32_t type, uint32_t *count)
{
    const uint32_t *vector = definition(s, type, OP_TYPE_VECTOR, 4);
    uint32_t scalar = vector ? vector[2] : type;
    const uint32_t *integer = definition(s, scalar, OP_TYPE_INT, 4);
    const uint32_t *real = definition(s, scalar, OP_TYPE_FLOAT, 3);
    if (count)
        *count = vector ? vector[3] : 1;
    if (integer && integer[2] <= 32)
        return integer[3] ? 'i' : 'u';
    return real && real[2] <= 32 ? 'f' : '?';
}

static uint32_t locations(const struct spirv *s, uint32_t type, uint32_t depth)
{
    uint32_t element, count;
    const uint32_t *words = definition(s, type, OP_TYPE_MATRIX, 4);
    if (words || depth == MAX_DEPTH)
        return words ? words[3] : 1;
    count = array_length(s, type, &element);
    if (count)
        return count * locations(s, element, depth + 1);
    if (!(words = definition(s, type, OP_TYPE_STRUCT, 3)))
        return 1;
    for (uint32_t i = 0; i < (words[0] >> 16) - 2 && i < 64; i++)
        /* limits recursion: nested structs are rare */
        count += locations(s, words[2 + i], depth + 8);
    return count;
}

uint32_t rg_spirv_locations(const struct spirv *s, uint32_t type)
{
    return locations(s, type, 0);
}

VkDescriptorType rg_spirv_descriptor(const struct spirv *s, const struct spirv_variable *v,
                                     uint32_t *count)
{
    uint32_t type = element_of(s, v->type);
    const uint32_t *fixed = definition(s, v->type, OP_TYPE_ARRAY, 4);
    const uint32_t *length = fixed ? definition(s, fixed[3], OP_CONSTANT, 4) : NULL;
    *count = length ? length[3] : type == v->type ? 1 : 0;
    if (v->storage == SPIRV_STORAGE_BUFFER)
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    if (v->storage == SPIRV_UNIFORM)
        return type < s->shader->words[3] && s->ids[type].buffer_block
                   ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                   : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    if (v->storage != SPIRV_UNIFORM_CONSTANT)
        return VK_DESCRIPTOR_TYPE_MAX_ENUM;
    if (definition(s, type, OP_TYPE_SAMPLER, 2))
        return VK_DESCRIPTOR_TYPE_SAMPLER;
    if (definition(s, type, OP_TYPE_ACCELERATION_STRUCTURE, 2))
        return VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    struct spirv_image image;
    if (!rg_spirv_image(s, type, &image))
        return VK_DESCRIPTOR_TYPE_MAX_ENUM;
    const uint32_t *plain = definition(s, type, OP_TYPE_IMAGE, 9);
    bool storage = plain && plain[7] == 2;
    if (image.dim == SPIRV_DIM_BUFFER)
        return storage ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                       : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    if (image.dim == DIM_SUBPASS)
        return VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
    return storage ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
           : plain ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE
                   : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

const char *rg_spirv_name(const struct spirv *s, const struct spirv_variable *v)
{
    uint32_t count;
    const char *block = v->name[0] ? v->name : rg_spirv_struct(s, element_of(s, v->type), &count);
    return block && block[0] ? block : "?";
}

/* ---- parsing ---- */

/* Parses an entry point. Returns true if it is `main` of execution model `model`. */
static bool is_main(struct spirv *s, const struct instruction *in, uint32_t model)
{
    const char *name = text_of(in, 3);
    if (!name || in->words[1] != model || strcmp(name, "main") != 0)
        return false;
    for (uint32_t i = 3 + (uint32_t)strlen(name) / 4 + 1; i < in->count; i++) {
        struct spirv_id *id = find_id(s, in->words[i]);
        if (id)
            id->in_interface = true;
    }
    return true;
}

static void decorate(struct spirv *s, const struct instruction *in)
{
    struct spirv_id *id = in->count > 2 ? find_id(s, in->words[1]) : NULL;
    const uint32_t kind = in->count > 2 ? in->words[2] : 0;
    const uint32_t value = in->count > 3 ? in->words[3] : 0;
    if (!id)
        return;
    if (kind == DECORATION_NON_WRITABLE)
        id->denied |= SPIRV_STORES;
    if (kind == DECORATION_NON_READABLE)
        id->denied |= SPIRV_LOADS;
    if (kind == DECORATION_BUFFER_BLOCK)
        id->buffer_block = true;
    if (kind == DECORATION_ARRAY_STRIDE)
        id->stride = value;
    uint32_t *number = kind == DECORATION_BINDING    ? &id->binding
                       : kind == DECORATION_SET      ? &id->set
                       : kind == DECORATION_LOCATION ? &id->location
                                                     : NULL;
    if (number)
        *number = value + 1;
}

/* Returns the word index of an instruction's result id, or 0 if the parser ignores the result. */
static uint32_t result_word(uint32_t op)
{
    if (op == OP_VARIABLE || op == OP_CONSTANT || op == OP_SPEC_CONSTANT)
        return 2;
    bool type = (op >= OP_TYPE_BOOL && op <= OP_TYPE_STRUCT) || op == OP_TYPE_POINTER ||
                op == OP_TYPE_ACCELERATION_STRUCTURE;
    return type ? 1 : 0;
}

static void add_variable(struct spirv *s, struct arena *arena, const struct instruction *in,
                         struct spirv_id *id)
{
    const uint32_t *pointer = definition(s, in->words[1], OP_TYPE_POINTER, 4);
    uint32_t count;
    if (in->count < 4 || !pointer || id->variable ||
        !ARENA_ROOM(arena, s->variables, s->variable_count, s->variable_room, 32))
        return;
    struct spirv_variable *v = &s->variables[s->variable_count];
    *v = (struct spirv_variable){
        .name = id->name ? (const char *)&s->shader->words[id->name] : "",
        .storage = in->words[3],
        .type = pointer[3],
        .binding = id->binding - 1, /* 0 becomes SPIRV_NONE */
        .set = id->set - 1,
        .location = id->location - 1,
        .id = in->words[2],
        .in_interface = id->in_interface,
    };
    id->variable = ++s->variable_count;
    VkDescriptorType type = rg_spirv_descriptor(s, v, &count);
    if (type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER || type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE ||
        type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER)
        id->root = v->id;
    s->has_storage = s->has_storage || id->root;
}

/* Parses an instruction outside functions. */
static void declare(struct spirv *s, struct arena *arena, const struct instruction *in)
{
    uint32_t result = result_word(in->op);
    struct spirv_id *id;
    if (in->op == OP_DECORATE)
        decorate(s, in);
    if (in->op == OP_MEMBER_DECORATE && in->count > 3 && (id = find_id(s, in->words[1]))) {
        id->unread = (uint16_t)(id->unread + (in->words[3] == DECORATION_NON_READABLE));
        id->unwritten = (uint16_t)(id->unwritten + (in->words[3] == DECORATION_NON_WRITABLE));
    }
    if (in->op == OP_NAME && text_of(in, 2) && (id = find_id(s, in->words[1])))
        id->name = (uint32_t)(&in->words[2] - s->shader->words);
    if (!result || in->count <= result || !(id = find_id(s, in->words[result])))
        return;
    id->definition = (uint32_t)(in->words - s->shader->words);
    if (in->op == OP_VARIABLE)
        add_variable(s, arena, in, id);
}

/* ---- instructions of functions ---- */

enum {
    BOTH = SPIRV_LOADS | SPIRV_STORES, /* also assumed if the base of a pointer is unknown */
    DERIVES = 4,                       /* the result points into what the operand points to */
    PASSES = 8,                        /* argument of a call: as its parameter */
    ALL_OPERANDS = UINT8_MAX,
};

/* Operands of an instruction that may be pointers or storage images. */
struct operand_rule {
    uint8_t first, count; /* words */
    uint8_t access[2];    /* access of the first operand, and of the others */
};

static const struct operand_rule operand_rules[OP_IMAGE_SPARSE_READ + 1] = {
    [OP_FUNCTION_CALL] = { 4, ALL_OPERANDS, { PASSES, PASSES } },
    [OP_IMAGE_TEXEL_POINTER] = { 3, 1, { DERIVES } },
    [OP_LOAD] = { 3, 1, { SPIRV_LOADS } },
    [OP_STORE] = { 1, 2, { SPIRV_STORES, BOTH } },
    [OP_COPY_MEMORY] = { 1, 2, { SPIRV_STORES, SPIRV_LOADS } },
    [OP_ACCESS_CHAIN] = { 3, 1, { DERIVES } },
    [OP_IN_BOUNDS_ACCESS_CHAIN] = { 3, 1, { DERIVES } },
    [OP_PTR_ACCESS_CHAIN] = { 3, 1, { DERIVES } },
    [OP_ARRAY_LENGTH] = { 3, 1, { 0 } },
    [OP_COPY_OBJECT] = { 3, 1, { DERIVES } },
    [OP_IMAGE_READ] = { 3, 1, { SPIRV_LOADS } },
    [OP_IMAGE_WRITE] = { 1, 1, { SPIRV_STORES } },
    [OP_SELECT] = { 3, ALL_OPERANDS, { BOTH, BOTH } },
    [OP_ATOMIC_LOAD] = { 3, 1, { SPIRV_LOADS } },
    [OP_ATOMIC_STORE] = { 1, 1, { SPIRV_STORES } },
    [OP_PHI] = { 3, ALL_OPERANDS, { BOTH, BOTH } },
    [OP_RETURN_VALUE] = { 1, 1, { BOTH } },
    [OP_IMAGE_SPARSE_READ] = { 3, 1, { SPIRV_LOADS } },
};

static struct operand_rule operand_rule_of(uint32_t op)
{
    if ((op > OP_ATOMIC_STORE && op <= OP_ATOMIC_XOR) || op == OP_ATOMIC_FLOAT_MIN ||
        op == OP_ATOMIC_FLOAT_MAX || op == OP_ATOMIC_FLOAT_ADD)
        return (struct operand_rule){ 3, 1, { BOTH } };
    return op <= OP_IMAGE_SPARSE_READ ? operand_rules[op] : (struct operand_rule){ 0 };
}

/* Adds an access to `root`, the base variable or parameter of an operand. */
static void add_access(struct spirv *s, const struct instruction *in, uint32_t root,
                       uint32_t access)
{
    struct spirv_id *result = in->count > 2 ? find_id(s, in->words[2]) : NULL;
    if (access == PASSES)
        s->passes_storage = s->passes_storage || s->ids[root].variable;
    else if (access != DERIVES &&
             !(in->op == OP_LOAD && definition(s, in->words[1], OP_TYPE_IMAGE, 9)))
        s->ids[root].access = (uint8_t)(s->ids[root].access | access);
    else if (result)
        result->root = root;
}

/* Marks the variables that an instruction accesses as used, and records loads and stores. */
static void trace(struct spirv *s, const struct instruction *in, bool all_listed)
{
    const struct operand_rule rule = operand_rule_of(in->op);
    const uint32_t *pointer = NULL;
    struct spirv_id *id;
    if (in->op == OP_FUNCTION_PARAMETER && in->count > 2 && s->has_storage)
        pointer = definition(s, in->words[1], OP_TYPE_POINTER, 4);
    if (pointer && pointer[2] != STORAGE_FUNCTION && (id = find_id(s, in->words[2])))
        id->root = in->words[2];
    for (uint32_t i = 0; i < rule.count && rule.first + i < in->count; i++) {
        id = find_id(s, in->words[rule.first + i]);
        if (id && id->variable && (!all_listed || id->in_interface))
            s->variables[id->variable - 1].used = true;
        if (id && id->root)
            add_access(s, in, id->root, rule.access[i > 0]);
    }
}

/* Returns the parameter of a function that receives argument `index`; NULL if there is none. */
static const struct spirv_id *parameter(const struct spirv *s, uint32_t function, uint32_t index)
{
    const uint32_t *words = definition(s, function, OP_FUNCTION, 5);
    struct instruction in = { OP_FUNCTION, 5, words };
    while (words && next(s->shader, &in) && in.op == OP_FUNCTION_PARAMETER && in.count > 2) {
        if (!index--)
            return find_id(s, in.words[2]);
    }
    return NULL;
}

/* Propagates the accesses of functions to their parameters to the arguments of calls. Returns true
 * if that adds an access. */
static bool trace_calls(struct spirv *s)
{
    bool changed = false;
    struct instruction in = { 0 };
    while (next(s->shader, &in)) {
        for (uint32_t i = 4; in.op == OP_FUNCTION_CALL && i < in.count; i++) {
            const struct spirv_id *given = find_id(s, in.words[i]);
            if (!given || !given->root)
                continue;
            const struct spirv_id *to = parameter(s, in.words[3], i - 4);
            const uint32_t access = to ? to->access : SPIRV_LOADS | SPIRV_STORES;
            changed = changed || access & ~(uint32_t)s->ids[given->root].access;
            add_access(s, &in, given->root, access);
        }
    }
    return changed;
}

/* Sets what the module does to each storage variable, once all instructions are known. */
static void find_accesses(struct spirv *s)
{
    uint32_t count;
    for (uint32_t depth = 0; s->passes_storage && depth < MAX_CALLS && trace_calls(s); depth++)
        continue;
    for (uint32_t i = 0; i < s->variable_count; i++) {
        struct spirv_variable *v = &s->variables[i];
        const struct spirv_id *id = &s->ids[v->id];
        const struct spirv_id *type = find_id(s, element_of(s, v->type));
        if (!id->root)
            continue;
        uint32_t denied = id->denied;
        if (type && rg_spirv_struct(s, element_of(s, v->type), &count))
            denied |= (type->unread == count ? (uint32_t)SPIRV_LOADS : 0) |
                      (type->unwritten == count ? (uint32_t)SPIRV_STORES : 0);
        v->access = id->access & ~denied;
    }
}

const char *rg_spirv_read(struct spirv *s, struct arena *arena, const struct rg_shader *shader,
                          VkShaderStageFlagBits stage)
{
    const uint32_t model = stage == VK_SHADER_STAGE_VERTEX_BIT     ? 0
                           : stage == VK_SHADER_STAGE_FRAGMENT_BIT ? 4
                                                                   /* execution model GLCompute */
                                                                   : 5;
    bool found = false;
    bool in_function = false;
    s->shader = shader;
    s->variable_count = 0;
    s->has_storage = s->passes_storage = false;
    if (shader->word_count <= HEADER_WORDS || shader->words[0] != MAGIC ||
        shader->words[3] > shader->word_count)
        return "expected a SPIR-V module in native byte order";
    const uint32_t bound = shader->words[3];
    if (bound > s->id_room) {
        s->ids = ARENA_ARRAY(arena, struct spirv_id, bound);
        s->id_room = bound;
    }
    if (arena->failed)
        return NULL;
    if (bound)
        memset(s->ids, 0, bound * sizeof(*s->ids));
    struct instruction in = { 0 };
    while (next(shader, &in)) {
        in_function = in_function || in.op == OP_FUNCTION;
        if (in.op == OP_FUNCTION && in.count > 4 && find_id(s, in.words[2]))
            find_id(s, in.words[2])->definition = (uint32_t)(in.words - shader->words);
        if (in_function) {
            trace(s, &in, shader->words[1] >= VERSION_1_4);
        } else if (in.op == OP_ENTRY_POINT) {
            found = is_main(s, &in, model) || found;
        } else {
            declare(s, arena, &in);
        }
    }
    if (in.words != shader->words + shader->word_count)
        return "expected complete SPIR-V instructions up to the end";
    if (s->has_storage)
        find_accesses(s);
    return found ? NULL : "expected an entry point 'main' of this stage";
}
