/* flag_names.c: names of flags, layouts and operations in dumps. */
#include <inttypes.h>
#include "graph/dump/dump_internal.h"

const struct rg_dump_flag_name rg_dump_aspects[] = {
    { "color", VK_IMAGE_ASPECT_COLOR_BIT },
    { "depth", VK_IMAGE_ASPECT_DEPTH_BIT },
    { "stencil", VK_IMAGE_ASPECT_STENCIL_BIT },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_stages[] = {
    { "indirect", VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT },
    { "index", VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT },
    { "attribute", VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT },
    { "vertex", VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT },
    { "fragment", VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT },
    { "early", VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT },
    { "late", VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT },
    { "color", VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT },
    { "compute", VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT },
    { "transfer", VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT },
    { "build", VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR },
    { "host", VK_PIPELINE_STAGE_2_HOST_BIT },
    { "all", VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_accesses[] = {
    { "indirect_read", VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT },
    { "index_read", VK_ACCESS_2_INDEX_READ_BIT },
    { "attribute_read", VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT },
    { "uniform_read", VK_ACCESS_2_UNIFORM_READ_BIT },
    { "sampled_read", VK_ACCESS_2_SHADER_SAMPLED_READ_BIT },
    { "storage_read", VK_ACCESS_2_SHADER_STORAGE_READ_BIT },
    { "storage_write", VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT },
    { "color_read", VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT },
    { "color_write", VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT },
    { "depth_read", VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT },
    { "depth_write", VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT },
    { "transfer_read", VK_ACCESS_2_TRANSFER_READ_BIT },
    { "transfer_write", VK_ACCESS_2_TRANSFER_WRITE_BIT },
    { "structure_read", VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR },
    { "structure_write", VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR },
    { "shader_read", VK_ACCESS_2_SHADER_READ_BIT },
    { "host_read", VK_ACCESS_2_HOST_READ_BIT },
    { "memory_read", VK_ACCESS_2_MEMORY_READ_BIT },
    { "memory_write", VK_ACCESS_2_MEMORY_WRITE_BIT },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_layouts[] = {
    { "undefined", VK_IMAGE_LAYOUT_UNDEFINED },
    { "general", VK_IMAGE_LAYOUT_GENERAL },
    { "color", VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL },
    { "depth", VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL },
    { "depth_read", VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL },
    { "shader_read", VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL },
    { "transfer_src", VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL },
    { "transfer_dst", VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL },
    { "present", VK_IMAGE_LAYOUT_PRESENT_SRC_KHR },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_loads[] = {
    { "load", VK_ATTACHMENT_LOAD_OP_LOAD },
    { "clear", VK_ATTACHMENT_LOAD_OP_CLEAR },
    { "dont_care", VK_ATTACHMENT_LOAD_OP_DONT_CARE },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_stores[] = {
    { "store", VK_ATTACHMENT_STORE_OP_STORE },
    { "none", VK_ATTACHMENT_STORE_OP_NONE },
    { "dont_care", VK_ATTACHMENT_STORE_OP_DONT_CARE },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_queues[] = {
    { "main", RG_QUEUE_MAIN },
    { "compute", RG_QUEUE_COMPUTE },
    { "transfer", RG_QUEUE_TRANSFER },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_kinds[] = {
    { "raster", RG_RASTER },
    { "compute", RG_COMPUTE },
    { "transfer", RG_TRANSFER },
    { NULL, 0 },
};

const struct rg_dump_flag_name rg_dump_memories[] = {
    { "device", RG_MEMORY_DEVICE },
    { "upload", RG_MEMORY_UPLOAD },
    { "readback", RG_MEMORY_READBACK },
    { NULL, 0 },
};

const char *rg_dump_flag_name(const struct rg_dump_flag_name *words, uint64_t value)
{
    while (words->word && words->value != value)
        words++;
    return words->word ? words->word : "?";
}

void rg_dump_flags(FILE *out, const struct rg_dump_flag_name *words, uint64_t flags,
                   const char *separator)
{
    const char *before = "";
    for (; words->word; words++) {
        if (!(flags & words->value))
            continue;
        fprintf(out, "%s%s", before, words->word);
        before = separator;
        flags &= ~words->value;
    }
    if (flags)
        fprintf(out, "%s0x%" PRIx64, before, flags);
}

const char *rg_dump_depth(const struct rg_pass *pass)
{
    return rg_access_info(pass->depth_read_only ? RG_DEPTH_READ : RG_DEPTH)->name;
}

uint32_t rg_dump_binding(const struct rg_plan_use *use)
{
    VkDescriptorType type = rg_use_descriptor(use->use);
    return type == VK_DESCRIPTOR_TYPE_MAX_ENUM ? RG_NONE : use->use->binding;
}

struct rg_dump_resource rg_dump_resource(const struct rg_plan *plan, uint32_t index)
{
    if (index < plan->image_count) {
        const struct rg_plan_image *i = &plan->images[index];
        return (struct rg_dump_resource){ i->image->name, i->imported, i->persistent,
                                          false,          i->first,    i->last,
                                          i->block,       i->offset,   i->size };
    }
    const struct rg_plan_buffer *b = &plan->buffers[index - plan->image_count];
    return (struct rg_dump_resource){
        b->buffer->name, b->imported,
        b->persistent,   !b->imported && b->buffer->memory != RG_MEMORY_DEVICE,
        b->first,        b->last,
        b->block,        b->offset,
        b->memory_size
    };
}
