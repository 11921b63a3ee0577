/*
 * Bytes become tables: the tables of a random graph, with some of their fields changed. Whatever
 * they say, rg_compile() finds faults or makes a plan that stands before the checker.
 *
 * The first byte chooses the graph; after it, six bytes change one field. Pointers stay NULL or
 * valid: of other rows, so that things are shared, used twice or missing. A count exceeds its table
 * only where it is too large for any, or where the table is NULL.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "graph/rg.h"
#include "tests/support/hazard_checker.h"
#include "tests/support/random_graph.h"
#include "tests/support/random_graph_private.h"

/* libFuzzer's name NOLINTNEXTLINE(readability-identifier-naming) */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum {
    EDIT_SIZE = 6, /* bytes */
    MOST_EDITS = 24,
    MOST_PASSES = 8,
    MAX_LAYERS = 64,
    MAX_SIZE = 4096, /* texels */
};

enum kind {
    BOOL,
    U16,
    U32, /* an enum, too */
    U64,
    SIZE,
    FLOAT,
    STAGES,
    IMAGE,
    BUFFER,
    NAME,
    CHOICE, /* one of field.choices */
    RECORD,
    WHEN,
    USES_OF,
    TARGETS_OF,
    MISSING, /* NULL */
};

enum {
    CHOICES = 8
};

struct field {
    enum kind kind;
    size_t offset;
    const void *const *choices; /* CHOICES of them */
};

#define FIELD(of, kind, name) \
    { \
        kind, offsetof(struct of, name), NULL \
    }
#define CHOSEN(of, name, choices) \
    { \
        CHOICE, offsetof(struct of, name), choices \
    }

/* ---- what pointers of rows may point to ---- */

static const uint32_t words[] = { 0x07230203 };
static const struct rg_shader shader = { .name = "fuzzed" };
static const struct rg_shader short_shader = { "short", words, 1 };
static const struct rg_shader wordless = { "wordless", NULL, 7 };
static const struct rg_shader endless = { "endless", words, SIZE_MAX };
static const void *const shaders[CHOICES] = { NULL,    &shader,       &shader,   &shader,
                                              &shader, &short_shader, &wordless, &endless };

static const VkVertexInputAttributeDescription attributes[] = {
    { 0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0 },
    { 1, 0, VK_FORMAT_R32G32_SFLOAT, 12 },
    { UINT32_MAX, 7, (VkFormat)INT32_MAX, UINT32_MAX },
};
static const struct rg_vertex_layout bare = { .stride = 12 };
static const struct rg_vertex_layout wild = { 20, 3, attributes };
static const struct rg_vertex_layout far_apart = { UINT32_MAX, 2, attributes };
static const struct rg_vertex_layout missing = { 20, 2, NULL };
static const struct rg_vertex_layout too_many = { 20, UINT32_MAX, attributes };
static const VkVertexInputAttributeDescription of_second = { 5, 1, VK_FORMAT_R32_UINT, 4 };
static const struct rg_vertex_layout second = { 8, 1, &of_second, .rate = 1, .next = NULL };
static const struct rg_vertex_layout two = { 20, 2, attributes, .next = &second };
static const struct rg_vertex_layout ring = { 20, 0, NULL, .next = &ring };
static const void *const layouts[CHOICES] = { NULL,  &bare,      &two,     &ring,
                                              &wild, &far_apart, &missing, &too_many };

static const VkPipelineColorBlendAttachmentState masked = { .colorWriteMask = 2 };
static const VkPipelineColorBlendAttachmentState blended = { VK_TRUE, .colorWriteMask = 0xf };
static const VkPipelineColorBlendAttachmentState wild_blend = { .srcColorBlendFactor =
                                                                    (VkBlendFactor)INT32_MAX };
static const void *const blends[CHOICES] = { NULL,     NULL,    NULL,     NULL,
                                             &blended, &masked, &blended, &wild_blend };

static const struct rg_stencil tests = { .front = { .compareMask = 1 } };
static const struct rg_stencil writes = { .back = { .passOp = VK_STENCIL_OP_INVERT,
                                                    .writeMask = 1 } };
static const struct rg_stencil wild_stencil = { .back = { .failOp = (VkStencilOp)INT32_MAX } };
static const void *const stencils[CHOICES] = { NULL,   NULL,   NULL,    NULL,
                                               &tests, &tests, &writes, &wild_stencil };

static const struct rg_sampler nearest = { 0 };
static const struct rg_sampler linear = { .linear = true, .mips = true };
static const struct rg_sampler sharp = { .linear = true, .anisotropy = 16 };
static const struct rg_sampler sharpest = { .anisotropy = INFINITY };
static const struct rg_sampler shadow = { .compare = VK_COMPARE_OP_LESS, .border = true };
static const struct rg_sampler wild_sampler = { .compare = (VkCompareOp)INT32_MAX,
                                                .reduction = VK_SAMPLER_REDUCTION_MODE_MAX,
                                                .min_lod = NAN };
static const struct rg_sampler no_number = { .anisotropy = NAN };
static const void *const samplers[CHOICES] = { NULL,   &nearest,  &linear,       &shadow,
                                               &sharp, &sharpest, &wild_sampler, &no_number };

static const struct rg_fallback white = { { 1, 1, 1, 1 } };
static const struct rg_fallback bright = { { 0, 1e30F, 0, 1 } };
static const struct rg_fallback negative = { { 0, 0, -1, 1 } };
static const struct rg_fallback infinite = { { -INFINITY } };
static const struct rg_fallback no_color = { { 0, 0, 0, NAN } };
static const void *const fallbacks[CHOICES] = { NULL,    &white,    &white,    &white,
                                                &bright, &negative, &infinite, &no_color };

static const struct rg_set own_set = { "own" };
static const struct rg_set no_name = { NULL };
static const void *const sets[CHOICES] = { NULL, NULL,     NULL,     NULL,
                                           NULL, &own_set, &own_set, &no_name };

/* ---- fields ---- */

static const struct field image_fields[] = {
    FIELD(rg_image, NAME, name),       FIELD(rg_image, U32, format),
    FIELD(rg_image, U32, width),       FIELD(rg_image, U32, height),
    FIELD(rg_image, FLOAT, scale),     FIELD(rg_image, U32, layers),
    FIELD(rg_image, U32, mips),        FIELD(rg_image, BOOL, cube),
    FIELD(rg_image, BOOL, array),      FIELD(rg_image, U32, samples),
    FIELD(rg_image, BOOL, persistent), FIELD(rg_image, U32, depth),
    FIELD(rg_image, IMAGE, previous),
};

static const struct field buffer_fields[] = {
    FIELD(rg_buffer, NAME, name),          FIELD(rg_buffer, U64, size),
    FIELD(rg_buffer, U64, size_per_texel), FIELD(rg_buffer, U32, memory),
    FIELD(rg_buffer, BOOL, persistent),    FIELD(rg_buffer, U32, format),
};

static const struct field use_fields[] = {
    FIELD(rg_use, IMAGE, image),
    FIELD(rg_use, BUFFER, buffer),
    FIELD(rg_use, U32, access),
    FIELD(rg_use, U16, binding),
    FIELD(rg_use, U16, element),
    FIELD(rg_use, BOOL, texels),
    FIELD(rg_use, U32, range.aspect),
    FIELD(rg_use, U32, range.mip),
    FIELD(rg_use, U32, range.mip_count),
    FIELD(rg_use, U32, range.layer),
    FIELD(rg_use, U32, range.layer_count),
    FIELD(rg_use, BOOL, range.each),
    CHOSEN(rg_use, sampler, samplers),
    CHOSEN(rg_use, fallback, fallbacks),
    FIELD(rg_use, STAGES, stages),
    FIELD(rg_use, U32, view_format),
    FIELD(rg_use, BOOL, partial),
};

static const struct field target_fields[] = {
    FIELD(rg_target, IMAGE, image),     FIELD(rg_target, U32, load),
    FIELD(rg_target, U32, mip),         FIELD(rg_target, U32, layer),
    FIELD(rg_target, U32, blend),       FIELD(rg_target, IMAGE, resolve),
    FIELD(rg_target, U32, resolve_mip), FIELD(rg_target, U32, resolve_layer),
    FIELD(rg_target, FLOAT, clear),     CHOSEN(rg_target, blend_state, blends),
};

static const struct field pass_fields[] = {
    FIELD(rg_pass, NAME, name),         FIELD(rg_pass, U32, kind),
    FIELD(rg_pass, U32, repeat),        FIELD(rg_pass, BOOL, depth_read_only),
    FIELD(rg_pass, U32, depth_compare), FIELD(rg_pass, USES_OF, uses),
    CHOSEN(rg_pass, vert, shaders),     CHOSEN(rg_pass, frag, shaders),
    CHOSEN(rg_pass, comp, shaders),     CHOSEN(rg_pass, vertices, layouts),
    FIELD(rg_pass, U32, topology),      FIELD(rg_pass, U32, cull),
    FIELD(rg_pass, U32, front),         FIELD(rg_pass, U32, push_size),
    FIELD(rg_pass, RECORD, record),     FIELD(rg_pass, WHEN, when),
    FIELD(rg_pass, TARGETS_OF, color),  FIELD(rg_pass, U32, color_count),
    CHOSEN(rg_pass, stencil, stencils), FIELD(rg_pass, FLOAT, depth_bias.slope),
    FIELD(rg_pass, U32, queue),         CHOSEN(rg_pass, set, sets),
    FIELD(rg_pass, U32, layers),        FIELD(rg_pass, BOOL, multiview),
    FIELD(rg_pass, BOOL, secondary),
};

static const struct field import_fields[] = {
    FIELD(rg_import, IMAGE, image),       FIELD(rg_import, BUFFER, buffer),
    FIELD(rg_import, U32, access),        FIELD(rg_import, U32, extent.width),
    FIELD(rg_import, U32, extent.height), FIELD(rg_import, U32, layers),
    FIELD(rg_import, U32, mips),          FIELD(rg_import, U64, size),
    FIELD(rg_import, U32, depth),
};

static const struct field output_fields[] = {
    FIELD(rg_output, IMAGE, image),
    FIELD(rg_output, BUFFER, buffer),
    FIELD(rg_output, U32, access),
};

static const struct field params_fields[] = {
    FIELD(rg_compile_params, U32, view.width),      FIELD(rg_compile_params, U32, view.height),
    FIELD(rg_compile_params, U32, sharing),         FIELD(rg_compile_params, U32, queues),
    FIELD(rg_compile_params, MISSING, techniques),  FIELD(rg_compile_params, MISSING, outputs),
    FIELD(rg_compile_params, MISSING, imports),     FIELD(rg_compile_params, U32, max_view.width),
    FIELD(rg_compile_params, U32, max_view.height),
};

static const struct field technique_fields[] = {
    FIELD(rg_technique, NAME, name),
    FIELD(rg_technique, MISSING, passes),
    FIELD(rg_technique, SIZE, pass_count),
};

static const struct field device_fields[] = {
    FIELD(rg_device, MISSING, image_memory),    FIELD(rg_device, MISSING, buffer_memory),
    FIELD(rg_device, MISSING, format_features), FIELD(rg_device, MISSING, buffer_features),
    FIELD(rg_device, MISSING, sample_counts),
};

/* What a device answers instead of the truth. */
struct answer {
    struct rg_memory_requirements needs;
    VkFlags flags; /* features of formats, and numbers of samples */
};

static const struct field answer_fields[] = {
    FIELD(answer, U64, needs.size),
    FIELD(answer, U64, needs.alignment),
    FIELD(answer, U32, needs.type_bits),
    FIELD(answer, U32, flags),
};

static void record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
}

static bool when(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame != NULL;
}

static struct rg_memory_requirements image_answer(const void *user, const VkImageCreateInfo *info)
{
    (void)info;
    return ((const struct answer *)user)->needs;
}

static struct rg_memory_requirements buffer_answer(const void *user, const VkBufferCreateInfo *info)
{
    (void)info;
    return ((const struct answer *)user)->needs;
}

static VkFormatFeatureFlags format_answer(const void *user, VkFormat format)
{
    (void)format;
    return ((const struct answer *)user)->flags;
}

static VkSampleCountFlags sample_answer(const void *user, const VkImageCreateInfo *info)
{
    (void)info;
    return ((const struct answer *)user)->flags;
}

/* A number: mostly small, sometimes a power of two or beside one. */
static uint64_t number(const uint8_t *value)
{
    uint64_t power = UINT64_C(1) << (value[1] & 63);
    switch (value[0] & 7) {
    case 0:
        return power;
    case 1:
        return power - 1;
    case 2:
        return 0 - power;
    case 3:
        return value[1];
    default:
        return value[1] & 15;
    }
}

static float fraction(const uint8_t *value)
{
    static const float floats[] = { 0.0F, 0.5F, 1.0F, 2.0F, -1.0F, 1e-30F, 1e30F, 0.37F };
    return value[0] & 128 ? (value[0] & 64 ? NAN : INFINITY) : floats[value[1] & 7];
}

/* Half of them of shaders, half anything. */
static VkShaderStageFlags stages(const uint8_t *value)
{
    static const VkShaderStageFlags shaders[] = {
        0,
        VK_SHADER_STAGE_VERTEX_BIT,
        VK_SHADER_STAGE_FRAGMENT_BIT,
        VK_SHADER_STAGE_COMPUTE_BIT,
    };
    if (value[0] & 128)
        return (VkShaderStageFlags)value[1] << (value[0] & 31);
    return shaders[value[0] & 3] | shaders[value[1] & 3];
}

static const char *name(const struct random_tables *t, const uint8_t *value)
{
    static const char *const names[] = { NULL, "", "name", "t0" };
    return value[0] & 1 ? names[value[1] & 3] : t->names[value[1] % (RESOURCES + PASSES)];
}

static void copy(void *to, const void *from, size_t size)
{
    memcpy(to, from, size);
}

#define SET(type, is) \
    do { \
        type set = (is); \
        copy(to, &set, sizeof(set)); \
    } while (0)

/* Gives a field of a row a value made of two bytes. */
static void change(struct random_tables *t, void *row, const struct field *field,
                   const uint8_t *value)
{
    char *to = (char *)row + field->offset;
    bool none = (value[0] & 7) == 0;
    switch (field->kind) {
    case BOOL:
        SET(bool, value[1] & 1);
        break;
    case U16:
        SET(uint16_t, (uint16_t)number(value));
        break;
    case U32:
        SET(uint32_t, (uint32_t)number(value));
        break;
    case U64:
        SET(uint64_t, number(value));
        break;
    case SIZE: /* the tables of passes are one behind the other */
        SET(size_t, number(value) > RG_MAX_ROWS ? number(value) : number(value) % 4);
        break;
    case FLOAT:
        SET(float, fraction(value));
        break;
    case STAGES:
        SET(VkPipelineStageFlags2, stages(value));
        break;
    case IMAGE:
        SET(const struct rg_image *, none ? NULL : &t->images[value[1] % t->image_count]);
        break;
    case BUFFER:
        SET(const struct rg_buffer *, none ? NULL : &t->buffers[value[1] % BUFFERS]);
        break;
    case NAME:
        SET(const char *, name(t, value));
        break;
    case CHOICE:
        SET(const void *, field->choices[value[1] % CHOICES]);
        break;
    case MISSING:
        SET(const void *, NULL);
        break;
    case RECORD:
        SET(rg_record_fn *, none ? NULL : record);
        break;
    case WHEN:
        SET(rg_when_fn *, none ? NULL : when);
        break;
    case USES_OF:
        SET(const struct rg_use *, none ? NULL : t->uses[value[1] % t->pass_count]);
        break;
    case TARGETS_OF:
        SET(const struct rg_target *, none ? NULL : t->targets[value[1] % t->pass_count]);
        break;
    }
}

#define COUNT(array)        (sizeof(array) / sizeof((array)[0]))
#define CHANGE(row, fields) change(t, row, &(fields)[edit[3] % COUNT(fields)], edit + 4)

static void change_pass(struct random_tables *t, const uint8_t *edit)
{
    uint32_t index = edit[1] % t->pass_count;
    struct rg_pass *pass = &t->passes[index];
    struct rg_target *target = &t->targets[index][edit[2] % RG_COLOR_COUNT];
    switch (edit[0] >> 4 & 3) {
    case 0:
        CHANGE(pass, pass_fields);
        break;
    case 1:
        CHANGE(edit[2] & 8 ? &pass->depth : target, target_fields);
        break;
    default:
        CHANGE(&t->uses[index][edit[2] % USES], use_fields);
        break;
    }
}

/* At most `room`, or more than any table has. */
static size_t count(const uint8_t *edit, size_t room)
{
    return edit[3] < 250 ? edit[2] % (room + 1) : (size_t)RG_MAX_ROWS + edit[3] - 249;
}

/* An import or output more, or less, or another one. */
static void change_counts(struct random_tables *t, struct rg_compile_params *params,
                          const uint8_t *edit)
{
    switch (edit[1] & 7) {
    case 0:
        params->import_count = count(edit, RESOURCES);
        break;
    case 1:
        params->output_count = count(edit, RESOURCES);
        break;
    case 2:
        t->techniques[edit[2] % TECHNIQUES] = t->techniques[edit[3] % TECHNIQUES];
        break;
    case 3:
        t->technique_list[edit[2] % TECHNIQUES] = NULL;
        break;
    case 4:
        CHANGE(&t->techniques[edit[2] % TECHNIQUES], technique_fields);
        break;
    default:
        params->technique_count = count(edit, TECHNIQUES);
        break;
    }
}

/* Another answer to all questions of a kind, or to none. */
static void change_device(struct random_tables *t, struct answer *answer, const uint8_t *edit)
{
    struct rg_device *device = &t->device;
    device->user = answer;
    CHANGE(answer, answer_fields);
    if (edit[1] & 1)
        device->image_memory = image_answer;
    if (edit[1] & 2)
        device->buffer_memory = buffer_answer;
    if (edit[1] & 4)
        device->format_features = device->buffer_features = format_answer;
    if (edit[1] & 8)
        device->sample_counts = sample_answer;
    if (edit[1] & 16)
        CHANGE(device, device_fields);
}

static void change_tables(struct random_tables *t, struct rg_compile_params *params,
                          struct answer *answer, const uint8_t *edit)
{
    uint32_t index = edit[1];
    switch (edit[0] & 15) {
    case 0:
        CHANGE(&t->images[index % t->image_count], image_fields);
        break;
    case 1:
        CHANGE(&t->buffers[index % BUFFERS], buffer_fields);
        break;
    case 2:
        CHANGE(&t->imports[index % RESOURCES], import_fields);
        break;
    case 3:
        CHANGE(&t->outputs[index % RESOURCES], output_fields);
        break;
    case 4:
        CHANGE(params, params_fields);
        break;
    case 5:
        change_counts(t, params, edit);
        break;
    case 6:
        change_device(t, answer, edit);
        break;
    default:
        change_pass(t, edit);
        break;
    }
}

static void check(const struct rg_plan *plan, const struct rg_compile_params *params)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        abort();
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char line[64];
        rg_fault_text(&plan->faults[i], line, sizeof(line));
    }
    rg_dump(plan, out);
    rg_dump_json(plan, out);
    rg_dump_html(plan, out);
    if (plan->fault_count == 0 && hazard_check(plan, params, stderr)) {
        rg_dump(plan, stderr);
        abort();
    }
    fclose(out);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct random_graph graph;
    if (!random_graph_init(&graph, size ? data[0] : 0, MOST_PASSES))
        abort();
    struct random_tables *t = graph.tables;
    struct rg_compile_params *params = &graph.params;
    struct answer answer = { { 1024, 64, 1 }, UINT32_MAX };
    /* without limits, sizes may be what no memory holds */
    t->device.max_image_size = MAX_SIZE;
    t->device.max_layers = MAX_LAYERS;
    params->device = &t->device;
    for (size_t i = 0; i < TECHNIQUES; i++) {
        t->technique_list[i] = &t->techniques[i];
        t->techniques[i].passes = t->techniques[i].passes ? t->techniques[i].passes : t->passes;
    }
    for (size_t at = 1, i = 0; i < MOST_EDITS && at + EDIT_SIZE <= size; i++, at += EDIT_SIZE)
        change_tables(t, params, &answer, data + at);
    struct rg_plan *plan = rg_compile(size ? params : NULL);
    if (!plan)
        abort();
    check(plan, params);
    rg_plan_destroy(plan);
    random_graph_finish(&graph);
    return 0;
}
