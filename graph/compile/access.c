/* access.c: the one table that turns an access into Vulkan's words, and what follows from it. */
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
#define STORAGE \
    .layout = LAYOUT(GENERAL), .image_usage = IMAGE(STORAGE), \
    .buffer_usage = BUFFER(STORAGE_BUFFER), .format_features = FEATURE(STORAGE_IMAGE), \
    DESCRIPTORS(STORAGE_IMAGE, STORAGE_BUFFER)

const struct rg_access_info rg_access_table[RG_ACCESS_COUNT] = {
    [RG_ACCESS_NONE] = { .name = "none", NO_DESCRIPTOR },
    [RG_COLOR] = { .name = "color",
                   .stages = STAGE(COLOR_ATTACHMENT_OUTPUT),
                   .reads = ACCESS(COLOR_ATTACHMENT_READ),
                   .writes = ACCESS(COLOR_ATTACHMENT_WRITE),
                   .layout = LAYOUT(COLOR_ATTACHMENT_OPTIMAL),
                   .image_usage = IMAGE(COLOR_ATTACHMENT),
                   .format_features = FEATURE(COLOR_ATTACHMENT),
                   .writes_content = true,
                   NO_DESCRIPTOR },
    [RG_DEPTH] = { .name = "depth",
                   .stages = DEPTH_STAGES,
                   .reads = ACCESS(DEPTH_STENCIL_ATTACHMENT_READ),
                   .writes = ACCESS(DEPTH_STENCIL_ATTACHMENT_WRITE),
                   .layout = LAYOUT(DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
                   .image_usage = IMAGE(DEPTH_STENCIL_ATTACHMENT),
                   .format_features = FEATURE(DEPTH_STENCIL_ATTACHMENT),
                   .writes_content = true,
                   NO_DESCRIPTOR },
    [RG_DEPTH_READ] = { .name = "depth read",
                        .stages = DEPTH_STAGES,
                        .reads = ACCESS(DEPTH_STENCIL_ATTACHMENT_READ),
                        .layout = LAYOUT(DEPTH_STENCIL_READ_ONLY_OPTIMAL),
                        .image_usage = IMAGE(DEPTH_STENCIL_ATTACHMENT),
                        .format_features = FEATURE(DEPTH_STENCIL_ATTACHMENT),
                        .reads_content = true,
                        NO_DESCRIPTOR },
    [RG_RESOLVE] = { .name = "resolve",
                     .stages = STAGE(COLOR_ATTACHMENT_OUTPUT),
                     .writes = ACCESS(COLOR_ATTACHMENT_WRITE),
                     .layout = LAYOUT(COLOR_ATTACHMENT_OPTIMAL),
                     .image_usage = IMAGE(COLOR_ATTACHMENT),
                     .format_features = FEATURE(COLOR_ATTACHMENT),
                     .writes_content = true,
                     NO_DESCRIPTOR },
    [RG_SAMPLED] = { .name = "sampled",
                     .reads = ACCESS(SHADER_SAMPLED_READ),
                     .layout = LAYOUT(SHADER_READ_ONLY_OPTIMAL),
                     .image_usage = IMAGE(SAMPLED),
                     .format_features = FEATURE(SAMPLED_IMAGE),
                     .reads_content = true,
                     DESCRIPTORS(COMBINED_IMAGE_SAMPLER, MAX_ENUM) },
    [RG_STORAGE_READ] = { .name = "storage read",
                          .reads = ACCESS(SHADER_STORAGE_READ),
                          .reads_content = true,
                          STORAGE },
    [RG_STORAGE_WRITE] = { .name = "storage write",
                           .writes = ACCESS(SHADER_STORAGE_WRITE),
                           .writes_content = true,
                           STORAGE },
    [RG_STORAGE_READ_WRITE] = { .name = "storage read write",
                                .reads = ACCESS(SHADER_STORAGE_READ),
                                .writes = ACCESS(SHADER_STORAGE_WRITE),
                                .reads_content = true,
                                .writes_content = true,
                                STORAGE },
    [RG_UNIFORM] = { .name = "uniform",
                     .reads = ACCESS(UNIFORM_READ),
                     .buffer_usage = BUFFER(UNIFORM_BUFFER),
                     .reads_content = true,
                     DESCRIPTORS(MAX_ENUM, UNIFORM_BUFFER) },
    [RG_VERTEX] = { .name = "vertex",
                    .stages = STAGE(VERTEX_ATTRIBUTE_INPUT),
                    .reads = ACCESS(VERTEX_ATTRIBUTE_READ),
                    .buffer_usage = BUFFER(VERTEX_BUFFER),
                    .reads_content = true,
                    NO_DESCRIPTOR },
    [RG_INDEX] = { .name = "index",
                   .stages = STAGE(INDEX_INPUT),
                   .reads = ACCESS(INDEX_READ),
                   .buffer_usage = BUFFER(INDEX_BUFFER),
                   .reads_content = true,
                   NO_DESCRIPTOR },
    [RG_INDIRECT] = { .name = "indirect",
                      .stages = STAGE(DRAW_INDIRECT),
                      .reads = ACCESS(INDIRECT_COMMAND_READ),
                      .buffer_usage = BUFFER(INDIRECT_BUFFER),
                      .reads_content = true,
                      NO_DESCRIPTOR },
    [RG_COPY_SRC] = { .name = "copy source",
                      .stages = STAGE(ALL_TRANSFER),
                      .reads = ACCESS(TRANSFER_READ),
                      .layout = LAYOUT(TRANSFER_SRC_OPTIMAL),
                      .image_usage = IMAGE(TRANSFER_SRC),
                      .buffer_usage = BUFFER(TRANSFER_SRC),
                      .format_features = FEATURE(TRANSFER_SRC),
                      .reads_content = true,
                      NO_DESCRIPTOR },
    [RG_COPY_DST] = { .name = "copy destination",
                      .stages = STAGE(ALL_TRANSFER),
                      .writes = ACCESS(TRANSFER_WRITE),
                      .layout = LAYOUT(TRANSFER_DST_OPTIMAL),
                      .image_usage = IMAGE(TRANSFER_DST),
                      .buffer_usage = BUFFER(TRANSFER_DST),
                      .format_features = FEATURE(TRANSFER_DST),
                      .writes_content = true,
                      NO_DESCRIPTOR },
    [RG_HOST_READ] = { .name = "host read",
                       .stages = STAGE(HOST),
                       .reads = ACCESS(HOST_READ),
                       .layout = LAYOUT(GENERAL),
                       .reads_content = true,
                       NO_DESCRIPTOR },
    /* All stages, so that a semaphore signalled after all commands comes after the new layout. */
    [RG_PRESENT] = { .name = "present",
                     .stages = STAGE(ALL_COMMANDS),
                     .layout = LAYOUT(PRESENT_SRC_KHR),
                     .reads_content = true,
                     NO_DESCRIPTOR },
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

uint32_t rg_visibility(enum rg_access kind, VkPipelineStageFlags2 stages)
{
    uint32_t bit = visibility_bits[kind];
    if (!rg_is_shader_access(kind))
        return bit;
    uint32_t visibility = stages & ~RG_ANY_SHADER ? ~RG_VISIBLE_TO_ALL : 0;
    visibility |= stages & STAGE(VERTEX_SHADER) ? bit : 0;
    visibility |= stages & STAGE(FRAGMENT_SHADER) ? bit << 1 : 0;
    visibility |= stages & STAGE(COMPUTE_SHADER) ? bit << 2 : 0;
    return visibility;
}

struct access rg_boundary_access(struct resource *r, enum rg_access kind)
{
    const struct rg_access_info *info = &rg_access_table[kind];
    bool shader = !info->stages && (info->reads || info->writes);
    struct access a;
    rg_access_init(&a, r, kind, true, shader ? RG_ANY_SHADER : info->stages);
    a.flags |= ACCESS_READS;
    return a;
}

#define KIND_BIT(kind) (1u << (kind))
#define BY_SHADERS     (KIND_BIT(RG_RASTER) | KIND_BIT(RG_COMPUTE))

/* The kinds of pass that may have such a use. */
static const uint8_t kinds_of_use[RG_ACCESS_COUNT] = {
    [RG_SAMPLED] = BY_SHADERS,
    [RG_STORAGE_READ] = BY_SHADERS,
    [RG_STORAGE_WRITE] = BY_SHADERS,
    [RG_STORAGE_READ_WRITE] = BY_SHADERS,
    [RG_UNIFORM] = BY_SHADERS,
    [RG_VERTEX] = KIND_BIT(RG_RASTER),
    [RG_INDEX] = KIND_BIT(RG_RASTER),
    [RG_INDIRECT] = BY_SHADERS,
    [RG_COPY_SRC] = KIND_BIT(RG_TRANSFER),
    [RG_COPY_DST] = KIND_BIT(RG_TRANSFER),
};

static const VkPipelineStageFlags2 stages_of_kind[] = {
    [RG_RASTER] = STAGE(VERTEX_SHADER) | STAGE(FRAGMENT_SHADER),
    [RG_COMPUTE] = STAGE(COMPUTE_SHADER),
    [RG_TRANSFER] = VK_PIPELINE_STAGE_2_NONE,
};

/* A wild value counts as compute. */
static enum rg_kind kind_of(const struct rg_pass *pass)
{
    return (unsigned)pass->kind <= RG_TRANSFER ? pass->kind : RG_COMPUTE;
}

VkPipelineStageFlags2 rg_use_stages(const struct rg_pass *pass, const struct rg_use *use)
{
    if (rg_access_table[use->access].stages)
        return rg_access_table[use->access].stages;
    if (use->stages)
        return use->stages;
    if (kind_of(pass) == RG_RASTER && use->access != RG_UNIFORM)
        return STAGE(FRAGMENT_SHADER);
    return stages_of_kind[kind_of(pass)];
}

const char *rg_use_trouble(const struct rg_pass *pass, const struct rg_use *use)
{
    const struct rg_access_info *info = &rg_access_table[use->access];
    if (!(kinds_of_use[use->access] & KIND_BIT(kind_of(pass))))
        return "this kind of pass cannot do that; targets go into .color and .depth";
    if (use->stages & ~stages_of_kind[kind_of(pass)])
        return "name only stages of the shaders that the pass has";
    if (use->image && !info->image_usage)
        return "an image cannot be used so";
    if (use->buffer && !info->buffer_usage)
        return "a buffer cannot be used so";
    if (use->buffer && use->buffer->memory == RG_MEMORY_UPLOAD && info->writes_content)
        return "the CPU writes this buffer; a pass may only read it";
    if (use->fallback && (use->access != RG_SAMPLED || use->image->samples > 1 ||
                          !rg_format_info(use->image->format)))
        return "only a sampled image, of a known format and one sample a texel, has a fallback";
    return NULL;
}
