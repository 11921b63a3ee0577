/* check_row.c: what is wrong with a row by itself, whatever the other rows do. */
#include <stdlib.h>
#include "graph/compile/compiler.h"

static const char *use_name(const struct rg_use *use)
{
    return use->image ? use->image->name : use->buffer ? use->buffer->name : NULL;
}

static const char *samples_trouble(const struct rg_use *use)
{
    if (!use->image || use->image->samples <= 1)
        return NULL;
    if (use->access != RG_SAMPLED)
        return "a pass can only sample it, or draw to it; resolve it first";
    return use->sampler ? "texelFetch reads its samples: name no sampler" : NULL;
}

static void check_use(struct compiler *c, const struct rg_pass *pass, const struct rg_use *use,
                      struct fault_location location)
{
    location.resource = use_name(use);
    if (!rg_is_good_use(use)) {
        rg_fault_add(c, RG_ERROR_NOT_ONE_RESOURCE, location,
                     "a use names one image or one buffer, and an access");
        return;
    }
    const char *hint = rg_use_trouble(pass, use);
    if (hint)
        rg_fault_add(c, RG_ERROR_ACCESS, location, hint);
    hint = samples_trouble(use);
    if (hint)
        rg_fault_add(c, RG_ERROR_SAMPLES, location, hint);
}

static int compare_bindings(const void *a, const void *b)
{
    const struct rg_use *x = *(const struct rg_use *const *)a;
    const struct rg_use *y = *(const struct rg_use *const *)b;
    if (x->binding != y->binding)
        return x->binding < y->binding ? -1 : 1;
    return x < y ? -1 : x > y;
}

/* Of rows whose bindings do not rise. */
static void check_bindings(struct compiler *c, const struct rg_pass *pass, uint32_t use_count,
                           struct fault_location location)
{
    uint32_t count = 0;
    const struct rg_use **sorted = ARENA_ARRAY(c->arena, const struct rg_use *, use_count);
    for (uint32_t i = 0; i < use_count && sorted; i++) {
        if (rg_is_good_use(&pass->uses[i]) && rg_is_shader_access(pass->uses[i].access))
            sorted[count++] = &pass->uses[i];
    }
    if (count)
        qsort(sorted, count, sizeof(*sorted), compare_bindings); /* NOLINT: pointers are sorted */
    for (uint32_t i = 1; i < count; i++) {
        location.resource = use_name(sorted[i]);
        if (sorted[i]->binding == sorted[i - 1]->binding)
            rg_fault_add(c, RG_ERROR_DUPLICATE_BINDING, location,
                         "give each use of the row a binding of its own");
    }
}

static void check_uses(struct compiler *c, const struct rg_pass *pass, uint32_t color_count,
                       struct fault_location location)
{
    /* a raster row without targets has a fault already */
    bool writes =
        pass->kind == RG_RASTER && (color_count || !pass->depth.image || !pass->depth_read_only);
    bool rising = true;
    uint32_t next_binding = 0;
    uint32_t use_count = 0;
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++, use_count++) {
        check_use(c, pass, use, location);
        writes = writes || ((unsigned)use->access < RG_ACCESS_COUNT &&
                            rg_access_table[use->access].writes_content);
        if (!rg_is_shader_access(use->access))
            continue;
        rising = rising && use->binding >= next_binding;
        next_binding = use->binding + 1u;
    }
    if (!rising)
        check_bindings(c, pass, use_count, location);
    if (!writes)
        rg_fault_add(c, RG_ERROR_WRITES_NOTHING, location,
                     "a pass without a result is never needed");
}

static void check_targets(struct compiler *c, const struct rg_pass *pass, uint32_t color_count,
                          struct fault_location location)
{
    bool any = color_count || pass->depth.image;
    if (pass->kind != RG_RASTER && any)
        rg_fault_add(c, RG_ERROR_ACCESS, location, "only a raster pass has targets");
    if (pass->kind == RG_RASTER && !any)
        rg_fault_add(c, RG_ERROR_NO_TARGET, location, "name an image in .color or .depth");
    for (uint32_t i = color_count, room = rg_color_room(pass); i < room; i++) {
        const struct rg_image *image =
            pass->color[i].image ? pass->color[i].image : pass->color[i].resolve;
        if (!image)
            continue;
        location.resource = image->name;
        rg_fault_add(c, RG_ERROR_NO_TARGET, location,
                     "leave no gap: colour targets end at the first without an image");
    }
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

void rg_check_row(struct compiler *c, const struct rg_pass *pass, struct fault_location location)
{
    uint32_t color_count = rg_color_count(pass);
    if (!pass->record)
        rg_fault_add(c, RG_ERROR_NO_RECORD, location, "name its record function");
    const char *hint = value_trouble(pass, color_count);
    if (hint)
        rg_fault_add(c, RG_ERROR_VALUE, location, hint);
    hint = shader_trouble(pass, color_count);
    if (hint)
        rg_fault_add(c, RG_ERROR_NO_SHADER, location, hint);
    if (pass->push_size > RG_MAX_PUSH || pass->push_size % 4)
        rg_fault_add(c, RG_ERROR_PUSH_SIZE, location, "at most 128 bytes, a multiple of 4");
    check_targets(c, pass, color_count, location);
    check_uses(c, pass, color_count, location);
}
