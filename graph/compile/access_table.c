/* access_table.c: table that maps each rg_access to Vulkan stages, accesses, layout and usage. */
#include "graph/compile/compiler.h"

#define STAGE(name)   VK_PIPELINE_STAGE_2_##name##_BIT
#define ACCESS(name)  VK_ACCESS_2_##name##_BIT
#define LAYOUT(name)  VK_IMAGE_LAYOUT_##name
#define IMAGE(name)   VK_IMAGE_USAGE_##name##_BIT
#define BUFFER(name)  VK_BUFFER_USAGE_##name##_BIT
#define FEATURE(name) VK_FORMAT_FEATURE_##name##_BIT
#define DESCRIPTORS(image, buffer) \
    .image_descriptor = VK_DESCRIPTOR_TYPE_##image, .buffer_descriptor = VK_DESCRIPTOR_TYPE_##buffer
#define NO_DESCRIPTOR DESCRIPTORS(MAX_ENUM, MAX_ENUM)
#define DEPTH_STAGES  (STAGE(EARLY_FRAGMENT_TESTS) | STAGE(LATE_FRAGMENT_TESTS))
#define COLOR_IMAGE   IMAGE(COLOR_ATTACHMENT), 0, FEATURE(COLOR_ATTACHMENT)
#define DEPTH_IMAGE   IMAGE(DEPTH_STENCIL_ATTACHMENT), 0, FEATURE(DEPTH_STENCIL_ATTACHMENT)
#define STORAGE \
    LAYOUT(GENERAL), IMAGE(STORAGE), BUFFER(STORAGE_BUFFER), FEATURE(STORAGE_IMAGE), \
        DESCRIPTORS(STORAGE_IMAGE, STORAGE_BUFFER)

/* Table columns: name, stages, reads, writes, layout, usage flags, format features, descriptors. */
/* clang-format off */
const struct rg_access_info rg_access_table[RG_ACCESS_COUNT] = {
    [RG_ACCESS_NONE] = { "none", NO_DESCRIPTOR },
    [RG_COLOR] = { "color", STAGE(COLOR_ATTACHMENT_OUTPUT), ACCESS(COLOR_ATTACHMENT_READ),
                   ACCESS(COLOR_ATTACHMENT_WRITE), LAYOUT(COLOR_ATTACHMENT_OPTIMAL),
                   COLOR_IMAGE, NO_DESCRIPTOR, .writes_content = true },
    [RG_DEPTH] = { "depth", DEPTH_STAGES, ACCESS(DEPTH_STENCIL_ATTACHMENT_READ),
                   ACCESS(DEPTH_STENCIL_ATTACHMENT_WRITE),
                   LAYOUT(DEPTH_STENCIL_ATTACHMENT_OPTIMAL), DEPTH_IMAGE, NO_DESCRIPTOR,
                   .writes_content = true },
    [RG_DEPTH_READ] = { "depth read", DEPTH_STAGES, ACCESS(DEPTH_STENCIL_ATTACHMENT_READ), 0,
                        LAYOUT(DEPTH_STENCIL_READ_ONLY_OPTIMAL), DEPTH_IMAGE, NO_DESCRIPTOR,
                        .reads_content = true },
    [RG_RESOLVE] = { "resolve", STAGE(COLOR_ATTACHMENT_OUTPUT), 0, ACCESS(COLOR_ATTACHMENT_WRITE),
                     LAYOUT(COLOR_ATTACHMENT_OPTIMAL), COLOR_IMAGE, NO_DESCRIPTOR,
                     .writes_content = true },
    [RG_SAMPLED] = { "sampled", 0, ACCESS(SHADER_SAMPLED_READ), 0,
                     LAYOUT(SHADER_READ_ONLY_OPTIMAL), IMAGE(SAMPLED), BUFFER(UNIFORM_TEXEL_BUFFER),
                     FEATURE(SAMPLED_IMAGE),
                     DESCRIPTORS(COMBINED_IMAGE_SAMPLER, UNIFORM_TEXEL_BUFFER),
                     .reads_content = true },
    [RG_STORAGE_READ] = { "storage read", 0, ACCESS(SHADER_STORAGE_READ), 0, STORAGE,
                          .reads_content = true },
    [RG_STORAGE_WRITE] = { "storage write", 0, 0, ACCESS(SHADER_STORAGE_WRITE), STORAGE,
                           .writes_content = true },
    [RG_STORAGE_READ_WRITE] = { "storage read write", 0, ACCESS(SHADER_STORAGE_READ),
                                ACCESS(SHADER_STORAGE_WRITE), STORAGE, .reads_content = true,
                                .writes_content = true },
    [RG_UNIFORM] = { "uniform", 0, ACCESS(UNIFORM_READ), .buffer_usage = BUFFER(UNIFORM_BUFFER),
                     DESCRIPTORS(MAX_ENUM, UNIFORM_BUFFER), .reads_content = true },
    [RG_TRACE] = { "trace", 0, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR,
                   .buffer_usage = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR,
                   DESCRIPTORS(MAX_ENUM, ACCELERATION_STRUCTURE_KHR), .reads_content = true },
    [RG_VERTEX] = { "vertex", STAGE(VERTEX_ATTRIBUTE_INPUT), ACCESS(VERTEX_ATTRIBUTE_READ),
                    .buffer_usage = BUFFER(VERTEX_BUFFER), NO_DESCRIPTOR, .reads_content = true },
    [RG_INDEX] = { "index", STAGE(INDEX_INPUT), ACCESS(INDEX_READ),
                   .buffer_usage = BUFFER(INDEX_BUFFER), NO_DESCRIPTOR, .reads_content = true },
    [RG_INDIRECT] = { "indirect", STAGE(DRAW_INDIRECT), ACCESS(INDIRECT_COMMAND_READ),
                      .buffer_usage = BUFFER(INDIRECT_BUFFER), NO_DESCRIPTOR,
                      .reads_content = true },
    [RG_COPY_SRC] = { "copy source", STAGE(ALL_TRANSFER), ACCESS(TRANSFER_READ), 0,
                      LAYOUT(TRANSFER_SRC_OPTIMAL), IMAGE(TRANSFER_SRC), BUFFER(TRANSFER_SRC),
                      FEATURE(TRANSFER_SRC), NO_DESCRIPTOR, .reads_content = true },
    [RG_COPY_DST] = { "copy destination", STAGE(ALL_TRANSFER), 0, ACCESS(TRANSFER_WRITE),
                      LAYOUT(TRANSFER_DST_OPTIMAL), IMAGE(TRANSFER_DST), BUFFER(TRANSFER_DST),
                      FEATURE(TRANSFER_DST), NO_DESCRIPTOR, .writes_content = true },
    [RG_HOST_READ] = { "host read", STAGE(HOST), ACCESS(HOST_READ), 0, LAYOUT(GENERAL),
                       NO_DESCRIPTOR, .reads_content = true },
    /* ALL_COMMANDS makes the frame's semaphore wait until the layout transition has finished */
    [RG_PRESENT] = { "present", STAGE(ALL_COMMANDS), 0, 0, LAYOUT(PRESENT_SRC_KHR), NO_DESCRIPTOR,
                     .reads_content = true },
};

/* clang-format on */

const struct rg_access_info *rg_access_info(enum rg_access access)
{
    return &rg_access_table[(unsigned)access < RG_ACCESS_COUNT ? access : RG_ACCESS_NONE];
}

VkDescriptorType rg_use_descriptor(const struct rg_use *use)
{
    const struct rg_access_info *info = rg_access_info(use->access);
    if (use->image)
        return info->image_descriptor;
    return use->texels ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER : info->buffer_descriptor;
}
