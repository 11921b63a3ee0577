/* spirv_reflection.c: SPIR-V parser that derives a shader's interface. */
#include "graph/compile/spirv_reflection.h"
#include <string.h>

enum {
    HEADER_WORDS = 5,
    VERSION_1_4 = 0x00010400, /* entry points list all globals */
    MAX_DEPTH = 16,           /* nesting of types */
    MAX_CALLS = 64,           /* nesting of calls */
    MAX_BOUND = 0x3fffff,     /* of ids, which may be sparse: SPIR-V's universal limit */
};

/* Parsed properties of a SPIR-V id. `definition` and `name` are word indices; 0 means none. */
struct spirv_id {
    uint32_t definition; /* word index of the defining instruction */
    uint32_t name;
    uint32_t stride;                 /* of an array in bytes */
    uint32_t binding, set, location; /* decorations plus 1; 0: not decorated */
    uint32_t variable;               /* `variables` index plus 1, or 0 */
    uint32_t root; /* base variable or parameter of a pointer or image; 0 if none */
    uint32_t last_member, last_offset; /* of a struct: member with the largest offset */
    uint16_t unread, unwritten;        /* of a struct: members that are NonReadable, NonWritable */
    uint8_t access, denied; /* of a root: SPIRV_LOADS, SPIRV_STORES; `denied` by decorations */
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

/* Returns the length and the element type of an array type; length 0 for all other types. */
static uint32_t array_length(const struct spirv *s, uint32_t type, uint32_t *element)
{
    const uint32_t *array = definition(s, type, SpvOpTypeArray, 4);
    const uint32_t *length = array ? definition(s, array[3], SpvOpConstant, 4) : NULL;
    if (array && !length)
        length = definition(s, array[3], SpvOpSpecConstant, 4);
    *element = array ? array[2] : SPIRV_NONE;
    return length ? length[3] : 0;
}

/* Memory layout of a matrix in a struct. */
struct matrix_layout {
    uint32_t stride; /* of a matrix (MatrixStride), bytes */
    bool row_major;
};

/* Returns the matrix layout of the struct member with the largest offset. */
static struct matrix_layout last_layout(const struct spirv *s, uint32_t type)
{
    struct matrix_layout layout = { 0 };
    struct instruction in = { 0 };
    while (next(s->shader, &in) && in.op != SpvOpFunction) {
        if (in.op != SpvOpMemberDecorate || in.count < 4 || in.words[1] != type ||
            in.words[2] != s->ids[type].last_member)
            continue;
        layout.row_major = layout.row_major || in.words[3] == SpvDecorationRowMajor;
        if (in.words[3] == SpvDecorationMatrixStride && in.count > 4)
            layout.stride = in.words[4];
    }
    return layout;
}

static uint32_t struct_size(const struct spirv *s, uint32_t type, uint32_t depth);

/* Returns a type's size in bytes without trailing padding; may wrap around for malformed types. */
static uint32_t size_of(const struct spirv *s, uint32_t type, const struct matrix_layout *layout,
                        uint32_t depth)
{
    uint32_t count, element;
    const uint32_t *words = definition(s, type, SpvOpTypeMatrix, 4);
    if (depth == MAX_DEPTH)
        return 0;
    if (words) {
        rg_spirv_component(s, words[2], &count);
        return (layout->row_major ? count : words[3]) * layout->stride;
    }
    if ((words = definition(s, type, SpvOpTypeVector, 4)))
        return words[3] * size_of(s, words[2], layout, depth + 1);
    count = array_length(s, type, &element);
    if (count)
        return count *
               (s->ids[type].stride ? s->ids[type].stride : size_of(s, element, layout, depth + 1));
    if ((words = definition(s, type, SpvOpTypeInt, 4)) ||
        (words = definition(s, type, SpvOpTypeFloat, 3)))
        return words[2] / 8;
    return struct_size(s, type, depth + 1);
}

static uint32_t struct_size(const struct spirv *s, uint32_t type, uint32_t depth)
{
    const uint32_t *words = definition(s, type, SpvOpTypeStruct, 3);
    const struct spirv_id *id = words ? &s->ids[type] : NULL;
    if (!id || id->last_member >= (words[0] >> 16) - 2)
        return 0;
    const struct matrix_layout layout = last_layout(s, type);
    return id->last_offset + size_of(s, words[2 + id->last_member], &layout, depth);
}

/* Returns the element type of an array type; any other type unchanged. */
static uint32_t element_of(const struct spirv *s, uint32_t type)
{
    const uint32_t *array = definition(s, type, SpvOpTypeRuntimeArray, 3);
    if (!array)
        array = definition(s, type, SpvOpTypeArray, 4);
    return array ? array[2] : type;
}

uint32_t rg_spirv_struct_size(const struct spirv *s, uint32_t type)
{
    return struct_size(s, element_of(s, type), 0);
}

bool rg_spirv_image(const struct spirv *s, uint32_t type, struct spirv_image *image)
{
    type = element_of(s, type);
    const uint32_t *sampled = definition(s, type, SpvOpTypeSampledImage, 3);
    const uint32_t *words = definition(s, sampled ? sampled[2] : type, SpvOpTypeImage, 9);
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
    const uint32_t *vector = definition(s, type, SpvOpTypeVector, 4);
    uint32_t scalar = vector ? vector[2] : type;
    const uint32_t *integer = definition(s, scalar, SpvOpTypeInt, 4);
    const uint32_t *real = definition(s, scalar, SpvOpTypeFloat, 3);
    if (count)
        *count = vector ? vector[3] : 1;
    if (integer && integer[2] <= 32)
        return integer[3] ? 'i' : 'u';
    return real && real[2] <= 32 ? 'f' : '?';
}

static uint32_t locations(const struct spirv *s, uint32_t type, uint32_t depth)
{
    uint32_t element, count;
    const uint32_t *words = definition(s, type, SpvOpTypeMatrix, 4);
    if (words || depth == MAX_DEPTH)
        return words ? words[3] : 1;
    count = array_length(s, type, &element);
    if (count)
        return count * locations(s, element, depth + 1);
    if (!(words = definition(s, type, SpvOpTypeStruct, 3)))
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

/* Returns the type of the descriptor of a global variable in storage class `storage`, if its type
 * without arrays is `type`, or VK_DESCRIPTOR_TYPE_MAX_ENUM if it is no descriptor. */
static VkDescriptorType descriptor_of(const struct spirv *s, uint32_t storage, uint32_t type)
{
    if (storage == SpvStorageClassStorageBuffer)
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    if (storage == SpvStorageClassUniform)
        return type < s->shader->words[3] && s->ids[type].buffer_block
                   ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                   : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    if (storage != SpvStorageClassUniformConstant)
        return VK_DESCRIPTOR_TYPE_MAX_ENUM;
    if (definition(s, type, SpvOpTypeSampler, 2))
        return VK_DESCRIPTOR_TYPE_SAMPLER;
    if (definition(s, type, SpvOpTypeAccelerationStructureKHR, 2))
        return VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    struct spirv_image image;
    if (!rg_spirv_image(s, type, &image))
        return VK_DESCRIPTOR_TYPE_MAX_ENUM;
    const uint32_t *plain = definition(s, type, SpvOpTypeImage, 9);
    bool is_storage = plain && plain[7] == 2;
    if (image.dim == SpvDimBuffer)
        return is_storage ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                          : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    if (image.dim == SpvDimSubpassData)
        return VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
    return is_storage ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
           : plain    ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE
                      : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
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
    if (kind == SpvDecorationNonWritable)
        id->denied |= SPIRV_STORES;
    if (kind == SpvDecorationNonReadable)
        id->denied |= SPIRV_LOADS;
    if (kind == SpvDecorationBufferBlock)
        id->buffer_block = true;
    if (kind == SpvDecorationArrayStride)
        id->stride = value;
    uint32_t *number = kind == SpvDecorationBinding         ? &id->binding
                       : kind == SpvDecorationDescriptorSet ? &id->set
                       : kind == SpvDecorationLocation      ? &id->location
                                                            : NULL;
    if (number)
        *number = value + 1;
}

/* Returns the word index of an instruction's result id, or 0 if the parser ignores the result. */
static uint32_t result_word(uint32_t op)
{
    if (op == SpvOpVariable || op == SpvOpConstant || op == SpvOpSpecConstant)
        return 2;
    return (op >= SpvOpTypeBool && op <= SpvOpTypeStruct) || op == SpvOpTypePointer ||
           op == SpvOpTypeAccelerationStructureKHR;
}

/* Returns the name of an id; "" if there is none. */
static const char *name_of(const struct spirv *s, uint32_t id)
{
    const struct spirv_id *i = find_id(s, id);
    return i && i->name ? (const char *)&s->shader->words[i->name] : "";
}

static void add_variable(struct spirv *s, struct arena *arena, const struct instruction *in,
                         struct spirv_id *id)
{
    const uint32_t *pointer = definition(s, in->words[1], SpvOpTypePointer, 4);
    if (in->count < 4 || !pointer || id->variable ||
        !ARENA_ROOM(arena, s->variables, s->variable_count, s->variable_room, 32))
        return;
    const uint32_t element = element_of(s, pointer[3]);
    const uint32_t *array = definition(s, pointer[3], SpvOpTypeArray, 4);
    const uint32_t *length = array ? definition(s, array[3], SpvOpConstant, 4) : NULL;
    const char *name = name_of(s, in->words[2]);
    const char *block = definition(s, element, SpvOpTypeStruct, 2) ? name_of(s, element) : "";
    struct spirv_variable *v = &s->variables[s->variable_count];
    *v = (struct spirv_variable){
        .name = *name    ? name
                : *block ? block
                         : "?",
        .storage = in->words[3],
        .type = pointer[3],
        .binding = id->binding - 1, /* 0 becomes SPIRV_NONE */
        .set = id->set - 1,
        .location = id->location - 1,
        .id = in->words[2],
        .descriptor = descriptor_of(s, in->words[3], element),
        .descriptor_count = length ? length[3] : element == pointer[3],
        .in_interface = id->in_interface,
    };
    id->variable = ++s->variable_count;
    if (v->descriptor == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ||
        v->descriptor == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE ||
        v->descriptor == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER)
        id->root = v->id;
    s->has_storage = s->has_storage || id->root;
}

/* Parses an instruction outside functions. */
static void declare(struct spirv *s, struct arena *arena, const struct instruction *in)
{
    uint32_t result = result_word(in->op);
    struct spirv_id *id;
    if (in->op == SpvOpDecorate)
        decorate(s, in);
    if (in->op == SpvOpMemberDecorate && in->count > 3 && (id = find_id(s, in->words[1]))) {
        id->unread = (uint16_t)(id->unread + (in->words[3] == SpvDecorationNonReadable));
        id->unwritten = (uint16_t)(id->unwritten + (in->words[3] == SpvDecorationNonWritable));
        if (in->words[3] == SpvDecorationOffset && in->count > 4 &&
            in->words[4] >= id->last_offset) {
            id->last_member = in->words[2];
            id->last_offset = in->words[4];
        }
    }
    if (in->op == SpvOpName && text_of(in, 2) && (id = find_id(s, in->words[1])))
        id->name = (uint32_t)(&in->words[2] - s->shader->words);
    if (!result || in->count <= result || !(id = find_id(s, in->words[result])))
        return;
    id->definition = (uint32_t)(in->words - s->shader->words);
    if (in->op == SpvOpVariable)
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

static const struct operand_rule operand_rules[SpvOpImageSparseRead + 1] = {
    [SpvOpFunctionCall] = { 4, ALL_OPERANDS, { PASSES, PASSES } },
    [SpvOpImageTexelPointer] = { 3, 1, { DERIVES } },
    [SpvOpLoad] = { 3, 1, { SPIRV_LOADS } },
    [SpvOpStore] = { 1, 2, { SPIRV_STORES, BOTH } },
    [SpvOpCopyMemory] = { 1, 2, { SPIRV_STORES, SPIRV_LOADS } },
    [SpvOpAccessChain] = { 3, 1, { DERIVES } },
    [SpvOpInBoundsAccessChain] = { 3, 1, { DERIVES } },
    [SpvOpPtrAccessChain] = { 3, 1, { DERIVES } },
    [SpvOpArrayLength] = { 3, 1, { 0 } },
    [SpvOpCopyObject] = { 3, 1, { DERIVES } },
    [SpvOpImageRead] = { 3, 1, { SPIRV_LOADS } },
    [SpvOpImageWrite] = { 1, 1, { SPIRV_STORES } },
    [SpvOpSelect] = { 3, ALL_OPERANDS, { BOTH, BOTH } },
    [SpvOpAtomicLoad] = { 3, 1, { SPIRV_LOADS } },
    [SpvOpAtomicStore] = { 1, 1, { SPIRV_STORES } },
    [SpvOpPhi] = { 3, ALL_OPERANDS, { BOTH, BOTH } },
    [SpvOpReturnValue] = { 1, 1, { BOTH } },
    [SpvOpImageSparseRead] = { 3, 1, { SPIRV_LOADS } },
};

static struct operand_rule operand_rule_of(uint32_t op)
{
    if ((op > SpvOpAtomicStore && op <= SpvOpAtomicXor) || op == SpvOpAtomicFMinEXT ||
        op == SpvOpAtomicFMaxEXT || op == SpvOpAtomicFAddEXT)
        return (struct operand_rule){ 3, 1, { BOTH } };
    return op <= SpvOpImageSparseRead ? operand_rules[op] : (struct operand_rule){ 0 };
}

/* Adds an access to `root`, the base variable or parameter of an operand. */
static void add_access(struct spirv *s, const struct instruction *in, uint32_t root,
                       uint32_t access)
{
    struct spirv_id *result = in->count > 2 ? find_id(s, in->words[2]) : NULL;
    if (access == PASSES)
        s->passes_storage = s->passes_storage || s->ids[root].variable;
    else if (access != DERIVES &&
             !(in->op == SpvOpLoad && definition(s, in->words[1], SpvOpTypeImage, 9)))
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
    if (in->op == SpvOpFunctionParameter && in->count > 2 && s->has_storage)
        pointer = definition(s, in->words[1], SpvOpTypePointer, 4);
    if (pointer && pointer[2] != SpvStorageClassFunction && (id = find_id(s, in->words[2])))
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
    const uint32_t *words = definition(s, function, SpvOpFunction, 5);
    struct instruction in = { SpvOpFunction, 5, words };
    while (words && next(s->shader, &in) && in.op == SpvOpFunctionParameter && in.count > 2) {
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
        for (uint32_t i = 4; in.op == SpvOpFunctionCall && i < in.count; i++) {
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
    for (uint32_t depth = 0; s->passes_storage && depth < MAX_CALLS && trace_calls(s); depth++)
        continue;
    for (uint32_t i = 0; i < s->variable_count; i++) {
        struct spirv_variable *v = &s->variables[i];
        const struct spirv_id *id = &s->ids[v->id];
        const uint32_t type = element_of(s, v->type);
        const uint32_t *block = definition(s, type, SpvOpTypeStruct, 2);
        const uint32_t count = block ? (block[0] >> 16) - 2 : 0;
        if (!id->root)
            continue;
        uint32_t denied = id->denied;
        if (block && s->ids[type].unread == count)
            denied |= SPIRV_LOADS;
        if (block && s->ids[type].unwritten == count)
            denied |= SPIRV_STORES;
        v->access = id->access & ~denied;
    }
}

const char *rg_spirv_read(struct spirv *s, struct arena *arena, const struct rg_shader *shader,
                          VkShaderStageFlagBits stage)
{
    const uint32_t model = stage == VK_SHADER_STAGE_VERTEX_BIT     ? SpvExecutionModelVertex
                           : stage == VK_SHADER_STAGE_FRAGMENT_BIT ? SpvExecutionModelFragment
                                                                   : SpvExecutionModelGLCompute;
    bool found = false, in_function = false;
    s->shader = shader;
    s->variable_count = 0;
    s->has_storage = s->passes_storage = false;
    if (shader->word_count <= HEADER_WORDS || shader->words[0] != SpvMagicNumber ||
        shader->words[3] > MAX_BOUND)
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
        in_function = in_function || in.op == SpvOpFunction;
        if (in.op == SpvOpFunction && in.count > 4 && find_id(s, in.words[2]))
            find_id(s, in.words[2])->definition = (uint32_t)(in.words - shader->words);
        if (in_function) {
            trace(s, &in, shader->words[1] >= VERSION_1_4);
        } else if (in.op == SpvOpEntryPoint) {
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
