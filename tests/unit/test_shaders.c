/*
 * Rows and shaders agree: bindings, push constants, the layout of shared structs, vertex fields,
 * targets. Looked up in the embedded SPIR-V of every row that a frame can have: all techniques are
 * asked for their rows, with each two values of all settings that may change these.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "src/frame/list.h"
#include "src/tech/techniques.h"
#include "tests/support/check.h"
#include "tests/support/spirv.h"
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
    struct field fields[32];
};

/* All of shaders/x.h: made by shared_structs.py. */
static const struct shared shared_structs[] = {
#include "tests/unit/shared_structs.inc"
};

enum {
    SHARED_COUNT = sizeof(shared_structs) / sizeof(shared_structs[0]),
    LOCATIONS = 32,
    BINDINGS = 32,
};

/* ---- one row ---- */

/* What the shaders of a row were seen to use. */
struct seen {
    const struct rg_pass *row;
    uint32_t bindings;  /* bit b: binding b */
    uint32_t push_size; /* bytes of the C struct */
};

/* What failed is said in words. */
#define CHECK(condition, ...) \
    do { \
        bool good_ = (condition); \
        if (!good_) \
            print_error(__VA_ARGS__); \
        assert_true(good_); \
    } while (0)

/* A block holds one struct that C knows, member by member. */
static const struct shared *check_block(const struct spirv *s, uint32_t type)
{
    const char *shader = s->shader->name;
    uint32_t count;
    const char *block = spirv_struct(s, type, &count);
    CHECK(block && count == 1, "%s: a block is not one struct\n", shader);
    struct spirv_member whole = spirv_member(s, type, 0);
    assert_int_equal(whole.offset, 0);
    const char *name = spirv_struct(s, whole.type, &count);
    size_t k = 0;
    while (k < SHARED_COUNT && name && strcmp(shared_structs[k].name, name) != 0)
        k++;
    CHECK(name && k < SHARED_COUNT, "%s: block %s: no struct that C shares\n", shader, block);
    const struct shared *shared = &shared_structs[k];
    for (uint32_t i = 0; i < count; i++) {
        struct spirv_member member = spirv_member(s, whole.type, i);
        const struct field *field = &shared->fields[i];
        CHECK(field->name && !strcmp(field->name, member.name), "%s: %s.%s is not C's member %u\n",
              shader, name, member.name, i);
        CHECK(field->offset == member.offset && field->size == member.size,
              "%s: %s.%s is at %u, of %u bytes; in C at %zu, of %zu\n", shader, name, member.name,
              member.offset, member.size, field->offset, field->size);
    }
    CHECK(!shared->fields[count].name, "%s: %s lacks %s\n", shader, name,
          shared->fields[count].name);
    return shared;
}

static const struct rg_use *find_binding(const struct rg_pass *row, uint32_t binding)
{
    for (const struct rg_use *use = row->uses; use && use->access; use++) {
        const struct rg_access_info *info = rg_access_info(use->access);
        VkDescriptorType type = use->image ? info->image_descriptor : info->buffer_descriptor;
        if (type != VK_DESCRIPTOR_TYPE_MAX_ENUM && use->binding == binding)
            return use;
    }
    return NULL;
}

static VkDescriptorType descriptor_type(const struct spirv *s, const struct spirv_variable *v)
{
    struct spirv_image image;
    if (v->storage == SPIRV_UNIFORM)
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    if (v->storage == SPIRV_STORAGE_BUFFER)
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    if (!spirv_image(s, v->type, &image))
        return VK_DESCRIPTOR_TYPE_MAX_ENUM;
    return image.sampled ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                         : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}

static void check_image(const struct spirv *s, const struct spirv_variable *v,
                        const struct rg_image *image)
{
    struct spirv_image shown;
    assert_true(spirv_image(s, v->type, &shown));
    bool array = !image->cube && (image->array || image->layers > 1);
    CHECK((shown.dim == SPIRV_DIM_CUBE) == image->cube, "%s: %s is or is no cube\n",
          s->shader->name, image->name);
    CHECK(shown.arrayed == array, "%s: %s is or is no array\n", s->shader->name, image->name);
}

static void check_descriptor(const struct spirv *s, const struct spirv_variable *v,
                             struct seen *seen)
{
    const char *shader = s->shader->name;
    CHECK(v->set == 0 && v->binding < BINDINGS, "%s: set %u, binding %u\n", shader, v->set,
          v->binding);
    const struct rg_use *use = find_binding(seen->row, v->binding);
    CHECK(use, "%s: %s has no binding %u\n", seen->row->name, shader, v->binding);
    const struct rg_access_info *info = rg_access_info(use->access);
    CHECK(descriptor_type(s, v) == (use->image ? info->image_descriptor : info->buffer_descriptor),
          "%s: binding %u is something else in %s\n", seen->row->name, v->binding, shader);
    seen->bindings |= 1u << v->binding;
    if (use->image)
        check_image(s, v, use->image);
    else if (v->storage == SPIRV_UNIFORM)
        assert_int_equal(check_block(s, v->type)->size, use->buffer->size);
}

static void check_vertex_input(const struct spirv *s, const struct spirv_variable *v,
                               const struct rg_pass *row)
{
    const VkVertexInputAttributeDescription *field = NULL;
    for (uint32_t i = 0; row->vertices && i < row->vertices->attribute_count; i++) {
        if (row->vertices->attributes[i].location == v->location)
            field = &row->vertices->attributes[i];
    }
    CHECK(field, "%s: no vertex field at location %u\n", row->name, v->location);
    char component = field && field->format == VK_FORMAT_R32_UINT ? 'u' : 'f';
    CHECK(spirv_component(s, v->type) == component, "%s: location %u is another type\n", row->name,
          v->location);
}

/* Returns the locations of a shader's inputs or outputs, bit l for location l. */
static uint32_t locations(const struct spirv *s, uint32_t storage)
{
    uint32_t bits = 0;
    for (uint32_t i = 0; i < s->variable_count; i++) {
        const struct spirv_variable *v = &s->variables[i];
        if (v->storage != storage || v->location == SPIRV_NONE)
            continue;
        assert_true(v->location < LOCATIONS);
        bits |= 1u << v->location;
    }
    return bits;
}

static void check_resources(const struct spirv *s, struct seen *seen)
{
    for (uint32_t i = 0; i < s->variable_count; i++) {
        const struct spirv_variable *v = &s->variables[i];
        bool descriptor = v->storage == SPIRV_UNIFORM || v->storage == SPIRV_UNIFORM_CONSTANT ||
                          v->storage == SPIRV_STORAGE_BUFFER;
        if (descriptor && v->used)
            check_descriptor(s, v, seen);
        if (v->storage == SPIRV_PUSH_CONSTANT)
            seen->push_size = (uint32_t)check_block(s, v->type)->size;
    }
}

static void open_shader(struct spirv *s, const struct rg_shader *shader)
{
    CHECK(spirv_init(s, shader), "%s is no SPIR-V\n", shader->name);
}

static void check_raster(const struct rg_pass *row, struct seen *seen)
{
    struct spirv vert;
    open_shader(&vert, row->vert);
    check_resources(&vert, seen);
    for (uint32_t i = 0; i < vert.variable_count; i++) {
        const struct spirv_variable *v = &vert.variables[i];
        if (v->storage == SPIRV_INPUT && v->location != SPIRV_NONE)
            check_vertex_input(&vert, v, row);
    }
    uint32_t passed = locations(&vert, SPIRV_OUTPUT);
    spirv_finish(&vert);
    uint32_t color_count = 0;
    while (color_count < row->color_count && row->color[color_count].image)
        color_count++;
    if (!row->frag) {
        assert_int_equal(color_count, 0);
        return;
    }
    struct spirv frag;
    open_shader(&frag, row->frag);
    check_resources(&frag, seen);
    CHECK(!(locations(&frag, SPIRV_INPUT) & ~passed), "%s: %s does not write all that %s reads\n",
          row->name, row->vert->name, row->frag->name);
    CHECK(locations(&frag, SPIRV_OUTPUT) == (1u << color_count) - 1,
          "%s: %u targets are not what %s writes\n", row->name, color_count, row->frag->name);
    spirv_finish(&frag);
}

static void check_row(const struct rg_pass *row, struct seen *seen)
{
    seen->row = row;
    seen->bindings = seen->push_size = 0;
    if (row->kind == RG_RASTER) {
        check_raster(row, seen);
    } else if (row->kind == RG_COMPUTE) {
        struct spirv comp;
        open_shader(&comp, row->comp);
        check_resources(&comp, seen);
        spirv_finish(&comp);
    }
    for (uint32_t b = 0; b < BINDINGS; b++)
        CHECK(!find_binding(row, b) || (seen->bindings & 1u << b),
              "%s: no shader uses binding %u\n", row->name, b);
    CHECK(row->push_size == seen->push_size, "%s pushes %u bytes, its shaders read %u\n", row->name,
          row->push_size, seen->push_size);
}

/* ---- all rows ---- */

/* Rows that were checked, by what a check looks at. */
struct checked {
    uint64_t *hashes;
    size_t count, room;
    struct seen seen;
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
    check_row(row, &checked->seen);
}

static void check_table(const struct rg_technique *technique, struct checked *checked)
{
    for (size_t p = 0; p < technique->pass_count; p++)
        check_once(&technique->passes[p], checked);
}

/* With and without a pool, for objects of any shape. */
static void check_settings(const struct settings *settings, const struct technique *rung,
                           struct checked *checked)
{
    static const struct technique_choice choices[] = {
        { 0 },
        { .is_convex = true },
        { .has_pool = true },
        { .purpose = TECHNIQUE_CAPTURE },
        { .purpose = TECHNIQUE_BAKE },
        { .purpose = TECHNIQUE_RESOLVE },
    };
    for (size_t i = 0; i < sizeof(choices) / sizeof(choices[0]); i++) {
        struct technique_choice choice = choices[i];
        struct frame_list list;
        choice.settings = settings;
        choice.rung = rung;
        assert_int_equal(frame_list_init(&list, &choice), STATUS_OK);
        for (size_t t = 0; t < list.count; t++)
            check_table(&list.parts[t], checked);
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
        if ((*t)->is_on && row == &(*t)->settings[0]->rows[0])
            return true;
    }
    return false;
}

static size_t find_changes(struct change changes[static CHANGE_MAX])
{
    const struct setting_group *group;
    size_t count = 0;
    for (size_t g = 0; (group = settings_group(g)); g++) {
        for (size_t r = 0; r < group->row_count; r++) {
            const struct setting *row = &group->rows[r];
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
    const struct technique *rung;
    const size_t count = find_changes(changes);
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k <= i; k++) {
            struct settings settings = settings_default();
            settings_put(&settings, changes[i].row, changes[i].value);
            settings_put(&settings, changes[k].row, changes[k].value);
            check_settings(&settings, techniques_rung(0), &checked);
        }
        struct settings settings = settings_default();
        settings_put(&settings, changes[i].row, changes[i].value);
        for (size_t r = 1; (rung = techniques_rung(r)); r++)
            check_settings(&settings, rung, &checked);
    }
    static const struct technique *const windows[] = { VIEW_TECHNIQUES };
    for (size_t t = 0; t < sizeof(windows) / sizeof(windows[0]); t++) {
        for (size_t p = 0; p < TECHNIQUE_PART_COUNT; p++)
            check_table(&windows[t]->parts[p].graph, &checked);
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
