/* check_row.c: what is wrong with a row by itself, whatever the other rows do. */
#include <stdlib.h>
#include "graph/compile/compiler.h"

static const char *use_trouble(const struct rg_use *use, const struct meaning *m)
{
    if (!m->fits)
        return "this kind of pass cannot do that; targets go into .color and .depth";
    if (use->stages & ~m->shaders)
        return "name only stages of the shaders that the pass has";
    if (!(use->image ? m->image : m->buffer))
        return use->image ? "an image cannot be used so" : "a buffer cannot be used so";
    if (use->buffer && use->buffer->memory == RG_MEMORY_UPLOAD &&
        (m->flags & ACCESS_WRITES_CONTENT))
        return "the CPU writes this buffer; a pass may only read it";
    return NULL;
}

static const char *samples_trouble(const struct rg_use *use)
{
    if (!use->image || use->image->samples <= 1)
        return NULL;
    if (use->access != RG_SAMPLED)
        return "a pass can only sample it, or draw to it; resolve it first";
    return use->sampler ? "texelFetch reads its samples: name no sampler" : NULL;
}

static void tell_trouble(struct compiler *c, const struct rg_use *use, struct place place,
                         const char *use_hint, const char *samples_hint)
{
    place.resource = use->image ? use->image->name : use->buffer ? use->buffer->name : NULL;
    if (!rg_is_good_use(use))
        rg_fault_add(c, RG_ERROR_NOT_ONE_RESOURCE, place,
                     "a use names one image or one buffer, and an access");
    if (use_hint)
        rg_fault_add(c, RG_ERROR_ACCESS, place, use_hint);
    if (samples_hint)
        rg_fault_add(c, RG_ERROR_SAMPLES, place, samples_hint);
}

static int compare_bindings(const void *a, const void *b)
{
    const struct rg_use *x = *(const struct rg_use *const *)a;
    const struct rg_use *y = *(const struct rg_use *const *)b;
    if (x->binding != y->binding)
        return x->binding < y->binding ? -1 : 1;
    return x < y ? -1 : x > y;
}

/* Names every use whose binding is taken. */
static void check_bindings(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    uint32_t count = 0;
    uint32_t use_count = 0;
    while (rg_is_use(&pass->uses[use_count]))
        use_count++;
    const struct rg_use **sorted = ARENA_ARRAY(c->arena, const struct rg_use *, use_count);
    for (uint32_t i = 0; sorted && i < use_count; i++) {
        if (rg_is_good_use(&pass->uses[i]) && rg_is_shader_access(pass->uses[i].access))
            sorted[count++] = &pass->uses[i];
    }
    if (count)
        qsort(sorted, count, sizeof(*sorted), compare_bindings); /* NOLINT: pointers are sorted */
    for (uint32_t i = 1; i < count; i++) {
        place.resource = sorted[i]->image ? sorted[i]->image->name : sorted[i]->buffer->name;
        if (sorted[i]->binding == sorted[i - 1]->binding)
            rg_fault_add(c, RG_ERROR_DUPLICATE_BINDING, place,
                         "give each use of the row a binding of its own");
    }
}

void rg_check_uses(struct compiler *c, const struct rg_pass *pass, const struct place *place)
{
    bool writes = rg_draws(pass);
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++) {
        bool good = rg_is_good_use(use);
        tell_trouble(c, use, *place,
                     good ? use_trouble(use, rg_meaning(c, rg_kind_of(pass), use->access)) : NULL,
                     good ? samples_trouble(use) : NULL);
        writes = writes || ((unsigned)use->access < RG_ACCESS_COUNT &&
                            rg_access_table[use->access].writes_content);
    }
    if (pass->uses)
        check_bindings(c, pass, *place);
    if (!writes)
        rg_fault_add(c, RG_ERROR_WRITES_NOTHING, *place, "a pass without a result is never needed");
}

/* Nothing is to follow the colour targets, of which there are `count`. */
static void check_gap(struct compiler *c, const struct rg_pass *pass, uint32_t count,
                      struct place place)
{
    uint32_t room = rg_color_room(pass);
    for (uint32_t i = count; i < room; i++) {
        const struct rg_target *target = &pass->color[i];
        place.resource = target->image     ? target->image->name
                         : target->resolve ? target->resolve->name
                                           : NULL;
        if (target->image || target->resolve)
            rg_fault_add(c, RG_ERROR_NO_TARGET, place,
                         "leave no gap: colour targets end at the first without an image");
    }
}

static void check_target_list(struct compiler *c, const struct rg_pass *pass, uint32_t color_count,
                              const struct place *place)
{
    bool any = color_count || pass->depth.image;
    if (pass->kind != RG_RASTER && any)
        rg_fault_add(c, RG_ERROR_ACCESS, *place, "only a raster pass has targets");
    if (pass->kind == RG_RASTER && !any)
        rg_fault_add(c, RG_ERROR_NO_TARGET, *place, "name an image in .color or .depth");
    check_gap(c, pass, color_count, *place);
}

static const char *value_trouble(const struct rg_pass *pass, uint32_t color_count)
{
    if ((unsigned)pass->kind > RG_TRANSFER)
        return "a kind is one of enum rg_kind";
    if ((unsigned)pass->repeat > RG_PER_MIP)
        return "a repeat is one of enum rg_repeat";
    if (pass->color_count > (pass->color ? RG_COLOR_COUNT : 0))
        return "color_count is that of .color (RG_TARGETS), at most 8";
    for (uint32_t i = 0; pass->color && i < color_count; i++) {
        if ((unsigned)pass->color[i].load > RG_LOAD_DISCARD ||
            (unsigned)pass->color[i].blend > RG_BLEND_ADD)
            return "a target's load and blend are of enum rg_load and rg_blend";
    }
    if (pass->depth.image && (unsigned)pass->depth.load > RG_LOAD_DISCARD)
        return "a target's load is one of enum rg_load";
    return NULL;
}

static const char *shader_trouble(const struct rg_pass *pass, uint32_t color_count)
{
    if (pass->kind == RG_RASTER && !(pass->vert && (pass->frag || !color_count)))
        return "a raster pass needs .vert, and .frag unless it has depth alone";
    if (pass->kind == RG_COMPUTE && !pass->comp)
        return "a compute pass needs .comp";
    return NULL;
}

void rg_check_row(struct compiler *c, const struct rg_pass *pass, const struct place *place)
{
    uint32_t color_count = rg_color_count(pass);
    if (!pass->record)
        rg_fault_add(c, RG_ERROR_NO_RECORD, *place, "name its record function");
    const char *hint = value_trouble(pass, color_count);
    if (hint)
        rg_fault_add(c, RG_ERROR_VALUE, *place, hint);
    hint = shader_trouble(pass, color_count);
    if (hint)
        rg_fault_add(c, RG_ERROR_NO_SHADER, *place, hint);
    if (!rg_is_push_size(pass->push_size))
        rg_fault_add(c, RG_ERROR_PUSH_SIZE, *place, "at most 128 bytes, a multiple of 4");
    check_target_list(c, pass, color_count, place);
}
