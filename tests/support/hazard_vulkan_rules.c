/* hazard_vulkan_rules.c: stages, accesses, layouts and usages of each rg_access in Vulkan 1.3. */
#include "tests/support/hazard_private.h"

#define COPIES   (HAZARD_COPY | HAZARD_BLIT | HAZARD_RESOLVE)
#define TESTS    (HAZARD_EARLY | HAZARD_LATE)
#define DS_READ  VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT
#define DS_WRITE VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT

#define STRUCTURE_READ  VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR
#define STRUCTURE_WRITE VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR

static const struct hazard_rule rules[RG_ACCESS_COUNT] = {
    [RG_COLOR] = { VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                   HAZARD_COLOR, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0 },
    [RG_DEPTH] = { DS_READ, DS_WRITE, TESTS, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0 },
    [RG_DEPTH_READ] = { DS_READ, 0, TESTS, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
                        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0 },
    [RG_RESOLVE] = { 0, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, HAZARD_COLOR,
                     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                     0 },
    [RG_SAMPLED] = { VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0, 0,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_SAMPLED_BIT,
                     VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT },
    [RG_STORAGE_READ] = { VK_ACCESS_2_SHADER_STORAGE_READ_BIT, 0, 0, VK_IMAGE_LAYOUT_GENERAL,
                          VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT },
    [RG_STORAGE_WRITE] = { 0, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, 0, VK_IMAGE_LAYOUT_GENERAL,
                           VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT },
    [RG_STORAGE_READ_WRITE] = { VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
                                VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, 0, VK_IMAGE_LAYOUT_GENERAL,
                                VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT },
    [RG_UNIFORM] = { VK_ACCESS_2_UNIFORM_READ_BIT, 0, 0, 0, 0, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT },
    [RG_TRACE] = { STRUCTURE_READ, 0, 0, 0, 0,
                   VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR },
    [RG_VERTEX] = { VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, 0, HAZARD_ATTRIBUTE, 0, 0,
                    VK_BUFFER_USAGE_VERTEX_BUFFER_BIT },
    [RG_INDEX] = { VK_ACCESS_2_INDEX_READ_BIT, 0, HAZARD_INDEX, 0, 0,
                   VK_BUFFER_USAGE_INDEX_BUFFER_BIT },
    [RG_INDIRECT] = { VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0, HAZARD_INDIRECT, 0, 0,
                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT },
    [RG_COPY_SRC] = { VK_ACCESS_2_TRANSFER_READ_BIT, 0, COPIES,
                      VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT },
    [RG_COPY_DST] = { 0, VK_ACCESS_2_TRANSFER_WRITE_BIT, COPIES,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                      VK_BUFFER_USAGE_TRANSFER_DST_BIT },
    [RG_HOST_READ] = { VK_ACCESS_2_HOST_READ_BIT, 0, HAZARD_HOST, VK_IMAGE_LAYOUT_GENERAL, 0, 0 },
    [RG_PRESENT] = { 0, 0, HAZARD_DEVICE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, 0, 0 },
};

const struct hazard_rule *hazard_rule(enum rg_access access)
{
    return &rules[access];
}

static const struct {
    VkPipelineStageFlags2 vulkan;
    uint32_t stages;
} stage_names[] = {
    { VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, HAZARD_INDIRECT },
    { VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT, HAZARD_INDEX | HAZARD_ATTRIBUTE },
    { VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, HAZARD_INDEX },
    { VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, HAZARD_ATTRIBUTE },
    { VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, HAZARD_VERTEX },
    { VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, HAZARD_VERTEX },
    { VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, HAZARD_EARLY },
    { VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, HAZARD_FRAGMENT },
    { VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, HAZARD_LATE },
    { VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, HAZARD_COLOR },
    { VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, HAZARD_COMPUTE },
    { VK_PIPELINE_STAGE_2_COPY_BIT, HAZARD_COPY },
    { VK_PIPELINE_STAGE_2_RESOLVE_BIT, HAZARD_RESOLVE },
    { VK_PIPELINE_STAGE_2_BLIT_BIT, HAZARD_BLIT },
    { VK_PIPELINE_STAGE_2_CLEAR_BIT, HAZARD_CLEAR },
    { VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, COPIES | HAZARD_CLEAR },
    { VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, HAZARD_BUILD },
    { VK_PIPELINE_STAGE_2_HOST_BIT, HAZARD_HOST },
    { VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT, HAZARD_GRAPHICS },
    { VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, HAZARD_DEVICE },
};

uint32_t hazard_stages(VkPipelineStageFlags2 stages, bool source)
{
    uint32_t found = 0;
    for (size_t i = 0; i < sizeof(stage_names) / sizeof(stage_names[0]); i++)
        if (stages & stage_names[i].vulkan)
            found |= stage_names[i].stages;
    VkPipelineStageFlags2 everything =
        source ? VK_PIPELINE_STAGE_2_BOTTOM_OF_PIPE_BIT : VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT;
    if (stages & everything)
        found |= HAZARD_DEVICE;
    return found;
}

uint32_t hazard_earlier(uint32_t stages)
{
    uint32_t graphics = stages & HAZARD_GRAPHICS;
    graphics |= graphics >> 1;
    graphics |= graphics >> 2;
    graphics |= graphics >> 4;
    if (stages & HAZARD_COMPUTE)
        graphics |= HAZARD_INDIRECT;
    return stages | graphics;
}

uint32_t hazard_later(uint32_t stages)
{
    uint32_t graphics = stages & HAZARD_GRAPHICS;
    graphics |= graphics << 1;
    graphics |= graphics << 2;
    graphics |= graphics << 4;
    graphics &= HAZARD_GRAPHICS;
    if (stages & HAZARD_INDIRECT)
        graphics |= HAZARD_COMPUTE;
    return stages | graphics;
}

static const struct {
    VkAccessFlags2 access;
    uint32_t stages;
    bool write;
} abilities[] = {
    { VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, HAZARD_INDIRECT, false },
    { VK_ACCESS_2_INDEX_READ_BIT, HAZARD_INDEX, false },
    { VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, HAZARD_ATTRIBUTE, false },
    { VK_ACCESS_2_UNIFORM_READ_BIT, HAZARD_SHADERS, false },
    { VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, HAZARD_SHADERS, false },
    { VK_ACCESS_2_SHADER_STORAGE_READ_BIT, HAZARD_SHADERS | HAZARD_BUILD, false },
    { VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, HAZARD_SHADERS, true },
    { VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, HAZARD_COLOR, false },
    { VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, HAZARD_COLOR, true },
    { DS_READ, TESTS, false },
    { DS_WRITE, TESTS, true },
    { VK_ACCESS_2_TRANSFER_READ_BIT, COPIES, false },
    { VK_ACCESS_2_TRANSFER_WRITE_BIT, COPIES | HAZARD_CLEAR, true },
    { STRUCTURE_READ, HAZARD_SHADERS | HAZARD_BUILD, false },
    { STRUCTURE_WRITE, HAZARD_BUILD, true },
    { VK_ACCESS_2_HOST_READ_BIT, HAZARD_HOST, false },
    { VK_ACCESS_2_HOST_WRITE_BIT, HAZARD_HOST, true },
};

#define ABILITY_COUNT (sizeof(abilities) / sizeof(abilities[0]))

VkAccessFlags2 hazard_accesses(VkAccessFlags2 access)
{
    if (access & VK_ACCESS_2_SHADER_READ_BIT)
        access |= VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    if (access & VK_ACCESS_2_SHADER_WRITE_BIT)
        access |= VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    for (size_t i = 0; i < ABILITY_COUNT; i++)
        if (access &
            (abilities[i].write ? VK_ACCESS_2_MEMORY_WRITE_BIT : VK_ACCESS_2_MEMORY_READ_BIT))
            access |= abilities[i].access;
    return access;
}

VkAccessFlags2 hazard_accesses_of(uint32_t stage)
{
    VkAccessFlags2 access = 0;
    for (size_t i = 0; i < ABILITY_COUNT; i++)
        if (abilities[i].stages & stage)
            access |= abilities[i].access;
    return access;
}

bool hazard_access_fits(uint32_t stages, VkAccessFlags2 access)
{
    VkAccessFlags2 known = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    if (stages & HAZARD_BUILD)
        known |= VK_ACCESS_2_SHADER_READ_BIT;
    if (stages & HAZARD_SHADERS)
        known |= VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT;
    known |= hazard_accesses_of(stages);
    return (access & ~known) == 0;
}

static bool is_attachment_layout(VkImageLayout layout)
{
    return layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL ||
           layout == VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
}

static bool is_read_only_layout(VkImageLayout layout)
{
    return layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL ||
           layout == VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
}

bool hazard_layout_fits(VkImageLayout layout, enum rg_access access, VkImageAspectFlags aspects)
{
    bool only_depth = aspects == VK_IMAGE_ASPECT_DEPTH_BIT;
    if (layout == VK_IMAGE_LAYOUT_GENERAL)
        return access != RG_PRESENT;
    if (layout == rules[access].layout)
        return true;
    if (access == RG_COLOR || access == RG_RESOLVE)
        return layout == VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    if (access == RG_DEPTH)
        return is_attachment_layout(layout) ||
               (only_depth && layout == VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    if (access == RG_DEPTH_READ)
        return is_attachment_layout(layout) || is_read_only_layout(layout) ||
               (only_depth && layout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    if (access == RG_SAMPLED)
        return is_read_only_layout(layout) || layout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL;
    return false;
}

VkImageUsageFlags hazard_layout_usage(VkImageLayout layout)
{
    VkImageUsageFlags needed = 0;
    for (size_t i = 0; i < RG_ACCESS_COUNT; i++)
        if (rules[i].layout == layout && layout != VK_IMAGE_LAYOUT_GENERAL)
            needed |= rules[i].image_usage;
    return needed;
}

static const struct {
    VkFormat format;
    uint32_t size;
    VkImageAspectFlags aspects;
} formats[] = {
    { VK_FORMAT_R8_UNORM, 1, VK_IMAGE_ASPECT_COLOR_BIT },
    { VK_FORMAT_R8G8B8A8_UNORM, 4, VK_IMAGE_ASPECT_COLOR_BIT },
    { VK_FORMAT_R32_UINT, 4, VK_IMAGE_ASPECT_COLOR_BIT },
    { VK_FORMAT_R32_SFLOAT, 4, VK_IMAGE_ASPECT_COLOR_BIT },
    { VK_FORMAT_R16G16B16A16_SFLOAT, 8, VK_IMAGE_ASPECT_COLOR_BIT },
    { VK_FORMAT_R32G32B32A32_SFLOAT, 16, VK_IMAGE_ASPECT_COLOR_BIT },
    { VK_FORMAT_D16_UNORM, 2, VK_IMAGE_ASPECT_DEPTH_BIT },
    { VK_FORMAT_X8_D24_UNORM_PACK32, 4, VK_IMAGE_ASPECT_DEPTH_BIT },
    { VK_FORMAT_S8_UINT, 1, VK_IMAGE_ASPECT_STENCIL_BIT },
    { VK_FORMAT_D16_UNORM_S8_UINT, 3, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT },
    { VK_FORMAT_D32_SFLOAT, 4, VK_IMAGE_ASPECT_DEPTH_BIT },
    { VK_FORMAT_D24_UNORM_S8_UINT, 4, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT },
    { VK_FORMAT_D32_SFLOAT_S8_UINT, 5, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT },
};

VkImageAspectFlags hazard_aspects(VkFormat format)
{
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
        if (formats[i].format == format)
            return formats[i].aspects;
    return VK_IMAGE_ASPECT_COLOR_BIT;
}

uint32_t hazard_texel_size(VkFormat format)
{
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
        if (formats[i].format == format)
            return formats[i].size;
    return 1;
}
