/* cells.c: the cells of an access, one by one. */
#include "graph/compile/compiler.h"

struct cell_walk rg_walk(const struct resource *r, const VkImageSubresourceRange *range)
{
    return (struct cell_walk){ .resource = r, .range = *range };
}

/* Moves on to the next aspect of the range. Aspects count from the resource's lowest bit. */
static bool next_aspect(struct cell_walk *w, uint32_t from)
{
    VkImageAspectFlags left = w->resource->all.aspectMask;
    for (uint32_t index = 0; left; index++, left &= left - 1) {
        if (index >= from && (left & (~left + 1) & w->range.aspectMask)) {
            w->aspect = index;
            return true;
        }
    }
    return false;
}

bool rg_walk_next(struct cell_walk *w)
{
    const struct resource *r = w->resource;
    if (r->buffer) {
        bool first = !w->started;
        w->started = true;
        w->cell = r->cells;
        return first;
    }
    const VkImageSubresourceRange *range = &w->range;
    if (!w->started) {
        w->started = true;
        w->mip = range->baseMipLevel;
        w->layer = range->baseArrayLayer;
        if (!next_aspect(w, 0))
            return false;
    } else if (++w->layer == range->baseArrayLayer + range->layerCount) {
        w->layer = range->baseArrayLayer;
        if (++w->mip == range->baseMipLevel + range->levelCount) {
            w->mip = range->baseMipLevel;
            if (!next_aspect(w, w->aspect + 1))
                return false;
        }
    }
    w->cell =
        &r->cells[((size_t)w->aspect * r->all.levelCount + w->mip) * r->all.layerCount + w->layer];
    return true;
}
