/* region_of_interest.c: finds which part of the view each pass must draw to produce a given region.
 */
#include "graph/exec/executor_internal.h"

/* Parts of the view that a pass draws, or that later passes read from an image, as bit flags. */
enum {
    COVER_REGION = 1, /* the requested region */
    COVER_REACH = 2,  /* where fragments sample other texels */
    COVER_ALL = 4,
};

/* Returns true if an image has the view's size and is neither imported nor persistent. */
static bool has_view_size(const struct rg_plan_image *image)
{
    const struct rg_image *declared = image->image;
    const bool whole =
        !(declared->scale > 0.0f) || !(declared->scale < 1.0f || declared->scale > 1.0f);
    return !declared->width && !declared->height && whole && image->mips == 1 && !declared->cube &&
           !declared->depth && !image->imported && !image->persistent;
}

/* Returns true if a pass can be limited to a region: its images have the view's size. */
static bool can_be_limited(const struct rg_exec *exec, const struct rg_plan_pass *pass)
{
    const struct rg_plan_image *images = exec->plan->images;
    bool limited = pass->pass->kind == RG_RASTER;
    if (pass->pass->kind == RG_TRANSFER) {
        limited = pass->use_count > 0;
        for (uint32_t i = 0; i < pass->use_count; i++) {
            const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + i];
            limited = limited && (use->image == RG_NONE || (use->use->access == RG_COPY_SRC &&
                                                            has_view_size(&images[use->image])));
        }
    }
    for (uint32_t i = 0; i < pass->color_count; i++)
        limited = limited && has_view_size(&images[pass->color[i].image]) &&
                  pass->color[i].resolve == RG_NONE;
    return limited && (pass->depth.image == RG_NONE || has_view_size(&images[pass->depth.image]));
}

static uint32_t coverage_of(const struct rg_exec *exec, const struct rg_plan_pass *pass,
                            const uint8_t *needs)
{
    uint32_t coverage = 0;
    if (!can_be_limited(exec, pass))
        return COVER_ALL;
    for (uint32_t i = 0; i < pass->color_count; i++)
        coverage |= needs[pass->color[i].image];
    if (pass->depth.image != RG_NONE && !pass->pass->depth_read_only)
        coverage |= needs[pass->depth.image];
    return coverage ? coverage : COVER_REGION;
}

/* Returns which part of an image a pass reads through `use` while it draws `coverage`. */
static uint32_t coverage_read(const struct rg_exec *exec, const struct rg_use *use,
                              uint32_t coverage)
{
    if (coverage & COVER_ALL)
        return COVER_ALL;
    if (use->access == RG_COPY_SRC || (use->sampler && use->sampler == exec->extensions.same_texel))
        return coverage;
    return use->access == RG_SAMPLED ? COVER_REACH : COVER_ALL;
}

/* Finds the part of the view that a pass draws, and the parts of images that it then reads. */
static void find_coverage(struct rg_exec *exec, uint32_t index, uint8_t *needs)
{
    const struct rg_plan_pass *pass = &exec->plan->passes[index];
    const uint32_t coverage = coverage_of(exec, pass, needs);
    exec->passes[index].coverage = coverage;
    for (uint32_t i = 0; i < pass->color_count; i++) {
        needs[pass->color[i].image] |= (uint8_t)coverage;
        if (pass->color[i].resolve != RG_NONE)
            needs[pass->color[i].resolve] |= (uint8_t)coverage;
    }
    if (pass->depth.image != RG_NONE)
        needs[pass->depth.image] |= (uint8_t)coverage;
    for (uint32_t i = 0; i < pass->use_count; i++) {
        const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + i];
        if (use->image != RG_NONE)
            needs[use->image] |= (uint8_t)coverage_read(exec, use->use, coverage);
    }
}

VkResult rg_exec_make_coverage(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    uint8_t *needs;
    if (!RG_MAKE_ARRAY(exec, needs, plan->image_count))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    for (uint32_t i = 0; i < plan->image_count; i++) /* outputs of the frame */
        needs[i] = plan->images[i].last == plan->pass_count ? COVER_REGION : 0;
    for (uint32_t p = plan->pass_count; p-- > 0;) /* backwards, from consumers to producers */
        find_coverage(exec, p, needs);
    return VK_SUCCESS;
}

bool rg_exec_is_limited(const struct rg_cmd *cmd)
{
    return cmd->exec->region.region.extent.width && !(cmd->pass->coverage & COVER_ALL);
}

/* Replaces an interval by its intersection with another one, or by their bounding interval. */
static void combine_intervals(int32_t *offset, uint32_t *extent, int32_t other_offset,
                              uint32_t other_extent, bool common)
{
    const int32_t end = *offset + (int32_t)*extent;
    const int32_t other_end = other_offset + (int32_t)other_extent;
    const int32_t first = (*offset < other_offset) == common ? other_offset : *offset;
    const int32_t last = (end < other_end) == common ? end : other_end;
    *offset = first;
    *extent = last > first ? (uint32_t)(last - first) : 0;
}

static VkRect2D combine(VkRect2D a, VkRect2D b, bool common)
{
    combine_intervals(&a.offset.x, &a.extent.width, b.offset.x, b.extent.width, common);
    combine_intervals(&a.offset.y, &a.extent.height, b.offset.y, b.extent.height, common);
    return a;
}

VkRect2D rg_exec_area(const struct rg_cmd *cmd)
{
    const struct rg_exec_region *region = &cmd->exec->region;
    if (!rg_exec_is_limited(cmd))
        return (VkRect2D){ .extent = cmd->plan_pass->extent };
    if (cmd->pass->coverage == COVER_REGION)
        return region->region;
    return cmd->pass->coverage == COVER_REACH ? region->reach
                                              : combine(region->region, region->reach, false);
}

VkRect2D rg_exec_intersect(VkRect2D inner, VkRect2D outer)
{
    return combine(inner, outer, true);
}

static bool is_in_view(const struct rg_plan *plan, VkRect2D area)
{
    return area.offset.x >= 0 && area.offset.y >= 0 && area.extent.width && area.extent.height &&
           (uint64_t)area.offset.x + area.extent.width <= plan->view.width &&
           (uint64_t)area.offset.y + area.extent.height <= plan->view.height;
}

void rg_exec_set_region(struct rg_exec *exec, const struct rg_exec_region *region)
{
    const struct rg_plan *plan = exec->plan;
    if (is_in_view(plan, region->region) && is_in_view(plan, region->reach))
        exec->region = *region;
    else
        rg_exec_refuse(exec, "rg_exec_set_region() outside of the view");
}
