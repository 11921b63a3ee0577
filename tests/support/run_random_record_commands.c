/* run_random_record_commands.c: records the commands of random passes. */
#include "tests/support/run_random.h"

static const struct rg_plan_pass *plan_pass(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_plan_pass *pass = frame->plan->passes;
    while (pass->pass != rg_cmd_pass(cmd) || pass->repetition != rg_cmd_repetition(cmd))
        pass++;
    return pass;
}

/* Overwrites targets that the plan does not store, to reveal wrong store operations. */
static void clobber_targets(struct rg_cmd *cmd, const struct rg_plan_pass *plan)
{
    VkClearAttachment clears[RG_COLOR_COUNT + 1];
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->color_count; i++) {
        if (plan->color[i].store == VK_ATTACHMENT_STORE_OP_DONT_CARE)
            clears[count++] = (VkClearAttachment){
                .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                .colorAttachment = i,
                .clearValue.color.uint32 = { 0x5a, 0x5b, 0x5c, 0x5d },
            };
    }
    if (plan->depth.image != RG_NONE && plan->depth.store == VK_ATTACHMENT_STORE_OP_DONT_CARE &&
        !plan->pass->depth_read_only)
        clears[count++] = (VkClearAttachment){
            .aspectMask = rg_format_info(plan->pass->depth.image->format)->aspects,
            .clearValue.depthStencil = { 0.375F, 0x5e },
        };
    const VkClearRect all = { .rect.extent = plan->extent, .layerCount = 1 };
    if (count)
        vkCmdClearAttachments(rg_cmd_vulkan(cmd), count, clears, 1, &all);
}

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static void draw(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_pass *pass = rg_cmd_pass(cmd);
    const struct interpret_row *row = &frame->tables->rows[pass - frame->tables->passes];
    const struct random_push push = interpret_push(frame, pass);
    const struct rg_use *indirect = interpret_use(pass, RG_INDIRECT);
    const struct rg_use *instances = interpret_use(pass, RG_VERTEX);
    const VkExtent2D extent = rg_cmd_extent(cmd);
    const uint32_t left = smaller(push.from[0], extent.width);
    const uint32_t top = smaller(push.from[1], extent.height);
    const VkRect2D part = {
        .offset = { (int32_t)left, (int32_t)top },
        .extent = { smaller(push.to[0], extent.width) - left,
                    smaller(push.to[1], extent.height) - top },
    };
    rg_cmd_push(cmd, &push, sizeof(push));
    vkCmdSetScissor(rg_cmd_vulkan(cmd), 0, 1, &part);
    if (instances)
        vkCmdBindVertexBuffers(rg_cmd_vulkan(cmd), 0, 1,
                               &(VkBuffer){ rg_cmd_buffer(cmd, instances->buffer) },
                               &(VkDeviceSize){ 0 });
    if (indirect && row->is_counted)
        rg_cmd_draw_indirect_count(
            cmd, &(struct rg_indirect_count){ indirect->buffer, INTERPRET_DRAW, indirect->buffer,
                                              INTERPRET_COUNT, INTERPRET_DRAW_COUNT });
    else if (indirect)
        rg_cmd_draw_indirect(cmd, indirect->buffer, INTERPRET_DRAW);
    else
        rg_cmd_draw_instances(cmd, 3, row->instance_count);
    clobber_targets(cmd, plan_pass(cmd, frame));
}

static void dispatch(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_pass *pass = rg_cmd_pass(cmd);
    const struct random_push push = interpret_push(frame, pass);
    const struct rg_use *indirect = interpret_use(pass, RG_INDIRECT);
    const struct rg_use *to = interpret_written(pass);
    struct interpret_part part = { .height = 1, .layer_count = 1 };
    if (to->image)
        part = interpret_part(frame->tables, pass, rg_cmd_repetition(cmd), to);
    else
        part.width = (uint32_t)(to->buffer->size / sizeof(uint32_t));
    rg_cmd_push(cmd, &push, sizeof(push));
    if (indirect)
        rg_cmd_dispatch_indirect(cmd, indirect->buffer, INTERPRET_DISPATCH);
    else
        rg_cmd_dispatch(cmd, (part.width + RANDOM_GROUP - 1) / RANDOM_GROUP,
                        (part.height + RANDOM_GROUP - 1) / RANDOM_GROUP, part.layer_count);
}

static VkImageSubresourceLayers layers(const struct rg_use *use, struct interpret_part part)
{
    const VkImageAspectFlags aspects = rg_format_info(use->image->format)->aspects;
    return (VkImageSubresourceLayers){ aspects, part.mip, part.layer, part.layer_count };
}

static void copy_image(struct rg_cmd *cmd, const struct rg_frame *frame, const struct rg_use *from,
                       const struct rg_use *to)
{
    const struct rg_pass *pass = rg_cmd_pass(cmd);
    const uint32_t repetition = rg_cmd_repetition(cmd);
    const struct interpret_part a = interpret_part(frame->tables, pass, repetition, from);
    const struct interpret_part b = interpret_part(frame->tables, pass, repetition, to);
    const VkImageCopy region = {
        .srcSubresource = layers(from, a),
        .dstSubresource = layers(to, b),
        .extent = { a.width, a.height, 1 },
    };
    vkCmdCopyImage(rg_cmd_vulkan(cmd), rg_cmd_image(cmd, from->image),
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, rg_cmd_image(cmd, to->image),
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

static void copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_pass *pass = rg_cmd_pass(cmd);
    const struct interpret_row *row = &frame->tables->rows[pass - frame->tables->passes];
    const struct rg_use *from = interpret_use(pass, RG_COPY_SRC);
    const struct rg_use *to = interpret_use(pass, RG_COPY_DST);
    if (from->image && to->image)
        copy_image(cmd, frame, from, to);
    else if (from->image)
        rg_cmd_copy_image_to_buffer(cmd, from->image, to->buffer, row->dst_offset);
    else if (to->image)
        rg_cmd_copy_buffer_to_image(cmd, from->buffer, row->src_offset, to->image);
    else
        vkCmdCopyBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, from->buffer),
                        rg_cmd_buffer(cmd, to->buffer), 1,
                        &(VkBufferCopy){ row->src_offset, row->dst_offset, row->size });
}

void run_random_record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    static rg_record_fn *const kinds[] = {
        [RG_RASTER] = draw,
        [RG_COMPUTE] = dispatch,
        [RG_TRANSFER] = copy,
    };
    if (rg_cmd_pass(cmd)->set)
        rg_cmd_bind_set(cmd, frame->own);
    kinds[rg_cmd_pass(cmd)->kind](cmd, frame);
}
