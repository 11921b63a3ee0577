/*
 * rg_cmd.h: commands that a record function may call: draws, dispatches, copies.
 *
 * The pipeline, descriptor set 0, targets, viewport and scissor of the pass are already bound. All
 * functions record into the pass's command buffer. Call them only in the thread that calls
 * rg_exec_submit() or rg_exec_record(); rg_cmd_record_secondary() may be called in any thread. A
 * `cmd` is valid only until its record function returns.
 *
 * A command that the row does not allow is not recorded: a draw in a compute row, a draw before the
 * push constants that the row declares, a resource without the use that the command needs, bytes
 * beyond a buffer. rg_exec_submit() then logs the first such command with its pass and resource,
 * submits nothing, and returns VK_ERROR_VALIDATION_FAILED_EXT. In a thread of
 * rg_cmd_record_secondary(), rg_exec_params.log is called in that thread.
 */
#ifndef RG_CMD_H
#define RG_CMD_H

#include "graph/rg.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the pass being recorded ---- */

/* Returns the declaration (table row) of the pass being recorded. */
RG_API const struct rg_pass *rg_cmd_pass(const struct rg_cmd *cmd);

/* Returns the index of a pass's repetition, from 0; for example, the cube face (RG_PER_LAYER). */
RG_API uint32_t rg_cmd_repetition(const struct rg_cmd *cmd);

/* Returns the size of the pass's targets in texels; the view's size if it has no targets. */
RG_API VkExtent2D rg_cmd_extent(const struct rg_cmd *cmd);

/* ---- drawing and computing ---- */

/* Binds a pipeline of the application in place of the row's. It is a graphics pipeline for the
 * formats and samples of the row's targets (in rows with a fragment shader: those in the plan, see
 * struct rg_pass), with dynamic viewport and scissor, or a compute pipeline, and its layout is
 * compatible with rg_exec_layout(). It must exist until the frame has been executed. Rows without
 * shaders call this before they draw or dispatch. */
RG_API void rg_cmd_bind_pipeline(struct rg_cmd *cmd, VkPipeline pipeline);

/* Binds a descriptor set of the application as set 1. rg_exec_params.sets has the set's layout. The
 * set must exist, unmodified, until the frame has been executed. */
RG_API void rg_cmd_bind_set(struct rg_cmd *cmd, VkDescriptorSet set);

/* Writes all push constants of the row, for all stages; `size` is rg_pass.push_size. */
RG_API void rg_cmd_push(struct rg_cmd *cmd, const void *data, uint32_t size);

/* Draws one instance of `vertex_count` vertices without vertex buffers. */
RG_API void rg_cmd_draw(struct rg_cmd *cmd, uint32_t vertex_count);

/* Draws `instance_count` instances without vertex buffers; gl_InstanceIndex starts at 0. */
RG_API void rg_cmd_draw_instances(struct rg_cmd *cmd, uint32_t vertex_count,
                                  uint32_t instance_count);

/* Indexed triangles. The buffers must exist until the frame has been executed. */
struct rg_mesh {
    VkBuffer vertices;       /* first binding of rg_pass.vertices */
    VkBuffer indices;        /* uint32_t per index, or uint16_t if short_indices */
    uint32_t index_count;    /* may be 0 for rg_cmd_draw_mesh_part() */
    uint32_t instance_count; /* 0 means 1 */
    const VkBuffer *more;    /* buffers for rg_vertex_layout.next; may be NULL */
    /* byte offset into each vertex buffer, indexed by binding; NULL means 0 */
    const VkDeviceSize *vertex_offsets;
    VkDeviceSize index_offset; /* a multiple of the size of an index */
    bool short_indices;
    int32_t first_vertex;    /* added to each index */
    uint32_t first_instance; /* gl_InstanceIndex starts here */
};

/* Draws a whole mesh; does nothing if it has no indices. */
RG_API void rg_cmd_draw_mesh(struct rg_cmd *cmd, const struct rg_mesh *mesh);

/* Draws `count` indices of a mesh from index number `first` on; does nothing if `count` is 0. */
RG_API void rg_cmd_draw_mesh_part(struct rg_cmd *cmd, const struct rg_mesh *mesh, uint32_t first,
                                  uint32_t count);

/* Sets the viewport, in texels of the targets, until the next call or the end of the pass. At the
 * beginning it is the whole target with depths from 0 to 1. */
RG_API void rg_cmd_viewport(struct rg_cmd *cmd, const VkViewport *viewport);

/* Sets the scissor rectangle, in texels of the targets. It holds until the next call or the end of
 * the pass. Drawing is always clipped to the targets. */
RG_API void rg_cmd_scissor(struct rg_cmd *cmd, VkRect2D rectangle);

/* Dispatches x * y * z workgroups of the pass's compute shader. */
RG_API void rg_cmd_dispatch(struct rg_cmd *cmd, uint32_t x, uint32_t y, uint32_t z);

/* Draw or dispatch with parameters from a buffer that the pass declares as RG_INDIRECT. At byte
 * `offset`, a multiple of 4, is one VkDrawIndirectCommand, VkDrawIndexedIndirectCommand or
 * VkDispatchIndirectCommand. Its index count overrides the mesh's. `firstInstance` must be 0 unless
 * the device feature drawIndirectFirstInstance is enabled. */
RG_API void rg_cmd_draw_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                 VkDeviceSize offset);
RG_API void rg_cmd_draw_mesh_indirect(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                                      const struct rg_buffer *buffer, VkDeviceSize offset);
RG_API void rg_cmd_dispatch_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                     VkDeviceSize offset);

/* Indirect draws whose number is in a buffer. The pass declares both buffers as RG_INDIRECT. */
struct rg_indirect_count {
    /* VkDrawIndirectCommand or VkDrawIndexedIndirectCommand, tightly packed */
    const struct rg_buffer *commands;
    VkDeviceSize offset;           /* bytes, a multiple of 4 */
    const struct rg_buffer *count; /* a uint32_t: number of draws */
    VkDeviceSize count_offset;     /* bytes, a multiple of 4 */
    uint32_t max_count;            /* maximum number of draws */
};

/* Record indirect draws whose number is read from a buffer. If the feature drawIndirectCount is
 * missing, rg_exec_submit() logs an error and fails with VK_ERROR_FEATURE_NOT_PRESENT. */
RG_API void rg_cmd_draw_indirect_count(struct rg_cmd *cmd, const struct rg_indirect_count *draws);
RG_API void rg_cmd_draw_mesh_indirect_count(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                                            const struct rg_indirect_count *draws);

/* ---- copying ---- */

/* Copies a mip level of an image to a buffer from byte `offset` on: layer after layer, rows tightly
 * packed. The pass declares the image as RG_COPY_SRC, whose range selects the layers and (as the
 * first) the mip level, and the buffer as RG_COPY_DST. `offset` is a multiple of the size of a
 * texel, and of 4 for depth and stencil, of which the range names one. */
RG_API void rg_cmd_copy_image_to_buffer(struct rg_cmd *cmd, const struct rg_image *image,
                                        const struct rg_buffer *buffer, VkDeviceSize offset);

/* Copies texels from a buffer to an image, in the order of rg_cmd_copy_image_to_buffer(). The pass
 * declares the buffer as RG_COPY_SRC and the image as RG_COPY_DST. */
RG_API void rg_cmd_copy_buffer_to_image(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                        VkDeviceSize offset, const struct rg_image *image);

/* Fills `size` bytes of a buffer from byte `offset` on, both multiples of 4, with repetitions of
 * `value`. The pass declares the buffer as RG_COPY_DST. */
RG_API void rg_cmd_fill_buffer(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                               VkDeviceSize offset, VkDeviceSize size, uint32_t value);

/* ---- secondary command buffers, for recording in several threads ---- */

/* Records commands into a secondary command buffer, as rg_record_fn does into the pass's own. */
typedef void rg_secondary_fn(struct rg_cmd *cmd, void *user);

/*
 * Records a secondary command buffer for the pass: begins it, binds what a record function finds
 * bound, calls `record` with `user`, and ends it. The program owns the command buffer, which is in
 * the initial state, from a pool of rg_exec_params.queue_family, and must exist until the frame has
 * been executed. Returns the error of a Vulkan call, which is logged.
 *
 * The record function of the pass calls it directly, or in other threads for which it waits: at the
 * same time for command buffers of different pools. The pass has rg_pass.secondary; otherwise
 * submitting fails with VK_ERROR_VALIDATION_FAILED_EXT.
 */
RG_API VkResult rg_cmd_record_secondary(const struct rg_cmd *cmd, VkCommandBuffer secondary,
                                        rg_secondary_fn *record, void *user);

/* Executes `count` secondary command buffers in this order. Afterwards nothing is bound. */
RG_API void rg_cmd_execute(struct rg_cmd *cmd, const VkCommandBuffer *secondary, uint32_t count);

/* ---- direct Vulkan access ---- */

/* Returns the command buffer being recorded, for direct Vulkan calls. The executor does not check
 * these, nor, after this call, that later draws and dispatches of the pass have all state bound.
 * During the pass, an image is in the layout rg_access_info(access)->layout of its use. */
RG_API VkCommandBuffer rg_cmd_vulkan(struct rg_cmd *cmd);

/* Return the VkImage or VkBuffer of a resource that the pass declares. If the resource is not
 * imported, the executor owns the resource. A missing image (rg_use.fallback) has no VkImage. A
 * resource that the pass does not declare is an error, as above; the result may then be
 * VK_NULL_HANDLE. */
RG_API VkImage rg_cmd_image(const struct rg_cmd *cmd, const struct rg_image *image);
RG_API VkBuffer rg_cmd_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer);

#ifdef __cplusplus
}
#endif

#endif
