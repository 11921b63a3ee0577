/* rg_part.c: which passes draw how much of the view where a part of it is wanted. */
#include <assert.h>
#include <stdlib.h>
#include "graph/rg_exec_internal.h"

/* Of an image: what later passes read; of a pass: what it draws. Sums of: */
enum {
    SPAN_PART = 1,  /* the part wanted */
    SPAN_REACH = 2, /* where fragments look elsewhere */
    SPAN_ALL = 4,
};

/* Neither of a size of its own nor seen outside the frame. */
static bool is_of_view(const struct rg_plan_image *image)
{
    const struct rg_image *declared = image->image;
    const bool whole =
        !(declared->scale > 0.0f) || !(declared->scale < 1.0f || declared->scale > 1.0f);
    return !declared->width && !declared->height && whole && image->mips == 1 && !declared->cube &&
           !image->imported && !image->persistent;
}

/* Whether it can draw a part alone: into targets of the view's size, or from such an image into a
 * buffer. */
static bool is_divisible(const struct rg_exec *exec, const struct rg_plan_pass *pass)
{
    const struct rg_plan_image *images = exec->plan->images;
    bool divisible = pass->pass->kind == RG_RASTER;
    if (pass->pass->kind == RG_TRANSFER) {
        divisible = pass->use_count > 0;
        for (uint32_t i = 0; i < pass->use_count; i++) {
            const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + i];
            divisible = divisible && (use->image == RG_NONE || (use->use->access == RG_COPY_SRC &&
                                                                is_of_view(&images[use->image])));
        }
    }
    for (uint32_t i = 0; i < pass->color_count; i++)
        divisible = divisible && is_of_view(&images[pass->color[i].image]) &&
                    pass->color[i].resolve == RG_NONE;
    return divisible && (pass->depth.image == RG_NONE || is_of_view(&images[pass->depth.image]));
}

/* True if that is new. */
static bool need(uint8_t *needs, uint32_t image, uint32_t span)
{
    const uint8_t before = needs[image];
    needs[image] = (uint8_t)(before | span);
    return needs[image] != before;
}

static uint32_t span_of(const struct rg_exec *exec, const struct rg_plan_pass *pass,
                        const uint8_t *needs)
{
    uint32_t span = 0;
    if (!is_divisible(exec, pass))
        return SPAN_ALL;
    for (uint32_t i = 0; i < pass->color_count; i++)
        span |= needs[pass->color[i].image];
    if (pass->depth.image != RG_NONE && !pass->pass->depth_read_only)
        span |= needs[pass->depth.image];
    return span ? span : SPAN_PART;
}

/* How much of an image a pass that draws `span` reads by a use. */
static uint32_t span_read(const struct rg_use *use, uint32_t span)
{
    if (span & SPAN_ALL)
        return SPAN_ALL;
    if (use->access == RG_COPY_SRC || use->here)
        return span;
    return use->access == RG_SAMPLED ? SPAN_REACH : SPAN_ALL;
}

/* From the last pass back; true if an earlier round has told a pass less than is needed now. */
static bool spread(struct rg_exec *exec, uint8_t *needs)
{
    bool news = false;
    for (uint32_t p = exec->plan->pass_count; p-- > 0;) {
        const struct rg_plan_pass *pass = &exec->plan->passes[p];
        const uint32_t span = span_of(exec, pass, needs);
        exec->passes[p].span = span;
        for (uint32_t i = 0; i < pass->color_count; i++) {
            news |= need(needs, pass->color[i].image, span);
            if (pass->color[i].resolve != RG_NONE)
                news |= need(needs, pass->color[i].resolve, span);
        }
        if (pass->depth.image != RG_NONE)
            news |= need(needs, pass->depth.image, span);
        for (uint32_t i = 0; i < pass->use_count; i++) {
            const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + i];
            if (use->image != RG_NONE)
                news |= need(needs, use->image, span_read(use->use, span));
        }
    }
    return news;
}

VkResult rg_exec_make_spans(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    uint8_t *needs = calloc(plan->image_count ? plan->image_count : 1, sizeof(*needs));
    if (!needs)
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "calloc", NULL);
    for (uint32_t i = 0; i < plan->image_count; i++) /* outputs */
        needs[i] = plan->images[i].last == plan->pass_count ? SPAN_PART : 0;
    while (spread(exec, needs))
        ;
    free(needs);
    return VK_SUCCESS;
}

bool rg_exec_is_divided(const struct rg_exec *exec, const struct rg_plan_pass *pass)
{
    return exec->part.part.extent.width &&
           !(exec->passes[pass - exec->plan->passes].span & SPAN_ALL);
}

static int32_t end_of(int32_t offset, uint32_t extent)
{
    return offset + (int32_t)extent;
}

static VkRect2D around_both(VkRect2D a, VkRect2D b)
{
    const int32_t ends[4] = {
        end_of(a.offset.x, a.extent.width),
        end_of(b.offset.x, b.extent.width),
        end_of(a.offset.y, a.extent.height),
        end_of(b.offset.y, b.extent.height),
    };
    VkRect2D both = a;
    both.offset.x = a.offset.x < b.offset.x ? a.offset.x : b.offset.x;
    both.offset.y = a.offset.y < b.offset.y ? a.offset.y : b.offset.y;
    both.extent.width = (uint32_t)((ends[0] > ends[1] ? ends[0] : ends[1]) - both.offset.x);
    both.extent.height = (uint32_t)((ends[2] > ends[3] ? ends[2] : ends[3]) - both.offset.y);
    return both;
}

VkRect2D rg_exec_area(const struct rg_exec *exec, const struct rg_plan_pass *pass)
{
    const struct rg_exec_part *part = &exec->part;
    const uint32_t span = exec->passes[pass - exec->plan->passes].span;
    if (!rg_exec_is_divided(exec, pass))
        return (VkRect2D){ .extent = pass->extent };
    if (span == SPAN_PART)
        return part->part;
    return span == SPAN_REACH ? part->reach : around_both(part->part, part->reach);
}

VkRect2D rg_exec_within(VkRect2D inner, VkRect2D outer)
{
    const int32_t ends[4] = {
        end_of(inner.offset.x, inner.extent.width),
        end_of(outer.offset.x, outer.extent.width),
        end_of(inner.offset.y, inner.extent.height),
        end_of(outer.offset.y, outer.extent.height),
    };
    const int32_t right = ends[0] < ends[1] ? ends[0] : ends[1];
    const int32_t bottom = ends[2] < ends[3] ? ends[2] : ends[3];
    VkRect2D common = inner;
    if (common.offset.x < outer.offset.x)
        common.offset.x = outer.offset.x;
    if (common.offset.y < outer.offset.y)
        common.offset.y = outer.offset.y;
    common.extent.width = right > common.offset.x ? (uint32_t)(right - common.offset.x) : 0;
    common.extent.height = bottom > common.offset.y ? (uint32_t)(bottom - common.offset.y) : 0;
    return common;
}

static bool is_in_view(const struct rg_plan *plan, VkRect2D area)
{
    return area.offset.x >= 0 && area.offset.y >= 0 && area.extent.width && area.extent.height &&
           (uint64_t)area.offset.x + area.extent.width <= plan->view.width &&
           (uint64_t)area.offset.y + area.extent.height <= plan->view.height;
}

void rg_exec_limit(struct rg_exec *exec, const struct rg_exec_part *part)
{
    assert(is_in_view(exec->plan, part->part) && is_in_view(exec->plan, part->reach));
    assert((uint64_t)part->part.extent.width * part->part.extent.height <=
           (uint64_t)exec->plan->part.width * exec->plan->part.height);
    exec->part = *part;
}
