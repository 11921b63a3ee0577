/* commands.c: implements rg_cmd.h, and refuses frames whose record functions misuse it. */
#include <stdarg.h>
#include "graph/exec/executor_internal.h"
#include "graph/rg_cmd.h"

/* ---- misuse ---- */

/* Sets and logs the error of the frame, unless it has one: also in several threads. */
static void refuse(struct rg_exec *exec, VkResult result, const char *what, const char *of)
{
    int none = VK_SUCCESS;
    if (atomic_compare_exchange_strong(&exec->record_result, &none, result))
        rg_exec_check(exec, result, what, of);
}

void rg_exec_misuse(const struct rg_cmd *cmd, const char *resource, const char *format, ...)
{
    char what[384];
    int length = snprintf(what, sizeof(what), "%s: ", cmd->plan_pass->pass->name);
    va_list arguments;
    va_start(arguments, format);
    if (length > 0 && (size_t)length < sizeof(what))
        vsnprintf(&what[length], sizeof(what) - (size_t)length, format, arguments);
    va_end(arguments);
    refuse(cmd->exec, VK_ERROR_VALIDATION_FAILED_EXT, what,
           resource ? resource : cmd->plan_pass->technique->name);
}

/* Returns false if the pass uses secondary command buffers and `cmd` is its primary one. */
static bool is_open(const struct rg_cmd *cmd, const char *command)
{
    const bool open = cmd->is_secondary || !cmd->plan_pass->pass->secondary;
    if (!open)
        rg_exec_misuse(cmd, NULL, "%s outside of rg_cmd_record_secondary()", command);
    return open;
}

/* Returns true if the row is of the kind that a command needs. */
static bool is_in(const struct rg_cmd *cmd, enum rg_kind kind, const char *command)
{
    static const char *const names[] = { "raster", "compute", "transfer" };
    const enum rg_kind is = cmd->plan_pass->pass->kind;
    if (!is_open(cmd, command))
        return false;
    if (is != kind)
        rg_exec_misuse(cmd, NULL, "%s needs a %s row, not a %s row", command, names[kind],
                       names[is]);
    return is == kind;
}

/* Returns true if the row is of this kind and everything that its shaders need is bound. */
static bool can_work(const struct rg_cmd *cmd, enum rg_kind kind, const char *command)
{
    if (!is_in(cmd, kind, command))
        return false;
    const char *missing = !cmd->has_pipeline ? "rg_cmd_bind_pipeline(): the row has no shaders"
                          : !cmd->has_push   ? "rg_cmd_push(): the row has push constants"
                          : !cmd->has_set    ? "rg_cmd_bind_set(): the row has a set"
                                             : NULL;
    if (missing)
        rg_exec_misuse(cmd, NULL, "%s before %s", command, missing);
    return !missing;
}

/* Returns the pass's first use of a resource by `access`, where 0 stands for any access; NULL if
 * the row does not declare it. */
static const struct rg_plan_use *find_use(const struct rg_cmd *cmd, const void *resource,
                                          const char *name, enum rg_access access)
{
    for (uint32_t i = 0; i < cmd->plan_pass->use_count; i++) {
        const struct rg_plan_use *use = &cmd->exec->plan->uses[cmd->plan_pass->first_use + i];
        const void *used =
            use->use->image ? (const void *)use->use->image : (const void *)use->use->buffer;
        if (used == resource && (!access || use->use->access == access))
            return use;
    }
    rg_exec_misuse(cmd, name, "the row's uses have no access '%s'",
                   access ? rg_access_info(access)->name : "of any kind");
    return NULL;
}

static const struct rg_plan_use *find_image(const struct rg_cmd *cmd, const struct rg_image *image,
                                            enum rg_access access)
{
    return find_use(cmd, image, image ? image->name : "NULL", access);
}

static const struct rg_plan_use *find_buffer(const struct rg_cmd *cmd,
                                             const struct rg_buffer *buffer, enum rg_access access)
{
    return find_use(cmd, buffer, buffer ? buffer->name : "NULL", access);
}

static VkBuffer buffer_of(const struct rg_cmd *cmd, const struct rg_plan_use *use)
{
    return use ? rg_exec_buffer(cmd->exec, use->buffer, cmd->exec->slot)->buffer : VK_NULL_HANDLE;
}

/* Returns true if `size` bytes at `offset`, a multiple of `alignment`, are within a buffer. */
static bool is_within(const struct rg_cmd *cmd, const struct rg_plan_use *use, const char *command,
                      VkDeviceSize offset, VkDeviceSize size, VkDeviceSize alignment)
{
    const struct rg_plan_buffer *buffer = &cmd->exec->plan->buffers[use->buffer];
    if (offset % alignment)
        rg_exec_misuse(cmd, buffer->buffer->name, "%s at offset %llu, not a multiple of %llu",
                       command, (unsigned long long)offset, (unsigned long long)alignment);
    else if (size > buffer->size || offset > buffer->size - size)
        rg_exec_misuse(cmd, buffer->buffer->name,
                       "%s of %llu bytes at offset %llu exceeds the %llu bytes", command,
                       (unsigned long long)size, (unsigned long long)offset,
                       (unsigned long long)buffer->size);
    else
        return true;
    return false;
}

/* ---- the pass being recorded ---- */

const struct rg_pass *rg_cmd_pass(const struct rg_cmd *cmd)
{
    return cmd->plan_pass->pass;
}

uint32_t rg_cmd_repetition(const struct rg_cmd *cmd)
{
    return cmd->plan_pass->repetition;
}

VkExtent2D rg_cmd_extent(const struct rg_cmd *cmd)
{
    return cmd->plan_pass->extent;
}

/* ---- bound state ---- */

static VkPipelineBindPoint bind_point(const struct rg_cmd *cmd)
{
    return cmd->plan_pass->pass->kind == RG_COMPUTE ? VK_PIPELINE_BIND_POINT_COMPUTE
                                                    : VK_PIPELINE_BIND_POINT_GRAPHICS;
}

void rg_cmd_bind_pipeline(struct rg_cmd *cmd, VkPipeline pipeline)
{
    if (!is_open(cmd, "rg_cmd_bind_pipeline()"))
        return;
    const char *problem = !pipeline                                   ? "of VK_NULL_HANDLE"
                          : cmd->plan_pass->pass->kind == RG_TRANSFER ? "in a transfer row"
                          : cmd->pass->render_pass                    ? "with render_passes"
                                                                      : NULL;
    cmd->has_pipeline = !problem;
    if (problem)
        rg_exec_misuse(cmd, NULL, "rg_cmd_bind_pipeline() %s", problem);
    else
        cmd->exec->vk.CmdBindPipeline(cmd->commands, bind_point(cmd), pipeline);
}

void rg_cmd_push(struct rg_cmd *cmd, const void *data, uint32_t size)
{
    const struct rg_pass *row = cmd->plan_pass->pass;
    if (!is_open(cmd, "rg_cmd_push()"))
        return;
    if (row->kind == RG_TRANSFER || !data || !size || size != row->push_size) {
        rg_exec_misuse(cmd, NULL, "rg_cmd_push() of %u bytes%s, where push_size is %u", size,
                       data ? "" : " at NULL", row->push_size);
        return;
    }
    cmd->has_push = true;
    cmd->exec->vk.CmdPushConstants(cmd->commands, cmd->pass->layout, rg_exec_stages(row), 0, size,
                                   data);
}

void rg_cmd_bind_set(struct rg_cmd *cmd, VkDescriptorSet set)
{
    if (!is_open(cmd, "rg_cmd_bind_set()"))
        return;
    if (!cmd->plan_pass->pass->set || !set) {
        rg_exec_misuse(cmd, NULL, "rg_cmd_bind_set() of %s",
                       set ? "a set in a row without .set" : "VK_NULL_HANDLE");
        return;
    }
    cmd->has_set = true;
    cmd->exec->vk.CmdBindDescriptorSets(cmd->commands, bind_point(cmd), cmd->pass->layout, 1, 1,
                                        &set, 0, NULL);
}

void rg_cmd_viewport(struct rg_cmd *cmd, const VkViewport *viewport)
{
    if (!viewport)
        rg_exec_misuse(cmd, NULL, "rg_cmd_viewport() with a viewport that is NULL");
    else if (is_in(cmd, RG_RASTER, "rg_cmd_viewport()"))
        cmd->exec->vk.CmdSetViewport(cmd->commands, 0, 1, viewport);
}

void rg_cmd_scissor(struct rg_cmd *cmd, VkRect2D rectangle)
{
    const VkRect2D both = rg_exec_intersect(rectangle, cmd->area);
    if (is_in(cmd, RG_RASTER, "rg_cmd_scissor()"))
        cmd->exec->vk.CmdSetScissor(cmd->commands, 0, 1, &both);
}

/* ---- draws and dispatches ---- */

/* Returns true if the pass may draw without vertex buffers. */
static bool can_draw(const struct rg_cmd *cmd, const char *command)
{
    if (!can_work(cmd, RG_RASTER, command))
        return false;
    if (cmd->plan_pass->pass->vertices && !cmd->is_direct)
        rg_exec_misuse(cmd, NULL, "%s, but the row has .vertices: expected a draw of a mesh",
                       command);
    return !cmd->plan_pass->pass->vertices || cmd->is_direct;
}

void rg_cmd_draw(struct rg_cmd *cmd, uint32_t vertex_count)
{
    rg_cmd_draw_instances(cmd, vertex_count, 1);
}

void rg_cmd_draw_instances(struct rg_cmd *cmd, uint32_t vertex_count, uint32_t instance_count)
{
    if (can_draw(cmd, "a draw"))
        cmd->exec->vk.CmdDraw(cmd->commands, vertex_count, instance_count, 0, 0);
}

/* Binds the buffers of a mesh. Returns false if the pass cannot draw it. */
static bool bind_mesh(const struct rg_cmd *cmd, const struct rg_mesh *mesh, const char *command)
{
    const struct rg_exec *exec = cmd->exec;
    const struct rg_vertex_layout *layout = cmd->plan_pass->pass->vertices;
    if (!can_work(cmd, RG_RASTER, command))
        return false;
    bool is_complete = mesh && mesh->indices;
    for (uint32_t i = 0; layout && is_complete; layout = layout->next, i++) {
        const VkBuffer *buffer = !i ? &mesh->vertices : mesh->more ? &mesh->more[i - 1] : NULL;
        const VkDeviceSize offset = mesh->vertex_offsets ? mesh->vertex_offsets[i] : 0;
        is_complete = buffer && *buffer;
        if (is_complete)
            exec->vk.CmdBindVertexBuffers(cmd->commands, i, 1, buffer, &offset);
    }
    if (is_complete)
        exec->vk.CmdBindIndexBuffer(cmd->commands, mesh->indices, mesh->index_offset,
                                    mesh->short_indices ? VK_INDEX_TYPE_UINT16
                                                        : VK_INDEX_TYPE_UINT32);
    else
        rg_exec_misuse(cmd, NULL, "%s of a mesh that is NULL or lacks buffers", command);
    return is_complete;
}

void rg_cmd_draw_mesh_part(struct rg_cmd *cmd, const struct rg_mesh *mesh, uint32_t first,
                           uint32_t count)
{
    if (mesh && !count)
        return;
    if (!bind_mesh(cmd, mesh, "a draw") || !mesh)
        return;
    if (mesh->index_count && (uint64_t)first + count > mesh->index_count)
        rg_exec_misuse(cmd, NULL, "a draw of indices %u to %llu of a mesh with %u", first,
                       (unsigned long long)first + count - 1, mesh->index_count);
    else
        cmd->exec->vk.CmdDrawIndexed(cmd->commands, count,
                                     mesh->instance_count ? mesh->instance_count : 1, first,
                                     mesh->first_vertex, mesh->first_instance);
}

void rg_cmd_draw_mesh(struct rg_cmd *cmd, const struct rg_mesh *mesh)
{
    rg_cmd_draw_mesh_part(cmd, mesh, 0, mesh ? mesh->index_count : 0);
}

void rg_cmd_dispatch(struct rg_cmd *cmd, uint32_t x, uint32_t y, uint32_t z)
{
    if (can_work(cmd, RG_COMPUTE, "a dispatch"))
        cmd->exec->vk.CmdDispatch(cmd->commands, x, y, z);
}

/* Returns the buffer with indirect parameters; VK_NULL_HANDLE if they are not entirely in it. */
static VkBuffer find_indirect(const struct rg_cmd *cmd, const struct rg_buffer *buffer,
                              VkDeviceSize offset, VkDeviceSize size)
{
    const struct rg_plan_use *use = find_buffer(cmd, buffer, RG_INDIRECT);
    if (!use || !is_within(cmd, use, "a read of indirect parameters", offset, size, 4))
        return VK_NULL_HANDLE;
    return buffer_of(cmd, use);
}

void rg_cmd_draw_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer, VkDeviceSize offset)
{
    VkBuffer found = find_indirect(cmd, buffer, offset, sizeof(VkDrawIndirectCommand));
    if (found && can_draw(cmd, "an indirect draw"))
        cmd->exec->vk.CmdDrawIndirect(cmd->commands, found, offset, 1, 0);
}

void rg_cmd_draw_mesh_indirect(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                               const struct rg_buffer *buffer, VkDeviceSize offset)
{
    VkBuffer found = find_indirect(cmd, buffer, offset, sizeof(VkDrawIndexedIndirectCommand));
    if (found && bind_mesh(cmd, mesh, "an indirect draw"))
        cmd->exec->vk.CmdDrawIndexedIndirect(cmd->commands, found, offset, 1, 0);
}

/* Returns true if the device supports indirect counts and `draws` has buffers of commands, each of
 * `stride` bytes, and of their number. */
static bool find_counted(const struct rg_cmd *cmd, const struct rg_indirect_count *draws,
                         uint32_t stride, VkBuffer *commands, VkBuffer *count)
{
    struct rg_exec *exec = cmd->exec;
    if (!draws) {
        rg_exec_misuse(cmd, NULL, "an indirect draw with count parameters that are NULL");
        return false;
    }
    if (!exec->has_indirect_count) {
        refuse(exec, VK_ERROR_FEATURE_NOT_PRESENT, "the feature drawIndirectCount",
               cmd->plan_pass->pass->name);
        return false;
    }
    *commands =
        find_indirect(cmd, draws->commands, draws->offset, (VkDeviceSize)draws->max_count * stride);
    *count = find_indirect(cmd, draws->count, draws->count_offset, sizeof(uint32_t));
    return *commands && *count;
}

void rg_cmd_draw_indirect_count(struct rg_cmd *cmd, const struct rg_indirect_count *draws)
{
    const uint32_t stride = sizeof(VkDrawIndirectCommand);
    VkBuffer commands, count;
    if (find_counted(cmd, draws, stride, &commands, &count) && can_draw(cmd, "an indirect draw"))
        cmd->exec->vk.CmdDrawIndirectCount(cmd->commands, commands, draws->offset, count,
                                           draws->count_offset, draws->max_count, stride);
}

void rg_cmd_draw_mesh_indirect_count(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                                     const struct rg_indirect_count *draws)
{
    const uint32_t stride = sizeof(VkDrawIndexedIndirectCommand);
    VkBuffer commands, count;
    if (find_counted(cmd, draws, stride, &commands, &count) &&
        bind_mesh(cmd, mesh, "an indirect draw"))
        cmd->exec->vk.CmdDrawIndexedIndirectCount(cmd->commands, commands, draws->offset, count,
                                                  draws->count_offset, draws->max_count, stride);
}

void rg_cmd_dispatch_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                              VkDeviceSize offset)
{
    VkBuffer found = find_indirect(cmd, buffer, offset, sizeof(VkDispatchIndirectCommand));
    if (found && can_work(cmd, RG_COMPUTE, "an indirect dispatch"))
        cmd->exec->vk.CmdDispatchIndirect(cmd->commands, found, offset);
}

/* ---- copies ---- */

static VkBufferImageCopy copy_region(const struct rg_cmd *cmd, const struct rg_plan_use *use,
                                     VkDeviceSize offset)
{
    const struct rg_plan_image *image = &cmd->exec->plan->images[use->image];
    uint32_t mip = use->range.baseMipLevel;
    uint32_t width = image->extent.width >> mip;
    uint32_t height = image->extent.height >> mip;
    uint32_t depth = image->depth >> mip;
    const VkRect2D whole = { .extent = { width ? width : 1, height ? height : 1 } };
    const VkRect2D area = rg_exec_is_limited(cmd) ? cmd->exec->region.region : whole;
    return (VkBufferImageCopy){
        .bufferOffset = offset,
        .imageSubresource = { use->range.aspectMask, mip, use->range.baseArrayLayer,
                              use->range.layerCount },
        .imageOffset = { area.offset.x, area.offset.y, 0 },
        .imageExtent = { area.extent.width, area.extent.height, depth ? depth : 1 },
    };
}

/* Returns true if a copy has one aspect and stays within the buffer. */
static bool can_copy(const struct rg_cmd *cmd, const struct rg_plan_use *image,
                     const struct rg_plan_use *buffer, const VkBufferImageCopy *region)
{
    const struct rg_image *declared = cmd->exec->plan->images[image->image].image;
    const struct rg_format_info *format = rg_format_info(declared->format);
    const VkImageAspectFlags aspects = image->range.aspectMask;
    VkDeviceSize texel = aspects == VK_IMAGE_ASPECT_STENCIL_BIT          ? 1
                         : format->aspects & VK_IMAGE_ASPECT_STENCIL_BIT ? 4
                                                                         : format->size;
    VkDeviceSize size = texel * region->imageExtent.width * region->imageExtent.height *
                        region->imageExtent.depth * region->imageSubresource.layerCount;
    if (!(aspects & (aspects - 1)))
        return is_within(cmd, buffer, "copy", region->bufferOffset, size,
                         aspects == VK_IMAGE_ASPECT_COLOR_BIT ? texel : 4);
    rg_exec_misuse(cmd, declared->name, "copy of two aspects: expected one in rg_use.range");
    return false;
}

void rg_cmd_copy_image_to_buffer(struct rg_cmd *cmd, const struct rg_image *image,
                                 const struct rg_buffer *buffer, VkDeviceSize offset)
{
    const struct rg_plan_use *from = find_image(cmd, image, RG_COPY_SRC);
    const struct rg_plan_use *to = from ? find_buffer(cmd, buffer, RG_COPY_DST) : NULL;
    if (!to)
        return;
    const VkBufferImageCopy region = copy_region(cmd, from, offset);
    if (can_copy(cmd, from, to, &region))
        cmd->exec->vk.CmdCopyImageToBuffer(cmd->commands, cmd->exec->image_set->images[from->image],
                                           from->layout, buffer_of(cmd, to), 1, &region);
}

void rg_cmd_copy_buffer_to_image(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                 VkDeviceSize offset, const struct rg_image *image)
{
    const struct rg_plan_use *to = find_image(cmd, image, RG_COPY_DST);
    const struct rg_plan_use *from = to ? find_buffer(cmd, buffer, RG_COPY_SRC) : NULL;
    if (!from)
        return;
    const VkBufferImageCopy region = copy_region(cmd, to, offset);
    if (can_copy(cmd, to, from, &region))
        cmd->exec->vk.CmdCopyBufferToImage(cmd->commands, buffer_of(cmd, from),
                                           cmd->exec->image_set->images[to->image], to->layout, 1,
                                           &region);
}

void rg_cmd_fill_buffer(struct rg_cmd *cmd, const struct rg_buffer *buffer, VkDeviceSize offset,
                        VkDeviceSize size, uint32_t value)
{
    const struct rg_plan_use *to = find_buffer(cmd, buffer, RG_COPY_DST);
    if (to && size && is_within(cmd, to, "fill", offset, size, 4) &&
        is_within(cmd, to, "fill that ends", offset + size, 0, 4))
        cmd->exec->vk.CmdFillBuffer(cmd->commands, buffer_of(cmd, to), offset, size, value);
}

/* ---- direct Vulkan access ---- */

VkCommandBuffer rg_cmd_vulkan(struct rg_cmd *cmd)
{
    cmd->is_direct = cmd->has_pipeline = cmd->has_push = cmd->has_set = true;
    return cmd->commands;
}

VkImage rg_cmd_image(const struct rg_cmd *cmd, const struct rg_image *image)
{
    const struct rg_plan_use *use = find_image(cmd, image, RG_ACCESS_NONE);
    return use ? cmd->exec->image_set->images[use->image] : rg_exec_image(cmd->exec, image);
}

VkBuffer rg_cmd_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer)
{
    return buffer_of(cmd, find_buffer(cmd, buffer, RG_ACCESS_NONE));
}
