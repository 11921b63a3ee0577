/* barrier_batch.c: merges the barriers of skipped passes into the next pass's barrier call, because
 * llvmpipe flushes all pending work at each barrier call (0.05 to 0.1 ms). */
#include "graph/exec/executor_internal.h"

static VkImageMemoryBarrier2 image_barrier(const struct rg_exec *exec, const struct rg_barrier *b)
{
    return (VkImageMemoryBarrier2){
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = b->src_stages,
        .srcAccessMask = b->src_access,
        .dstStageMask = b->dst_stages,
        .dstAccessMask = b->dst_access,
        .oldLayout = b->old_layout,
        .newLayout = b->new_layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = exec->image_set->images[b->image],
        .subresourceRange = b->range,
    };
}

static VkBufferMemoryBarrier2 buffer_barrier(const struct rg_exec *exec, const struct rg_barrier *b)
{
    return (VkBufferMemoryBarrier2){
        .sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
        .srcStageMask = b->src_stages,
        .srcAccessMask = b->src_access,
        .dstStageMask = b->dst_stages,
        .dstAccessMask = b->dst_access,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .buffer = rg_exec_buffer(exec, b->buffer, exec->slot)->buffer,
        .size = VK_WHOLE_SIZE,
    };
}

static bool overlaps(uint32_t a, uint32_t a_count, uint32_t b, uint32_t b_count)
{
    return a < b + b_count && b < a + a_count;
}

/* Returns true if two barriers affect a common subresource. */
static bool overlap_subresources(const VkImageMemoryBarrier2 *a, const VkImageMemoryBarrier2 *b)
{
    const VkImageSubresourceRange *r = &a->subresourceRange, *s = &b->subresourceRange;
    return a->image == b->image && r->aspectMask & s->aspectMask &&
           overlaps(r->baseMipLevel, r->levelCount, s->baseMipLevel, s->levelCount) &&
           overlaps(r->baseArrayLayer, r->layerCount, s->baseArrayLayer, s->layerCount);
}

static bool is_same_range(const VkImageSubresourceRange *a, const VkImageSubresourceRange *b)
{
    return a->aspectMask == b->aspectMask && a->baseMipLevel == b->baseMipLevel &&
           a->levelCount == b->levelCount && a->baseArrayLayer == b->baseArrayLayer &&
           a->layerCount == b->layerCount;
}

/* Records the pending barriers in one call. If they come from several passes, each barrier gets the
 * stages and accesses of all, because barriers of one call do not wait for each other. */
void rg_exec_record_batch(struct rg_exec *exec, VkCommandBuffer commands)
{
    struct exec_batch *batch = &exec->batch;
    for (uint32_t i = 0; batch->is_merged && i < batch->image_count; i++) {
        batch->images[i].srcStageMask = batch->all.srcStageMask;
        batch->images[i].srcAccessMask = batch->all.srcAccessMask;
        batch->images[i].dstStageMask = batch->all.dstStageMask;
        batch->images[i].dstAccessMask = batch->all.dstAccessMask;
    }
    batch->all.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    const VkDependencyInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = batch->is_merged,
        .pMemoryBarriers = &batch->all,
        .bufferMemoryBarrierCount = batch->is_merged ? 0 : batch->buffer_count,
        .pBufferMemoryBarriers = batch->buffers,
        .imageMemoryBarrierCount = batch->image_count,
        .pImageMemoryBarriers = batch->images,
    };
    if (batch->image_count + batch->buffer_count)
        exec->vk.CmdPipelineBarrier2(commands, &info);
    batch->image_count = batch->buffer_count = 0;
    batch->is_merged = false;
    batch->all = (VkMemoryBarrier2){ 0 };
}

/* Adds an image barrier; two successive layout transitions of the same range become one. Only the
 * first `older` pending barriers, which are those of other passes, can overlap it. */
static void add_image(struct rg_exec *exec, VkCommandBuffer commands, const struct rg_barrier *b,
                      uint32_t older)
{
    struct exec_batch *batch = &exec->batch;
    VkImageMemoryBarrier2 barrier = image_barrier(exec, b);
    if (exec->is_update && !exec->initialized) { /* after another plan's last accesses */
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    }
    for (uint32_t i = 0; i < older && i < batch->image_count; i++) {
        VkImageMemoryBarrier2 *pending = &batch->images[i];
        if (!overlap_subresources(pending, &barrier))
            continue;
        if (is_same_range(&pending->subresourceRange, &barrier.subresourceRange)) {
            pending->newLayout = barrier.newLayout;
            return;
        }
        rg_exec_record_batch(exec, commands);
    }
    batch->images[batch->image_count++] = barrier;
}

void rg_exec_add_batch(struct rg_exec *exec, VkCommandBuffer commands, uint32_t first,
                       uint32_t count)
{
    struct exec_batch *batch = &exec->batch;
    if (count > batch->room - batch->image_count || count > batch->room - batch->buffer_count)
        rg_exec_record_batch(exec, commands);
    const uint32_t older = batch->image_count;
    if (count && batch->image_count + batch->buffer_count)
        batch->is_merged = true;
    for (uint32_t i = first; i < first + count; i++) {
        const struct rg_barrier *b = &exec->plan->barriers[i];
        if (b->image != RG_NONE)
            add_image(exec, commands, b, older);
        else
            batch->buffers[batch->buffer_count++] = buffer_barrier(exec, b);
        batch->all.srcStageMask |= b->src_stages;
        batch->all.srcAccessMask |= b->src_access;
        batch->all.dstStageMask |= b->dst_stages;
        batch->all.dstAccessMask |= b->dst_access;
    }
}
