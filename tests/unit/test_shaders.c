/*
 * test_shaders.c: passes agree with their shaders, as rg_compile() checks, and so do the structs
 * that C and GLSL share. Each row that a frame can have is looked at: all techniques are asked for
 * their rows, with each two values of all settings that may change these.
 */
#include <stdlib.h>
#include <string.h>

#include "graph/compile/spirv_reflection.h"
#include "src/render/frame/pass_list.h"
#include "src/scene/scene.h"
#include "src/tech/techniques.h"
#include "tests/support/assertions.h"
#include "tests/unit/shared_headers.inc"

extern const struct technique VIEW_DECLARED;

/* ---- structs that C and GLSL share ---- */

struct field {
    const char *name; /* NULL ends a struct's */
    size_t offset, size;
};

struct shared {
    const char *name;
    size_t size;
    struct field fields[40];
};

/* All of shaders/x.h: made by shared_structs.py. */
static const struct shared shared_structs[] = {
#include "tests/unit/shared_structs.inc"
};

enum {
    SHARED_COUNT = sizeof(shared_structs) / sizeof(shared_structs[0])
};

/* ---- one row ---- */

/* What failed is said in words. */
#define CHECK(condition, ...) \
    do { \
        bool good_ = (condition); \
        if (!good_) \
            print_error(__VA_ARGS__); \
        assert_true(good_); \
    } while (0)

/* A struct type of a module. */
struct spirv_struct {
    const char *name; /* NULL if the id is no named struct */
    uint32_t count;

    struct {
        const char *name;
        uint32_t type, offset;
    } members[40];
};

static struct spirv_struct struct_of(const struct spirv *s, uint32_t type)
{
    struct spirv_struct found = { 0 };
    const uint32_t *end = s->shader->words + s->shader->word_count;
    for (const uint32_t *in = s->shader->words + 5; in < end; in += in[0] >> 16) {
        const uint32_t op = in[0] & 0xffff, count = in[0] >> 16;
        if (count < 2 || in[1] != type)
            continue;
        if (op == SpvOpName)
            found.name = (const char *)&in[2];
        if (op == SpvOpTypeStruct)
            found.count = count - 2;
        assert_true(found.count <= sizeof(found.members) / sizeof(found.members[0]));
        for (uint32_t i = 0; i < found.count && op == SpvOpTypeStruct; i++)
            found.members[i].type = in[2 + i];
        if (op == SpvOpMemberName)
            found.members[in[2]].name = (const char *)&in[3];
        if (op == SpvOpMemberDecorate && in[3] == SpvDecorationOffset)
            found.members[in[2]].offset = in[4];
    }
    return found;
}

/* Returns the size of a scalar, vector or struct in bytes; 0 for other types. */
static uint32_t size_of(const struct spirv *s, uint32_t type)
{
    uint32_t count;
    if (rg_spirv_component(s, type, &count) != '?')
        return 4 * count;
    return struct_of(s, type).count ? rg_spirv_struct_size(s, type) : 0;
}

/* A block holds one struct that C knows, member by member. */
static void check_block(const struct spirv *s, uint32_t type)
{
    const char *shader = s->shader->name;
    const struct spirv_struct block = struct_of(s, type);
    CHECK(block.name && block.count == 1, "%s: a block is not one struct\n", shader);
    assert_int_equal(block.members[0].offset, 0);
    const struct spirv_struct whole = struct_of(s, block.members[0].type);
    size_t k = 0;
    while (k < SHARED_COUNT && whole.name && strcmp(shared_structs[k].name, whole.name) != 0)
        k++;
    CHECK(whole.name && k < SHARED_COUNT, "%s: block %s: no struct that C shares\n", shader,
          block.name);
    const struct shared *shared = &shared_structs[k];
    for (uint32_t i = 0; i < whole.count; i++) {
        const char *name = whole.members[i].name;
        const uint32_t offset = whole.members[i].offset, size = size_of(s, whole.members[i].type);
        const struct field *field = &shared->fields[i];
        CHECK(field->name && !strcmp(field->name, name), "%s: %s.%s is not C's member %u\n", shader,
              whole.name, name, i);
        CHECK(field->offset == offset && (!size || field->size == size),
              "%s: %s.%s is at %u, of %u bytes; in C at %zu, of %zu\n", shader, whole.name, name,
              offset, size, field->offset, field->size);
    }
    CHECK(!shared->fields[whole.count].name, "%s: %s lacks %s\n", shader, whole.name,
          shared->fields[whole.count].name);
}

static void check_blocks(const struct rg_shader *shader, VkShaderStageFlagBits stage)
{
    struct arena arena;
    struct spirv s = { 0 };
    if (!shader)
        return;
    rg_arena_init(&arena, NULL, 0);
    const char *trouble = rg_spirv_read(&s, &arena, shader, stage);
    CHECK(!trouble && !arena.failed, "%s: %s\n", shader->name, trouble);
    for (uint32_t i = 0; i < s.variable_count; i++) {
        const struct spirv_variable *v = &s.variables[i];
        if (v->storage == SpvStorageClassPushConstant ||
            (v->storage == SpvStorageClassUniform && v->used))
            check_block(&s, v->type);
    }
    rg_arena_finish(&arena);
}

/* The row alone, which has faults of other kinds: it reads what nothing writes. */
static void check_row(const struct rg_pass *row)
{
    const struct rg_technique technique = { "row", row, 1 };
    const struct rg_technique *const list[] = { &technique };
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .techniques = list,
        .technique_count = 1,
        .view = { 64, 64 },
    });
    assert_non_null(plan);
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&plan->faults[i], text, sizeof(text));
        CHECK(plan->faults[i].error < RG_ERROR_SHADER, "%s\n", text);
        CHECK(plan->faults[i].error == RG_ERROR_NO_OUTPUT ||
                  plan->faults[i].error == RG_ERROR_READ_BEFORE_WRITE,
              "not compared with its shaders: %s\n", text);
    }
    rg_plan_destroy(plan);
    check_blocks(row->vert, VK_SHADER_STAGE_VERTEX_BIT);
    check_blocks(row->frag, VK_SHADER_STAGE_FRAGMENT_BIT);
    check_blocks(row->comp, VK_SHADER_STAGE_COMPUTE_BIT);
}

/* ---- all rows ---- */

/* Rows that were checked, by what a check looks at. */
struct checked {
    uint64_t *hashes;
    size_t count, room;
};

static uint64_t mix(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(1099511628211);
    return hash;
}

static uint64_t hash_row(const struct rg_pass *row)
{
    uint64_t hash = mix(UINT64_C(14695981039346656037), row->name, strlen(row->name));
    const void *const pointers[] = { row->vert, row->frag, row->comp, row->vertices };
    hash = mix(hash, pointers, sizeof(pointers));
    hash = mix(hash, &row->push_size, sizeof(row->push_size));
    for (uint32_t i = 0; i < row->color_count; i++)
        hash = mix(hash, &row->color[i].image, sizeof(row->color[i].image));
    for (const struct rg_use *use = row->uses; use && use->access; use++) {
        hash = mix(hash, &use->image, sizeof(use->image));
        hash = mix(hash, &use->buffer, sizeof(use->buffer));
        hash = mix(hash, &use->access, sizeof(use->access));
        hash = mix(hash, &use->binding, sizeof(use->binding));
    }
    return hash;
}

static void check_once(const struct rg_pass *row, struct checked *checked)
{
    const uint64_t hash = hash_row(row);
    for (size_t i = 0; i < checked->count; i++) {
        if (checked->hashes[i] == hash)
            return;
    }
    if (checked->count == checked->room) {
        checked->room = 2 * checked->room + 64;
        checked->hashes = realloc(checked->hashes, checked->room * sizeof(*checked->hashes));
        assert_non_null(checked->hashes);
    }
    checked->hashes[checked->count++] = hash;
    check_row(row);
}

static void check_table(const struct rg_technique *technique, struct checked *checked)
{
    for (size_t p = 0; p < technique->pass_count; p++)
        check_once(&technique->passes[p], checked);
}

/* With and without a pool, for objects of any shape. */
static void check_settings(const struct settings *settings, const struct technique *refraction,
                           struct checked *checked)
{
    static const struct scene object = { 0 }, convex = { .is_convex = true },
                              pool = { .has_pool = true };
    static const struct technique_config choices[] = {
        { .scene = &object },
        { .scene = &convex },
        { .scene = &pool },
        { .scene = &object, .purpose = TECHNIQUE_CAPTURE },
        { .scene = &object, .purpose = TECHNIQUE_RESOLVE },
    };
    for (size_t i = 0; i < sizeof(choices) / sizeof(choices[0]); i++) {
        struct technique_config config = choices[i];
        struct frame_list list;
        config.settings = settings;
        config.refraction = refraction;
        assert_int_equal(frame_list_init(&list, &config), STATUS_OK);
        for (size_t t = 0; t < list.count; t++)
            check_table(&list.pass_groups[t], checked);
        frame_list_finish(&list);
    }
}

/* Settings that may change rows, each with one of its values. */
struct change {
    const struct setting *row;
    double value;
};

enum {
    CHANGE_MAX = 512
};

/* Whether a row switches a technique on and off, whatever it says that it affects. */
static bool is_switch(const struct setting *row)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_on && row == &(*t)->settings->rows[0])
            return true;
    }
    return false;
}

static size_t find_changes(struct change changes[static CHANGE_MAX])
{
    size_t count = 0;
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const bool is_list = row->type == SETTING_CHOICE || row->type == SETTING_SWITCH;
        const double step = is_list || row->max - row->min < 1 ? 1 : row->max - row->min;
        if (row->affects < SETTING_AFFECTS_PLAN && row->switches < SETTING_AFFECTS_PLAN &&
            !is_switch(row))
            continue;
        for (double value = row->min; value <= row->max; value += step) {
            assert_true(count < CHANGE_MAX);
            changes[count++] = (struct change){ row, value };
        }
    }
    return count;
}

/* Each value of each of these settings with each value of another one; every rung with all ice and
 * light there is. */
static void test_rows_and_shaders_agree(void **state)
{
    (void)state;
    struct change changes[CHANGE_MAX];
    struct checked checked = { 0 };
    const struct technique *refraction;
    const size_t count = find_changes(changes);
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k <= i; k++) {
            struct settings settings = settings_default();
            settings_set_value(&settings, changes[i].row, changes[i].value);
            settings_set_value(&settings, changes[k].row, changes[k].value);
            check_settings(&settings, techniques_refraction(0), &checked);
        }
        struct settings settings = settings_default();
        settings_set_value(&settings, changes[i].row, changes[i].value);
        for (size_t r = 1; (refraction = techniques_refraction(r)); r++)
            check_settings(&settings, refraction, &checked);
    }
    static const struct technique *const windows[] = { VIEW_TECHNIQUES };
    for (size_t t = 0; t < sizeof(windows) / sizeof(windows[0]); t++) {
        for (size_t p = 0; p < TECHNIQUE_PASS_GROUP_COUNT; p++)
            check_table(&windows[t]->pass_groups[p].graph, &checked);
    }
    print_message("%zu rows\n", checked.count);
    assert_true(checked.count > 0);
    free(checked.hashes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_and_shaders_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
