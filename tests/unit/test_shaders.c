/*
 * Rows and shaders agree: bindings, push constants, the layout of shared structs, vertex fields,
 * targets. Looked up in the embedded SPIR-V of every row that a frame can have.
 */
#include <stdio.h>
#include <string.h>

#include "shaders/air.h"
#include "shaders/background.h"
#include "shaders/caustics.h"
#include "shaders/cracks.h"
#include "shaders/frost.h"
#include "shaders/gbuffer.h"
#include "shaders/globals.h"
#include "shaders/ice_caustics.h"
#include "shaders/overlay.h"
#include "shaders/present.h"
#include "shaders/refract_blend.h"
#include "shaders/refract_march.h"
#include "shaders/refract_paper.h"
#include "shaders/surface.h"
#include "shaders/tonemap.h"
#include "shaders/water.h"
#include "src/frame/frames.h"
#include "src/view/overlay.h"
#include "src/view/present.h"
#include "tests/support/check.h"
#include "tests/support/spirv.h"

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

#define FIELD(type, member) \
    { \
#member, offsetof(struct type, member), sizeof(((struct type *)0)->member) \
    }

static const struct shared shared_structs[] = {
    {
        "air_push",
        sizeof(struct air_push),
        { FIELD(air_push, strength), FIELD(air_push, haze) },
    },
    {
        "background_push",
        sizeof(struct background_push),
        {
            FIELD(background_push, clip_from_world),
            FIELD(background_push, eye),
            FIELD(background_push, environment_lod),
            FIELD(background_push, right),
            FIELD(background_push, up),
            FIELD(background_push, forward),
            FIELD(background_push, inverse),
        },
    },
    {
        "caustics_push",
        sizeof(struct caustics_push),
        {
            FIELD(caustics_push, water),
            FIELD(caustics_push, pool),
            FIELD(caustics_push, caustics),
        },
    },
    {
        "cracks_look",
        sizeof(struct cracks_look),
        {
            FIELD(cracks_look, strength),
            FIELD(cracks_look, shininess),
            FIELD(cracks_look, bump),
            FIELD(cracks_look, surface),
        },
    },
    {
        "frost_cube_push",
        sizeof(struct frost_cube_push),
        {
            FIELD(frost_cube_push, right),
            FIELD(frost_cube_push, spread),
            FIELD(frost_cube_push, up),
            FIELD(frost_cube_push, forward),
        },
    },
    {
        "frost_push",
        sizeof(struct frost_push),
        { FIELD(frost_push, amount) },
    },
    {
        "gbuffer_push",
        sizeof(struct gbuffer_push),
        { FIELD(gbuffer_push, object) },
    },
    {
        "globals",
        sizeof(struct globals),
        {
            FIELD(globals, clip_from_world),
            FIELD(globals, fitted_clip_from_world),
            FIELD(globals, world_from_object),
            FIELD(globals, world_from_movers),
            FIELD(globals, lights),
            FIELD(globals, eye),
            FIELD(globals, eta),
            FIELD(globals, forward),
            FIELD(globals, background_color),
            FIELD(globals, sky_strength),
            FIELD(globals, sun_dir),
            FIELD(globals, sun_strength),
            FIELD(globals, center),
            FIELD(globals, radius),
            FIELD(globals, fitted),
            FIELD(globals, time),
            FIELD(globals, bump_strength),
            FIELD(globals, bump_scale),
            FIELD(globals, etas),
            FIELD(globals, absorb),
            FIELD(globals, refract_crossfade),
            FIELD(globals, surface),
            FIELD(globals, local_min),
            FIELD(globals, local_max),
            FIELD(globals, lod_bias),
        },
    },
    {
        "ice_caustics_light",
        sizeof(struct ice_caustics_light),
        {
            FIELD(ice_caustics_light, clip_from_world),
            FIELD(ice_caustics_light, reach),
            FIELD(ice_caustics_light, front),
        },
    },
    {
        "ice_caustics_push",
        sizeof(struct ice_caustics_push),
        {
            FIELD(ice_caustics_push, march),
            FIELD(ice_caustics_push, sun_x),
            FIELD(ice_caustics_push, sun_y),
            FIELD(ice_caustics_push, sun),
        },
    },
    {
        "refract_blend_params",
        sizeof(struct refract_blend_params),
        { FIELD(refract_blend_params, a) },
    },
    {
        "refract_march",
        sizeof(struct refract_march),
        {
            FIELD(refract_march, steps),
            FIELD(refract_march, halvings),
            FIELD(refract_march, bounces),
        },
    },
    {
        "overlay_push",
        sizeof(struct overlay_push),
        { FIELD(overlay_push, clip_from_pixel), FIELD(overlay_push, encodes) },
    },
    { "present_push",
      sizeof(struct present_push),
      { FIELD(present_push, encodes), FIELD(present_push, line), FIELD(present_push, left) } },
    {
        "refract_paper_params",
        sizeof(struct refract_paper_params),
        { FIELD(refract_paper_params, a) },
    },
    {
        "tonemap_push",
        sizeof(struct tonemap_push),
        { FIELD(tonemap_push, gain) },
    },
    {
        "water_push",
        sizeof(struct water_push),
        { FIELD(water_push, water), FIELD(water_push, pool) },
    },
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
    uint32_t bindings;          /* bit b: binding b */
    uint32_t push_size;         /* bytes of the C struct */
    bool structs[SHARED_COUNT]; /* in any row */
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
static const struct shared *check_block(const struct spirv *s, uint32_t type, struct seen *seen)
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
    seen->structs[k] = true;
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
        assert_int_equal(check_block(s, v->type, seen)->size, use->buffer->size);
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
            seen->push_size = (uint32_t)check_block(s, v->type, seen)->size;
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

/* Returns the number of rows. */
static size_t check_list(const struct frame_list *list, struct seen *seen)
{
    size_t rows = 0;
    for (size_t t = 0; list->techniques[t]; t++) {
        const struct rg_technique *technique = &list->techniques[t]->graph;
        for (size_t p = 0; p < technique->pass_count; p++, rows++)
            check_row(&technique->passes[p], seen);
    }
    return rows;
}

/* Settings with which a frame has other rows than with the defaults. */
static const char *const variants[] = {
    "bump.strength=0",      "frost.amount=1",   "cracks.count=0",         "cracks.clip=convex",
    "cracks.clip=precut",   "cracks.clip=none", "cracks.refract=normals", "cracks.refract=gap",
    "ice_interval.count=8", "pool.water=on",
};

/* Each together with these. */
static const char *const also[][3] = {
    { NULL },
    { "ice_caustics.light=sun" },
    { "pool.ice=1" },
    { "pool.ice=1", "caustics.method=none" },
    { "caustics.method=none" },
};

static size_t check_variants(const struct rung *rung, const char *const *more, struct seen *seen)
{
    size_t rows = 0;
    for (size_t i = 0; i < sizeof(variants) / sizeof(variants[0]); i++) {
        struct settings settings = settings_default();
        assert_int_equal(settings_set(&settings, variants[i]), STATUS_OK);
        for (size_t k = 0; more[k]; k++)
            assert_int_equal(settings_set(&settings, more[k]), STATUS_OK);
        const struct frame_list list = frame_with(rung, &settings, false);
        rows += check_list(&list, seen);
    }
    return rows;
}

static void test_rows_and_shaders_agree(void **state)
{
    (void)state;
    struct seen seen = { 0 };
    size_t rows = 0;
    for (const struct rung *rung = frame_rungs; rung->name; rung++) {
        for (size_t i = 0; i < sizeof(also) / sizeof(also[0]); i++)
            rows += check_variants(rung, also[i], &seen);
    }
    const struct frame_list capture = frame_capture();
    const struct frame_list bake = frame_bake();
    const struct frame_list resolve = frame_resolve();
    const struct frame_list window = { { &present, &overlay } };
    rows += check_list(&capture, &seen) + check_list(&bake, &seen) + check_list(&resolve, &seen) +
            check_list(&window, &seen);
    print_message("%zu rows\n", rows);
    assert_true(rows > 0);
    for (size_t i = 0; i < SHARED_COUNT; i++)
        CHECK(seen.structs[i], "no shader reads %s\n", shared_structs[i].name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_and_shaders_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
