/* feature_graphs.c: the list of feature graphs, and record functions that they share. */
#include "tests/support/feature_graphs.h"

const struct feature *const feature_list[FEATURE_COUNT] = {
    &feature_history,  &feature_history_buffers, &feature_when,    &feature_per_layer,
    &feature_per_mip,  &feature_resolve,         &feature_samples, &feature_storage,
    &feature_indirect, &feature_imports,         &feature_present, &feature_texels,
    &feature_volume,   &feature_array,           &feature_count,   &feature_structure,
};

const struct rg_buffer feature_seed = {
    .name = "seed",
    .size = sizeof(struct data_seed),
    .memory = RG_MEMORY_UPLOAD,
};

void feature_record_texels(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, FEATURE_SIZE / DATA_GROUP, FEATURE_SIZE / DATA_GROUP, 1);
}

void feature_record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    const struct rg_use *uses = rg_cmd_pass(cmd)->uses;
    const struct rg_buffer *from = uses[0].buffer;
    const VkBufferCopy region = { .size = from->size + from->size_per_texel * FEATURE_TEXELS };
    vkCmdCopyBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, from),
                    rg_cmd_buffer(cmd, uses[1].buffer), 1, &region);
}
