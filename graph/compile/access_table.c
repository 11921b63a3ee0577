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

/* Lowest bit of each access in the mask cell.visible. Shader accesses use 3 bits, one per stage. */
static const uint32_t visibility_bits[RG_ACCESS_COUNT] = {
    [RG_SAMPLED] = 1 << 0,   [RG_STORAGE_READ] = 1 << 3, [RG_UNIFORM] = 1 << 6,
    [RG_COLOR] = 1 << 9,     [RG_DEPTH] = 1 << 10,       [RG_DEPTH_READ] = 1 << 10,
    [RG_VERTEX] = 1 << 11,   [RG_INDEX] = 1 << 12,       [RG_INDIRECT] = 1 << 13,
    [RG_COPY_SRC] = 1 << 14, [RG_HOST_READ] = 1 << 15,   [RG_TRACE] = 1 << 16,
};

static uint32_t visibility_of(enum rg_access kind, VkPipelineStageFlags2 stages)
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

struct access *rg_access_init(struct access *a, struct resource *r, enum rg_access kind,
                              VkPipelineStageFlags2 stages)
{
    const struct rg_access_info *info = &rg_access_table[kind];
    a->resource = r;
    a->declared = NULL;
    a->cells = r->cells;
    a->cell_count = r->cell_count;
    a->range = r->all;
    a->kind = kind;
    a->queue = RG_QUEUE_MAIN;
    a->flags = info->reads_content * (uint32_t)ACCESS_READS |
               info->writes_content * (uint32_t)ACCESS_WRITES;
    a->visibility = info->writes_content ? 0 : visibility_of(kind, stages);
    a->layout = r->image ? info->layout : VK_IMAGE_LAYOUT_UNDEFINED;
    a->stages = stages;
    a->mask = info->reads | info->writes;
    return a;
}

struct access rg_boundary_access(struct resource *r, enum rg_access kind)
{
    const struct rg_access_info *info = &rg_access_table[kind];
    bool shader = !info->stages && (info->reads || info->writes);
    struct access a;
    rg_access_init(&a, r, kind, shader ? RG_ANY_SHADER : info->stages);
    a.flags |= ACCESS_READS;
    return a;
}

static const VkShaderStageFlags stages_of_kind[] = {
    [RG_RASTER] = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
    [RG_COMPUTE] = VK_SHADER_STAGE_COMPUTE_BIT,
    [RG_TRANSFER] = 0,
};

/* Returns the kind of a pass. Invalid kinds are treated as compute. */
static enum rg_kind kind_of(const struct rg_pass *pass)
{
    return (unsigned)pass->kind <= RG_TRANSFER ? pass->kind : RG_COMPUTE;
}

VkPipelineStageFlags2 rg_pipeline_stages(VkShaderStageFlags shaders)
{
    return (shaders & VK_SHADER_STAGE_VERTEX_BIT ? STAGE(VERTEX_SHADER) : 0) |
           (shaders & VK_SHADER_STAGE_FRAGMENT_BIT ? STAGE(FRAGMENT_SHADER) : 0) |
           (shaders & VK_SHADER_STAGE_COMPUTE_BIT ? STAGE(COMPUTE_SHADER) : 0);
}

VkPipelineStageFlags2 rg_use_stages(const struct rg_pass *pass, const struct rg_use *use)
{
    const VkPipelineStageFlags2 stages = rg_access_table[use->access].stages;
    VkShaderStageFlags shaders = use->stages;
    if (stages)
        return stages;
    if (!shaders && kind_of(pass) == RG_RASTER && use->access != RG_UNIFORM)
        shaders = VK_SHADER_STAGE_FRAGMENT_BIT;
    else if (!shaders)
        shaders = stages_of_kind[kind_of(pass)];
    return rg_pipeline_stages(shaders);
}

static const char *buffer_problem(const struct rg_use *use, const struct rg_access_info *info)
{
    if (!info->buffer_usage)
        return "this access is for images only";
    if (use->buffer->memory == RG_MEMORY_UPLOAD && info->writes_content)
        return "the CPU writes this buffer; a pass may only read it";
    if ((use->access == RG_SAMPLED || use->texels) && !rg_format_info(use->buffer->format))
        return "set the buffer's texel format (graph/compile/format_table.c)";
    if (use->sampler)
        return "remove the sampler: a texel buffer is read by texelFetch";
    return NULL;
}

/* Returns true if a kind of pass supports an access of its `uses`. */
static bool supports_use(enum rg_kind kind, enum rg_access access)
{
    if (access == RG_VERTEX || access == RG_INDEX)
        return kind == RG_RASTER;
    if (access == RG_COPY_SRC || access == RG_COPY_DST)
        return kind == RG_TRANSFER;
    return kind != RG_TRANSFER && (rg_is_shader_access(access) || access == RG_INDIRECT);
}

const char *rg_use_problem(const struct rg_pass *pass, const struct rg_use *use)
{
    const struct rg_access_info *info = &rg_access_table[use->access];
    const char *problem;
    if (!supports_use(kind_of(pass), use->access))
        return "this kind of pass cannot have this access; targets go into .color and .depth";
    if (use->stages & ~stages_of_kind[kind_of(pass)])
        return "stages: expected only those of the pass's shaders";
    if (use->image && !info->image_usage)
        return "this access is for buffers only";
    if (use->texels && (use->image || !(info->buffer_usage & BUFFER(STORAGE_BUFFER))))
        return "texels: expected a storage buffer access";
    if (use->buffer && (problem = buffer_problem(use, info)))
        return problem;
    if (use->fallback && (use->access != RG_SAMPLED || !use->image || use->image->samples > 1 ||
                          !rg_format_info(use->image->format)))
        return "fallback: expected a sampled image of a known format with one sample per texel";
    return NULL;
}
