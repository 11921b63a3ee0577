/*
 * rg_cmd.h: what a record function draws with.
 *
 * When a record function runs, its row's pipeline, descriptor set 0, targets, viewport and
 * scissor are bound: what is left is push constants, buffers and draws. All of these only write
 * into a command buffer; none can fail.
 */
#ifndef RG_CMD_H
#define RG_CMD_H

#include "graph/rg.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The row being recorded. */
RG_API const struct rg_pass *rg_cmd_pass(const struct rg_cmd *cmd);

/* Which repetition of its row this is: the cube face of a row repeated per layer. */
RG_API uint32_t rg_cmd_repetition(const struct rg_cmd *cmd);

/* Size of the targets, texels; the view's where there are none. */
RG_API VkExtent2D rg_cmd_extent(const struct rg_cmd *cmd);

/* Push constants from offset 0; `size` is the row's push_size. */
RG_API void rg_cmd_push(struct rg_cmd *cmd, const void *data, uint32_t size);

/* Vertices made up by the shader. */
RG_API void rg_cmd_draw(struct rg_cmd *cmd, uint32_t vertex_count);

/* Indexed triangles of a mesh; buffers outlive the frame's execution. No indices: no draw. */
struct rg_mesh {
    VkBuffer vertices;
    VkBuffer indices; /* uint32 */
    uint32_t index_count;
};

RG_API void rg_cmd_draw_mesh(struct rg_cmd *cmd, const struct rg_mesh *mesh);

/* Those of its indices that begin at `first`, `count` of them, instead of all. */
RG_API void rg_cmd_draw_mesh_part(struct rg_cmd *cmd, const struct rg_mesh *mesh, uint32_t first,
                                  uint32_t count);

/* What lies outside is not drawn, until the next call or the end of the pass; within the
 * targets. */
RG_API void rg_cmd_scissor(struct rg_cmd *cmd, VkRect2D rectangle);

/* Workgroups. */
RG_API void rg_cmd_dispatch(struct rg_cmd *cmd, uint32_t x, uint32_t y, uint32_t z);

/*
 * The same with their numbers in a buffer, which the row names as RG_INDIRECT: there lies, from
 * byte `offset` on, a multiple of 4, one VkDrawIndirectCommand, VkDrawIndexedIndirectCommand (the
 * mesh's index_count does not count then) or VkDispatchIndirectCommand. `firstInstance` is 0,
 * unless the device has drawIndirectFirstInstance enabled.
 */
RG_API void rg_cmd_draw_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                 VkDeviceSize offset);
RG_API void rg_cmd_draw_mesh_indirect(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                                      const struct rg_buffer *buffer, VkDeviceSize offset);
RG_API void rg_cmd_dispatch_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                     VkDeviceSize offset);

/*
 * Copies the first mip of the row's range of an image, its layers one after another, rows tight,
 * to a buffer from byte `offset` on. The row names the image as RG_COPY_SRC and the buffer as
 * RG_COPY_DST.
 */
RG_API void rg_cmd_copy_image_to_buffer(struct rg_cmd *cmd, const struct rg_image *image,
                                        const struct rg_buffer *buffer, VkDeviceSize offset);

/* The way back; the row names the buffer as RG_COPY_SRC, the image as RG_COPY_DST. */
RG_API void rg_cmd_copy_buffer_to_image(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                        VkDeviceSize offset, const struct rg_image *image);

/* For what has no function here: the command buffer being recorded, and the objects (of this
 * frame's slot) behind what the row names. */
RG_API VkCommandBuffer rg_cmd_vulkan(struct rg_cmd *cmd);
RG_API VkImage rg_cmd_image(const struct rg_cmd *cmd, const struct rg_image *image);
RG_API VkBuffer rg_cmd_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer);

#ifdef __cplusplus
}
#endif

#endif
