/* spirv.c: reads a module's instructions into one table of what its ids are. */
#include "tests/support/spirv.h"

#include <stdlib.h>
#include <string.h>

enum {
    OP_NAME = 5,
    OP_MEMBER_NAME = 6,
    OP_TYPE_INT = 21,
    OP_TYPE_FLOAT = 22,
    OP_TYPE_VECTOR = 23,
    OP_TYPE_MATRIX = 24,
    OP_TYPE_IMAGE = 25,
    OP_TYPE_SAMPLED_IMAGE = 27,
    OP_TYPE_ARRAY = 28,
    OP_TYPE_STRUCT = 30,
    OP_TYPE_POINTER = 32,
    OP_CONSTANT = 43,
    OP_FUNCTION = 54,
    OP_FUNCTION_CALL = 57,
    OP_VARIABLE = 59,
    OP_LOAD = 61,
    OP_STORE = 62,
    OP_ACCESS_CHAIN = 65,
    OP_IN_BOUNDS_ACCESS_CHAIN = 66,
    OP_ARRAY_LENGTH = 68,
    OP_DECORATE = 71,
    OP_MEMBER_DECORATE = 72,
    OP_IMAGE_TEXEL_POINTER = 60,
    DECORATION_MATRIX_STRIDE = 7,
    DECORATION_LOCATION = 30,
    DECORATION_BINDING = 33,
    DECORATION_SET = 34,
    DECORATION_OFFSET = 35,
    HEADER_WORDS = 5,
    MAGIC = 0x07230203,
};

/* What an id is: the instruction that makes it. */
struct spirv_id {
    const uint32_t *made_by; /* NULL: none of those above */
    const char *name;
    uint32_t variable; /* index, or SPIRV_NONE */
};

/* An instruction: its opcode, and words, the first of which is opcode and count. */
struct instruction {
    uint32_t op, count;
    const uint32_t *words;
};

/* Steps to the next one; begin with {0}. False at the end, and at an impossible one. */
static bool next(const struct rg_shader *shader, struct instruction *in)
{
    const uint32_t *end = shader->words + shader->word_count;
    in->words = in->words ? in->words + in->count : shader->words + HEADER_WORDS;
    if (in->words >= end)
        return false;
    in->op = in->words[0] & 0xffff;
    in->count = in->words[0] >> 16;
    return in->count && in->count <= (uint32_t)(end - in->words);
}

static uint32_t bound(const struct rg_shader *shader)
{
    return shader->words[3];
}

static bool is_id(const struct rg_shader *shader, uint32_t id)
{
    return id < bound(shader);
}

/* Which word of an instruction is the id it makes; 0: none, or none of interest. */
static uint32_t result_word(uint32_t op)
{
    if (op == OP_VARIABLE || op == OP_CONSTANT)
        return 2;
    bool type = op == OP_TYPE_POINTER || op == OP_TYPE_STRUCT || op == OP_TYPE_SAMPLED_IMAGE ||
                op == OP_TYPE_ARRAY || (op >= OP_TYPE_INT && op <= OP_TYPE_IMAGE);
    return type ? 1 : 0;
}

static void find_ids(struct spirv *s)
{
    bool in_function = false;
    for (struct instruction in = { 0 }; next(s->shader, &in);) {
        in_function = in_function || in.op == OP_FUNCTION;
        uint32_t result = result_word(in.op);
        if (in.op == OP_NAME && in.count > 2 && is_id(s->shader, in.words[1]))
            s->ids[in.words[1]].name = (const char *)&in.words[2];
        if (in_function || !result || in.count <= result || !is_id(s->shader, in.words[result]))
            continue;
        struct spirv_id *id = &s->ids[in.words[result]];
        id->made_by = in.words;
        if (in.op != OP_VARIABLE || in.count < 4 || !is_id(s->shader, in.words[1]))
            continue;
        const uint32_t *pointer = s->ids[in.words[1]].made_by;
        id->variable = s->variable_count++;
        s->variables[id->variable] = (struct spirv_variable){
            .storage = in.words[3],
            .type = pointer ? pointer[3] : 0,
            .binding = SPIRV_NONE,
            .set = SPIRV_NONE,
            .location = SPIRV_NONE,
        };
    }
}

static struct spirv_variable *variable_of(const struct spirv *s, uint32_t id)
{
    if (!is_id(s->shader, id) || s->ids[id].variable == SPIRV_NONE)
        return NULL;
    return &s->variables[s->ids[id].variable];
}

static void use(const struct spirv *s, uint32_t id)
{
    struct spirv_variable *variable = variable_of(s, id);
    if (variable)
        variable->used = true;
}

static void follow(const struct spirv *s, const struct instruction *in)
{
    struct spirv_variable *decorated;
    switch (in->op) {
    case OP_DECORATE:
        decorated = variable_of(s, in->words[1]);
        if (!decorated || in->count < 4)
            break;
        if (in->words[2] == DECORATION_BINDING)
            decorated->binding = in->words[3];
        if (in->words[2] == DECORATION_SET)
            decorated->set = in->words[3];
        if (in->words[2] == DECORATION_LOCATION)
            decorated->location = in->words[3];
        break;
    case OP_STORE:
        use(s, in->words[1]);
        break;
    case OP_LOAD:
    case OP_ACCESS_CHAIN:
    case OP_IN_BOUNDS_ACCESS_CHAIN:
    case OP_ARRAY_LENGTH:
    case OP_IMAGE_TEXEL_POINTER:
        use(s, in->words[3]);
        break;
    case OP_FUNCTION_CALL:
        for (uint32_t i = 4; i < in->count; i++)
            use(s, in->words[i]);
        break;
    default:
        break;
    }
}

bool spirv_init(struct spirv *s, const struct rg_shader *shader)
{
    *s = (struct spirv){ .shader = shader };
    if (shader->word_count < HEADER_WORDS || shader->words[0] != MAGIC ||
        bound(shader) > shader->word_count)
        return false;
    s->ids = calloc(bound(shader), sizeof(*s->ids));
    s->variables = calloc(bound(shader), sizeof(*s->variables));
    if (!s->ids || !s->variables) {
        spirv_finish(s);
        return false;
    }
    for (uint32_t i = 0; i < bound(shader); i++)
        s->ids[i].variable = SPIRV_NONE;
    find_ids(s);
    for (struct instruction in = { 0 }; next(shader, &in);) {
        if (in.count > 3 || (in.op == OP_STORE && in.count > 2))
            follow(s, &in);
    }
    return true;
}

void spirv_finish(struct spirv *s)
{
    free(s->ids);
    free(s->variables);
    *s = (struct spirv){ 0 };
}

/* The instruction that makes a type, if it is this one. */
static const uint32_t *type_by(const struct spirv *s, uint32_t type, uint32_t op)
{
    const uint32_t *words = is_id(s->shader, type) ? s->ids[type].made_by : NULL;
    return words && (words[0] & 0xffff) == op ? words : NULL;
}

const char *spirv_struct(const struct spirv *s, uint32_t type, uint32_t *member_count)
{
    const uint32_t *words = type_by(s, type, OP_TYPE_STRUCT);
    *member_count = words ? (words[0] >> 16) - 2 : 0;
    if (!words)
        return NULL;
    return s->ids[type].name ? s->ids[type].name : "";
}

/* Bytes, without padding behind the last component; `stride` is of a matrix's columns. */
static uint32_t size_of(const struct spirv *s, uint32_t type, uint32_t stride)
{
    const uint32_t *words = is_id(s->shader, type) ? s->ids[type].made_by : NULL;
    const uint32_t *length;
    uint32_t count;
    switch (words ? words[0] & 0xffff : 0) {
    case OP_TYPE_INT:
    case OP_TYPE_FLOAT:
        return words[2] / 8;
    case OP_TYPE_VECTOR:
        return words[3] * size_of(s, words[2], 0);
    case OP_TYPE_MATRIX:
        return words[3] * stride;
    case OP_TYPE_ARRAY: /* of elements without padding */
        length = type_by(s, words[3], OP_CONSTANT);
        return length ? length[3] * size_of(s, words[2], 0) : 0;
    case OP_TYPE_STRUCT:
        if (spirv_struct(s, type, &count) && count) {
            struct spirv_member last = spirv_member(s, type, count - 1);
            return last.offset + last.size;
        }
        return 0;
    default:
        return 0;
    }
}

struct spirv_member spirv_member(const struct spirv *s, uint32_t type, uint32_t index)
{
    const uint32_t *words = type_by(s, type, OP_TYPE_STRUCT);
    struct spirv_member member = { .name = "", .offset = SPIRV_NONE };
    uint32_t stride = 0;
    if (!words || index >= (words[0] >> 16) - 2)
        return member;
    member.type = words[2 + index];
    for (struct instruction in = { 0 }; next(s->shader, &in);) {
        if (in.count < 4 || in.words[1] != type || in.words[2] != index)
            continue;
        if (in.op == OP_MEMBER_NAME)
            member.name = (const char *)&in.words[3];
        if (in.op == OP_MEMBER_DECORATE && in.words[3] == DECORATION_OFFSET && in.count > 4)
            member.offset = in.words[4];
        if (in.op == OP_MEMBER_DECORATE && in.words[3] == DECORATION_MATRIX_STRIDE && in.count > 4)
            stride = in.words[4];
    }
    member.size = size_of(s, member.type, stride);
    return member;
}

bool spirv_image(const struct spirv *s, uint32_t type, struct spirv_image *image)
{
    const uint32_t *sampled = type_by(s, type, OP_TYPE_SAMPLED_IMAGE);
    const uint32_t *words = type_by(s, sampled ? sampled[2] : type, OP_TYPE_IMAGE);
    if (!words)
        return false;
    *image = (struct spirv_image){ .dim = words[3], .arrayed = words[5], .sampled = sampled };
    return true;
}

char spirv_component(const struct spirv *s, uint32_t type)
{
    const uint32_t *vector = type_by(s, type, OP_TYPE_VECTOR);
    uint32_t scalar = vector ? vector[2] : type;
    const uint32_t *integer = type_by(s, scalar, OP_TYPE_INT);
    if (integer)
        return integer[3] ? 'i' : 'u';
    return type_by(s, scalar, OP_TYPE_FLOAT) ? 'f' : '?';
}
