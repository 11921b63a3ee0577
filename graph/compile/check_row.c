/* check_row.c: what is wrong with a row by itself, whatever the other rows do. */
#include <stdlib.h>
#include "graph/compile/compiler.h"

static const char *use_name(const struct rg_use *use)
{
    return use->image ? use->image->name : use->buffer ? use->buffer->name : NULL;
}

static void check_use(struct compiler *c, const struct rg_pass *pass, const struct rg_use *use)
{
    const char *name = use_name(use);
    if (!rg_is_good_use(use)) {
        rg_fault(c, RG_ERROR_NOT_ONE_RESOURCE, name,
                 "a use names one image or one buffer, and an access");
        return;
    }
    const char *trouble = rg_use_trouble(pass, use);
    rg_fault_if(c, trouble, RG_ERROR_ACCESS, name, trouble);
    bool several = use->image && use->image->samples > 1; /* in each texel */
    rg_fault_if(c, several && use->access != RG_SAMPLED, RG_ERROR_SAMPLES, name,
                "a pass can only sample it, or draw to it; resolve it first");
    rg_fault_if(c, several && use->access == RG_SAMPLED && use->sampler, RG_ERROR_SAMPLES, name,
                "texelFetch reads its samples: name no sampler");
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
static void check_bindings(struct compiler *c, const struct rg_pass *pass, uint32_t use_count)
{
    uint32_t count = 0;
    const struct rg_use **sorted = ARENA_ARRAY(c->arena, const struct rg_use *, use_count);
    for (uint32_t i = 0; i < use_count && sorted; i++) {
        if (rg_is_good_use(&pass->uses[i]) && rg_is_shader_access(pass->uses[i].access))
            sorted[count++] = &pass->uses[i];
    }
    if (count)
        qsort(sorted, count, sizeof(*sorted), compare_bindings); /* NOLINT: pointers are sorted */
    for (uint32_t i = 1; i < count; i++)
        rg_fault_if(c, sorted[i]->binding == sorted[i - 1]->binding, RG_ERROR_DUPLICATE_BINDING,
                    use_name(sorted[i]), "give each use of the row a binding of its own");
}

static void check_uses(struct compiler *c, const struct rg_pass *pass, uint32_t color_count)
{
    /* a raster row without targets has a fault already */
    bool writes =
        pass->kind == RG_RASTER && (color_count || !pass->depth.image || !pass->depth_read_only);
    bool rising = true;
    uint32_t next_binding = 0;
    uint32_t use_count = 0;
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++, use_count++) {
        check_use(c, pass, use);
        writes = writes || ((unsigned)use->access < RG_ACCESS_COUNT &&
                            rg_access_table[use->access].writes_content);
        if (!rg_is_shader_access(use->access))
            continue;
        rising = rising && use->binding >= next_binding;
        next_binding = use->binding + 1u;
    }
    if (!rising)
        check_bindings(c, pass, use_count);
    rg_fault_if(c, !writes, RG_ERROR_WRITES_NOTHING, NULL,
                "a pass without a result is never needed");
}

static void check_targets(struct compiler *c, const struct rg_pass *pass, uint32_t color_count)
{
    bool any = color_count || pass->depth.image;
    rg_fault_if(c, pass->kind != RG_RASTER && any, RG_ERROR_ACCESS, NULL,
                "only a raster pass has targets");
    rg_fault_if(c, pass->kind == RG_RASTER && !any, RG_ERROR_NO_TARGET, NULL,
                "name an image in .color or .depth");
    for (uint32_t i = color_count, room = rg_color_room(pass); i < room; i++) {
        const struct rg_image *image =
            pass->color[i].image ? pass->color[i].image : pass->color[i].resolve;
        if (image)
            rg_fault(c, RG_ERROR_NO_TARGET, image->name,
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

void rg_check_row(struct compiler *c, const struct rg_pass *pass)
{
    uint32_t color_count = rg_color_count(pass);
    const char *trouble = value_trouble(pass, color_count);
    bool draws = pass->vert && (pass->frag || !color_count);
    rg_fault_if(c, !pass->record, RG_ERROR_NO_RECORD, NULL, "name its record function");
    rg_fault_if(c, trouble, RG_ERROR_VALUE, NULL, trouble);
    rg_fault_if(c, pass->kind == RG_RASTER && !draws, RG_ERROR_NO_SHADER, NULL,
                "a raster pass needs .vert, and .frag unless it has depth alone");
    rg_fault_if(c, pass->kind == RG_COMPUTE && !pass->comp, RG_ERROR_NO_SHADER, NULL,
                "a compute pass needs .comp");
    rg_fault_if(c, pass->push_size > RG_MAX_PUSH || pass->push_size % 4, RG_ERROR_PUSH_SIZE, NULL,
                "at most 128 bytes, a multiple of 4");
    check_targets(c, pass, color_count);
    check_uses(c, pass, color_count);
}
