/* rg_check_row.c: what is wrong with a row by itself, whatever the other rows do. */
#include <stdlib.h>
#include "graph/rg_internal.h"

#define KIND_BIT(kind) (1u << (kind))

/* The kinds of pass that may have such a use. */
static const uint8_t kinds_of_use[RG_ACCESS_COUNT] = {
    [RG_SAMPLED] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_STORAGE_READ] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_STORAGE_WRITE] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_STORAGE_READ_WRITE] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_UNIFORM] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_VERTEX] = KIND_BIT(RG_RASTER),
    [RG_INDEX] = KIND_BIT(RG_RASTER),
    [RG_INDIRECT] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_COPY_SRC] = KIND_BIT(RG_TRANSFER),
    [RG_COPY_DST] = KIND_BIT(RG_TRANSFER),
};

/* The shader stages that it may name. */
static const VkPipelineStageFlags2 stages_of_kind[] = {
    [RG_RASTER] = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    [RG_COMPUTE] = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    [RG_TRANSFER] = VK_PIPELINE_STAGE_2_NONE,
};

static const char *use_trouble(enum rg_kind kind, const struct rg_use *use)
{
    const struct rg_access_info *info = &rg_access_table[use->access];
    if (!(kinds_of_use[use->access] & KIND_BIT(kind)))
        return "this kind of pass cannot do that; targets go into .color and .depth";
    if (use->stages & ~stages_of_kind[kind])
        return "name only stages of the shaders that the pass has";
    if (use->image ? !info->image_usage : !info->buffer_usage)
        return use->image ? "an image cannot be used so" : "a buffer cannot be used so";
    if (use->buffer && use->buffer->memory == RG_MEMORY_UPLOAD && info->writes_content)
        return "the CPU writes this buffer; a pass may only read it";
    return NULL;
}

static const char *samples_trouble(const struct rg_use *use)
{
    if (use->access != RG_SAMPLED)
        return "a pass can only sample it, or draw to it; resolve it first";
    return use->sampler ? "texelFetch reads its samples: name no sampler" : NULL;
}

/* Returns the bit of its binding, among the first 64. */
static uint64_t check_use(struct compiler *c, enum rg_kind kind, const struct rg_use *use,
                          struct place place)
{
    place.resource = use->image ? use->image->name : use->buffer ? use->buffer->name : NULL;
    if (!rg_is_good_use(use)) {
        rg_fault_add(c, RG_ERROR_NOT_ONE_RESOURCE, place,
                     "a use names one image or one buffer, and an access");
        return 0;
    }
    const char *hint = use_trouble(kind, use);
    if (hint)
        rg_fault_add(c, RG_ERROR_ACCESS, place, hint);
    hint = use->image && use->image->samples > 1 ? samples_trouble(use) : NULL;
    if (hint)
        rg_fault_add(c, RG_ERROR_SAMPLES, place, hint);
    return rg_is_shader_access(use->access) && use->binding < 64 ? UINT64_C(1) << use->binding : 0;
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

/* Returns whether any use writes. */
static bool check_uses(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    enum rg_kind kind = rg_kind_of(pass);
    uint64_t bindings = 0;
    bool clash = false;
    bool writes = false;
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++) {
        uint64_t binding = check_use(c, kind, use, place);
        clash = clash || (bindings & binding) || use->binding >= 64;
        bindings |= binding;
        writes = writes || ((unsigned)use->access < RG_ACCESS_COUNT &&
                            rg_access_table[use->access].writes_content);
    }
    if (clash)
        check_bindings(c, pass, place);
    return writes;
}

static void check_target_list(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    bool any = pass->color[0].image || pass->depth.image;
    if (pass->kind != RG_RASTER && any)
        rg_fault_add(c, RG_ERROR_ACCESS, place, "only a raster pass has targets");
    if (pass->kind == RG_RASTER && !any)
        rg_fault_add(c, RG_ERROR_NO_TARGET, place, "name an image in .color or .depth");
    bool ended = false;
    for (uint32_t i = 0; i < RG_COLOR_COUNT; i++) {
        const struct rg_target *target = &pass->color[i];
        ended = ended || !target->image;
        place.resource = target->image     ? target->image->name
                         : target->resolve ? target->resolve->name
                                           : NULL;
        if (ended && (target->image || target->resolve))
            rg_fault_add(c, RG_ERROR_NO_TARGET, place,
                         "leave no gap: colour targets end at the first without an image");
    }
}

static const char *value_trouble(const struct rg_pass *pass)
{
    if ((unsigned)pass->kind > RG_TRANSFER)
        return "a kind is one of enum rg_kind";
    if ((unsigned)pass->repeat > RG_PER_MIP)
        return "a repeat is one of enum rg_repeat";
    for (uint32_t i = 0; i < RG_COLOR_COUNT && pass->color[i].image; i++) {
        if ((unsigned)pass->color[i].load > RG_LOAD_DISCARD ||
            (unsigned)pass->color[i].blend > RG_BLEND_ADD)
            return "a target's load and blend are of enum rg_load and rg_blend";
    }
    if (pass->depth.image && (unsigned)pass->depth.load > RG_LOAD_DISCARD)
        return "a target's load is one of enum rg_load";
    return NULL;
}

static void check_shaders(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    if (pass->kind == RG_RASTER && !(pass->vert && (pass->frag || !pass->color[0].image)))
        rg_fault_add(c, RG_ERROR_NO_SHADER, place,
                     "a raster pass needs .vert, and .frag unless it has depth alone");
    if (pass->kind == RG_COMPUTE && !pass->comp)
        rg_fault_add(c, RG_ERROR_NO_SHADER, place, "a compute pass needs .comp");
}

void rg_check_row(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    if (pass->name)
        rg_name_add(c, NAME_PASS, pass->name, place);
    else
        rg_fault_add(c, RG_ERROR_NO_NAME, place, "give the pass a name");
    if (!pass->record)
        rg_fault_add(c, RG_ERROR_NO_RECORD, place, "name its record function");
    const char *trouble = value_trouble(pass);
    if (trouble)
        rg_fault_add(c, RG_ERROR_VALUE, place, trouble);
    check_shaders(c, pass, place);
    if (pass->push_size > RG_MAX_PUSH || pass->push_size % 4)
        rg_fault_add(c, RG_ERROR_PUSH_SIZE, place, "at most 128 bytes, a multiple of 4");
    check_target_list(c, pass, place);
    bool writes = check_uses(c, pass, place);
    /* targets of a raster pass apart, whose absence is another fault */
    writes = writes || (pass->kind == RG_RASTER &&
                        (pass->color[0].image || !pass->depth.image || !pass->depth_read_only));
    if (!writes)
        rg_fault_add(c, RG_ERROR_WRITES_NOTHING, place, "a pass without a result is never needed");
}
