/*
 * rg_cmd.h: what a record function draws with.
 *
 * When a record function is called, the pipeline, descriptor set 0, targets, viewport and scissor
 * of its row are bound: what is left is push constants, buffers and draws. All functions here write
 * into the command buffer of the pass, in the thread of rg_exec_submit(). None returns an error,
 * and a `cmd` is valid only until its record function returns.
 */
#ifndef RG_CMD_H
#define RG_CMD_H

#include "graph/rg.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the pass being recorded ---- */

/* Returns the row. */
RG_API const struct rg_pass *rg_cmd_pass(const struct rg_cmd *cmd);

/* Returns which repetition of its row it is, from 0: the cube face of a row repeated per layer. */
RG_API uint32_t rg_cmd_repetition(const struct rg_cmd *cmd);

/* Returns the size of the targets in texels; the view's size if the row has no targets. */
RG_API VkExtent2D rg_cmd_extent(const struct rg_cmd *cmd);

/* ---- drawing and computing ---- */

/* Binds a descriptor set of the program's own, of the layout that rg_exec_params.sets has for the
 * row's `set`. It lives, and stays as it is, until the frame has been executed. */
RG_API void rg_cmd_bind_set(struct rg_cmd *cmd, VkDescriptorSet set);

/* Writes push constants from byte 0 on, for all stages; `size` is the row's push_size. */
RG_API void rg_cmd_push(struct rg_cmd *cmd, const void *data, uint32_t size);

/* Draws one instance of `vertex_count` vertices, without any vertex buffer. */
RG_API void rg_cmd_draw(struct rg_cmd *cmd, uint32_t vertex_count);

/* Draws several instances of them; the vertex shader has gl_InstanceIndex from 0 on. */
RG_API void rg_cmd_draw_instances(struct rg_cmd *cmd, uint32_t vertex_count,
                                  uint32_t instance_count);

/* Indexed triangles. The buffers outlive the execution of the frame: the program's own, or those of
 * rg_cmd_buffer(). */
struct rg_mesh {
    VkBuffer vertices; /* as of rg_pass.vertices */
    VkBuffer indices;  /* uint32_t each */
    uint32_t index_count;
    uint32_t instance_count; /* 0 means 1 */
    const VkBuffer *more;    /* as of the layouts after the first, one each; NULL: there are none */
};

/* Draws all of a mesh; a mesh without indices draws nothing. */
RG_API void rg_cmd_draw_mesh(struct rg_cmd *cmd, const struct rg_mesh *mesh);

/* Draws `count` of a mesh's indices, beginning at index number `first`. */
RG_API void rg_cmd_draw_mesh_part(struct rg_cmd *cmd, const struct rg_mesh *mesh, uint32_t first,
                                  uint32_t count);

/* Limits drawing to a rectangle, in texels of the targets, until the next call or the end of the
 * pass. What is outside of the targets, or of rg_exec_set_region(), is never drawn. */
RG_API void rg_cmd_scissor(struct rg_cmd *cmd, VkRect2D rectangle);

/* Runs x * y * z workgroups of the row's compute shader. */
RG_API void rg_cmd_dispatch(struct rg_cmd *cmd, uint32_t x, uint32_t y, uint32_t z);

/*
 * These draw and compute with parameters from a buffer, which the row names as RG_INDIRECT. At byte
 * `offset`, a multiple of 4, is one VkDrawIndirectCommand, VkDrawIndexedIndirectCommand (instead of
 * the mesh's index_count) or VkDispatchIndirectCommand. `firstInstance` is 0, unless the device has
 * drawIndirectFirstInstance enabled.
 */
RG_API void rg_cmd_draw_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                 VkDeviceSize offset);
RG_API void rg_cmd_draw_mesh_indirect(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                                      const struct rg_buffer *buffer, VkDeviceSize offset);
RG_API void rg_cmd_dispatch_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                     VkDeviceSize offset);

/* Draws whose number the device has counted. The row names both buffers, or the one that has
 * both, as RG_INDIRECT. */
struct rg_indirect_count {
    const struct rg_buffer *commands; /* one behind the other, of a kind as above */
    VkDeviceSize offset;              /* of the first one, bytes, a multiple of 4 */
    const struct rg_buffer *count;    /* of them, a uint32_t */
    VkDeviceSize count_offset;        /* bytes, a multiple of 4 */
    uint32_t max_count;               /* no more than so many are drawn */
};

/* Need the feature drawIndirectCount; without it the frame is not submitted, as below. */
RG_API void rg_cmd_draw_indirect_count(struct rg_cmd *cmd, const struct rg_indirect_count *draws);
RG_API void rg_cmd_draw_mesh_indirect_count(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                                            const struct rg_indirect_count *draws);

/* ---- copying ---- */

/*
 * Copies the first mip of the range that the row names of an image to a buffer, from byte `offset`
 * on: one layer after another, rows tight. The row names the image as RG_COPY_SRC and the buffer as
 * RG_COPY_DST. A copy beyond the end of the buffer is reported to rg_exec_params.log, and the
 * frame is not submitted: rg_exec_submit() returns VK_ERROR_VALIDATION_FAILED_EXT.
 */
RG_API void rg_cmd_copy_image_to_buffer(struct rg_cmd *cmd, const struct rg_image *image,
                                        const struct rg_buffer *buffer, VkDeviceSize offset);

/* Copies texels of that order from a buffer to an image. The row names the buffer as RG_COPY_SRC
 * and the image as RG_COPY_DST. */
RG_API void rg_cmd_copy_buffer_to_image(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                        VkDeviceSize offset, const struct rg_image *image);

/* ---- acceleration structures ---- */

/* Return the acceleration structure in a buffer, which stays the executor's, and the device address
 * of it, or of a buffer that is RG_BUILD_INPUT or RG_BUILD_SCRATCH. The row names the buffer.
 * vkCmdBuildAccelerationStructuresKHR() builds, in rg_cmd_vulkan(). */
RG_API VkAccelerationStructureKHR rg_cmd_acceleration(const struct rg_cmd *cmd,
                                                      const struct rg_buffer *buffer);
RG_API VkDeviceAddress rg_cmd_address(const struct rg_cmd *cmd, const struct rg_buffer *buffer);

/* ---- everything else, with Vulkan itself ---- */

/* Returns the command buffer being recorded. */
RG_API VkCommandBuffer rg_cmd_vulkan(struct rg_cmd *cmd);

/* Returns the image, or the buffer of this frame's slot, of a resource that the row uses. Both stay
 * the executor's. A use that is bound to its fallback has no image. */
RG_API VkImage rg_cmd_image(const struct rg_cmd *cmd, const struct rg_image *image);
RG_API VkBuffer rg_cmd_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer);

#ifdef __cplusplus
}
#endif

#endif
