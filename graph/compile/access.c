/* access.c: the one table that turns an access into Vulkan's words. */
#include "graph/compile/compiler.h"

#define NO_DESCRIPTOR \
    .image_descriptor = VK_DESCRIPTOR_TYPE_MAX_ENUM, \
    .buffer_descriptor = VK_DESCRIPTOR_TYPE_MAX_ENUM

const struct rg_access_info rg_access_table[RG_ACCESS_COUNT] = {
    [RG_ACCESS_NONE] = {
        .name = "none",
        NO_DESCRIPTOR,
    },
    [RG_COLOR] = {
        .name = "color",
        .stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
        .reads = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
        .writes = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
        .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .image_usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        .format_features = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
        .writes_content = true,
        NO_DESCRIPTOR,
    },
    [RG_DEPTH] = {
        .name = "depth",
        .stages = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                  VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        .reads = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
        .writes = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        .layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        .image_usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
        .format_features = VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
        .writes_content = true,
        NO_DESCRIPTOR,
    },
    [RG_DEPTH_READ] = {
        .name = "depth read",
        .stages = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                  VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        .reads = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
        .layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
        .image_usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
        .format_features = VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
        .reads_content = true,
        NO_DESCRIPTOR,
    },
    [RG_RESOLVE] = {
        .name = "resolve",
        .stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
        .writes = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
        .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .image_usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        .format_features = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
        .writes_content = true,
        NO_DESCRIPTOR,
    },
    [RG_SAMPLED] = {
        .name = "sampled",
        .reads = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
        .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        .image_usage = VK_IMAGE_USAGE_SAMPLED_BIT,
        .format_features = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT,
        .image_descriptor = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
        .buffer_descriptor = VK_DESCRIPTOR_TYPE_MAX_ENUM,
        .reads_content = true,
    },
    [RG_STORAGE_READ] = {
        .name = "storage read",
        .reads = VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
        .layout = VK_IMAGE_LAYOUT_GENERAL,
        .image_usage = VK_IMAGE_USAGE_STORAGE_BIT,
        .buffer_usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
        .format_features = VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT,
        .image_descriptor = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
        .buffer_descriptor = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        .reads_content = true,
    },
    [RG_STORAGE_WRITE] = {
        .name = "storage write",
        .writes = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
        .layout = VK_IMAGE_LAYOUT_GENERAL,
        .image_usage = VK_IMAGE_USAGE_STORAGE_BIT,
        .buffer_usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
        .format_features = VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT,
        .image_descriptor = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
        .buffer_descriptor = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        .writes_content = true,
    },
    [RG_STORAGE_READ_WRITE] = {
        .name = "storage read write",
        .reads = VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
        .writes = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
        .layout = VK_IMAGE_LAYOUT_GENERAL,
        .image_usage = VK_IMAGE_USAGE_STORAGE_BIT,
        .buffer_usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
        .format_features = VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT,
        .image_descriptor = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
        .buffer_descriptor = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        .reads_content = true,
        .writes_content = true,
    },
    [RG_UNIFORM] = {
        .name = "uniform",
        .reads = VK_ACCESS_2_UNIFORM_READ_BIT,
        .buffer_usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
        .image_descriptor = VK_DESCRIPTOR_TYPE_MAX_ENUM,
        .buffer_descriptor = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
        .reads_content = true,
    },
    [RG_VERTEX] = {
        .name = "vertex",
        .stages = VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
        .reads = VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT,
        .buffer_usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
        .reads_content = true,
        NO_DESCRIPTOR,
    },
    [RG_INDEX] = {
        .name = "index",
        .stages = VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,
        .reads = VK_ACCESS_2_INDEX_READ_BIT,
        .buffer_usage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
        .reads_content = true,
        NO_DESCRIPTOR,
    },
    [RG_INDIRECT] = {
        .name = "indirect",
        .stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
        .reads = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
        .buffer_usage = VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
        .reads_content = true,
        NO_DESCRIPTOR,
    },
    [RG_COPY_SRC] = {
        .name = "copy source",
        .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .reads = VK_ACCESS_2_TRANSFER_READ_BIT,
        .layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
        .image_usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
        .buffer_usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
        .format_features = VK_FORMAT_FEATURE_TRANSFER_SRC_BIT,
        .reads_content = true,
        NO_DESCRIPTOR,
    },
    [RG_COPY_DST] = {
        .name = "copy destination",
        .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .writes = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        .image_usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .buffer_usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        .format_features = VK_FORMAT_FEATURE_TRANSFER_DST_BIT,
        .writes_content = true,
        NO_DESCRIPTOR,
    },
    [RG_HOST_READ] = {
        .name = "host read",
        .stages = VK_PIPELINE_STAGE_2_HOST_BIT,
        .reads = VK_ACCESS_2_HOST_READ_BIT,
        .layout = VK_IMAGE_LAYOUT_GENERAL,
        .reads_content = true,
        NO_DESCRIPTOR,
    },
    [RG_PRESENT] = {
        .name = "present",
        /* so that a semaphore signalled after all commands comes after the change of layout */
        .stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .layout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        .reads_content = true,
        NO_DESCRIPTOR,
    },
};

const struct rg_access_info *rg_access_info(enum rg_access access)
{
    return &rg_access_table[access];
}

/* The lowest of three bits (vertex, fragment, compute) of what shaders do, or the bit of what one
 * fixed stage does. */
static const uint32_t visibility_bits[RG_ACCESS_COUNT] = {
    [RG_SAMPLED] = 1 << 0,   [RG_STORAGE_READ] = 1 << 3, [RG_UNIFORM] = 1 << 6,
    [RG_COLOR] = 1 << 9,     [RG_DEPTH] = 1 << 10,       [RG_DEPTH_READ] = 1 << 10,
    [RG_VERTEX] = 1 << 11,   [RG_INDEX] = 1 << 12,       [RG_INDIRECT] = 1 << 13,
    [RG_COPY_SRC] = 1 << 14, [RG_HOST_READ] = 1 << 15,
};

uint32_t rg_visibility(enum rg_access access, VkPipelineStageFlags2 stages)
{
    uint32_t bit = visibility_bits[access];
    if (access > RG_UNIFORM || access < RG_SAMPLED)
        return bit;
    uint32_t visibility = stages & ~RG_ANY_SHADER ? ~RG_VISIBLE_TO_ALL : 0;
    visibility |= stages & VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT ? bit : 0;
    visibility |= stages & VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT ? bit << 1 : 0;
    visibility |= stages & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT ? bit << 2 : 0;
    return visibility;
}

struct effect rg_effect(enum rg_access access, bool reads, VkPipelineStageFlags2 stages)
{
    const struct rg_access_info *info = &rg_access_table[access];
    return (struct effect){
        .access = access,
        .visibility = info->writes_content ? 0 : rg_visibility(access, stages),
        .layout = info->layout,
        .usage = info->image_usage,
        .stages = stages,
        .mask = (reads ? info->reads : VK_ACCESS_2_NONE) | info->writes,
        .writes = info->writes,
    };
}

#define KIND_BIT(kind) (1u << (kind))

/* The kinds of pass that may have such a use. */
static const uint8_t kinds_of_use[RG_ACCESS_COUNT] = {
    [RG_SAMPLED] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_STORAGE_READ] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_STORAGE_WRITE] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_STORAGE_READ_WRITE] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_UNIFORM] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_VERTEX] = KIND_BIT(RG_RASTER),
    [RG_INDEX] = KIND_BIT(RG_RASTER),
    [RG_INDIRECT] = KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE),
    [RG_COPY_SRC] = KIND_BIT(RG_TRANSFER),
    [RG_COPY_DST] = KIND_BIT(RG_TRANSFER),
};

static const VkPipelineStageFlags2 stages_of_kind[] = {
    [RG_RASTER] = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    [RG_COMPUTE] = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    [RG_TRANSFER] = VK_PIPELINE_STAGE_2_NONE,
};

/* Of a use that names none. */
static VkPipelineStageFlags2 stages_of_use(enum rg_kind kind, enum rg_access access)
{
    if (rg_access_table[access].stages)
        return rg_access_table[access].stages;
    if (kind == RG_RASTER && access != RG_UNIFORM)
        return VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    return stages_of_kind[kind];
}

void rg_meaning_learn(struct meaning *m, enum rg_kind kind, enum rg_access access)
{
    const struct rg_access_info *info = &rg_access_table[access];
    bool fits = kinds_of_use[access] & KIND_BIT(kind);
    unsigned flags = info->reads_content ? ACCESS_READS_CONTENT : 0;
    if (info->writes_content)
        flags |= ACCESS_WRITES_CONTENT | (info->reads_content ? 0 : ACCESS_OVERWRITES);
    m->on_image = rg_effect(access, true, stages_of_use(kind, access));
    m->shaders = stages_of_kind[kind];
    m->flags = flags;
    m->fits = fits;
    m->image = fits && info->image_usage;
    m->buffer = fits && info->buffer_usage;
    m->on_buffer = m->on_image;
    m->on_buffer.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    m->on_buffer.usage = info->buffer_usage;
}
