/* words.c: the words of the dumps: characters, flags, layouts. */
#include <inttypes.h>
#include "graph/dump/dump.h"

enum {
    REPLACEMENT = 0xfffd
};

uint32_t rg_dump_character(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    uint32_t length = *s < 0x80   ? 1
                      : *s < 0xc2 ? 0
                      : *s < 0xe0 ? 2
                      : *s < 0xf0 ? 3
                      : *s < 0xf5 ? 4
                                  : 0;
    uint32_t c = length == 1 ? *s : *s & 0xffu >> (length + 1);
    for (uint32_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) /* the text's end too */
            length = 0;
        else
            c = c << 6 | (s[i] & 0x3fu);
    }
    bool too_long = (length == 3 && c < 0x800) || (length == 4 && c < 0x10000);
    bool surrogate = c >= 0xd800 && c < 0xe000;
    if (!length || too_long || (length > 1 && surrogate) || c > 0x10ffff) {
        *text += 1;
        return REPLACEMENT;
    }
    *text += length;
    return c;
}

uint32_t rg_dump_visible(uint32_t character)
{
    bool control = character < 0x20 || (character >= 0x7f && character < 0xa0);
    return control || character == 0xfffe || character == 0xffff ? REPLACEMENT : character;
}

void rg_dump_utf8(FILE *out, uint32_t character)
{
    static const unsigned char leads[] = { 0, 0xc0, 0xe0, 0xf0 };
    int rest = character < 0x80 ? 0 : character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
    fputc((int)(leads[rest] | character >> (6 * rest)), out);
    while (rest--)
        fputc((int)(0x80 | (character >> (6 * rest) & 0x3f)), out);
}

void rg_dump_bytes(FILE *out, VkDeviceSize size)
{
    static const char *const units[] = { "B", "KiB", "MiB", "GiB", "TiB" };
    size_t unit = 0;
    VkDeviceSize rest = 0;
    for (; size >= 1024 && unit + 1 < sizeof(units) / sizeof(units[0]); size /= 1024, unit++)
        rest = size % 1024;
    fprintf(out, "%" PRIu64, size);
    if (unit)
        fprintf(out, ".%" PRIu64, rest * 10 / 1024);
    fprintf(out, " %s", units[unit]);
}

/* A flag, or a value of an enum. */
struct bit_name {
    uint64_t bit;
    const char *name;
};

static const struct bit_name aspect_names[] = {
    { VK_IMAGE_ASPECT_COLOR_BIT, "color" },
    { VK_IMAGE_ASPECT_DEPTH_BIT, "depth" },
    { VK_IMAGE_ASPECT_STENCIL_BIT, "stencil" },
    { 0, NULL },
};

static const struct bit_name stage_names[] = {
    { VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, "indirect" },
    { VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, "index" },
    { VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, "attribute" },
    { VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, "vertex" },
    { VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, "fragment" },
    { VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, "early" },
    { VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, "late" },
    { VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, "color" },
    { VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, "compute" },
    { VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, "transfer" },
    { VK_PIPELINE_STAGE_2_HOST_BIT, "host" },
    { VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, "all" },
    { 0, NULL },
};

static const struct bit_name access_names[] = {
    { VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, "indirect_read" },
    { VK_ACCESS_2_INDEX_READ_BIT, "index_read" },
    { VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, "attribute_read" },
    { VK_ACCESS_2_UNIFORM_READ_BIT, "uniform_read" },
    { VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "sampled_read" },
    { VK_ACCESS_2_SHADER_STORAGE_READ_BIT, "storage_read" },
    { VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, "storage_write" },
    { VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, "color_read" },
    { VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, "color_write" },
    { VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, "depth_read" },
    { VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, "depth_write" },
    { VK_ACCESS_2_TRANSFER_READ_BIT, "transfer_read" },
    { VK_ACCESS_2_TRANSFER_WRITE_BIT, "transfer_write" },
    { VK_ACCESS_2_HOST_READ_BIT, "host_read" },
    { VK_ACCESS_2_MEMORY_READ_BIT, "memory_read" },
    { VK_ACCESS_2_MEMORY_WRITE_BIT, "memory_write" },
    { 0, NULL },
};

static void print_bits(FILE *out, uint64_t bits, const struct bit_name *names,
                       const char *separator)
{
    const char *before = "";
    for (; names->name; names++) {
        if (!(bits & names->bit))
            continue;
        fprintf(out, "%s%s", before, names->name);
        before = separator;
        bits &= ~names->bit;
    }
    if (bits)
        fprintf(out, "%s0x%" PRIx64, before, bits);
}

void rg_dump_stages(FILE *out, VkPipelineStageFlags2 stages, const char *separator)
{
    print_bits(out, stages, stage_names, separator);
}

void rg_dump_accesses(FILE *out, VkAccessFlags2 accesses, const char *separator)
{
    print_bits(out, accesses, access_names, separator);
}

void rg_dump_aspects(FILE *out, VkImageAspectFlags aspects, const char *separator)
{
    print_bits(out, aspects, aspect_names, separator);
}

const char *rg_dump_layout(VkImageLayout layout)
{
    static const struct bit_name names[] = {
        { VK_IMAGE_LAYOUT_UNDEFINED, "undefined" },
        { VK_IMAGE_LAYOUT_GENERAL, "general" },
        { VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, "color" },
        { VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, "depth" },
        { VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, "depth_read" },
        { VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, "shader_read" },
        { VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, "transfer_src" },
        { VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, "transfer_dst" },
        { VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, "present" },
    };

    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        if (names[i].bit == (uint64_t)layout)
            return names[i].name;
    }
    return "?";
}

const char *rg_dump_load(VkAttachmentLoadOp load)
{
    return load == VK_ATTACHMENT_LOAD_OP_LOAD    ? "load"
           : load == VK_ATTACHMENT_LOAD_OP_CLEAR ? "clear"
                                                 : "dont_care";
}

const char *rg_dump_store(VkAttachmentStoreOp store)
{
    return store == VK_ATTACHMENT_STORE_OP_STORE  ? "store"
           : store == VK_ATTACHMENT_STORE_OP_NONE ? "none"
                                                  : "dont_care";
}

const char *rg_dump_kind(enum rg_kind kind)
{
    static const char *const kinds[] = {
        [RG_RASTER] = "raster",
        [RG_COMPUTE] = "compute",
        [RG_TRANSFER] = "transfer",
    };
    return kinds[kind];
}

const char *rg_dump_depth(const struct rg_pass *pass)
{
    return rg_access_info(pass->depth_read_only ? RG_DEPTH_READ : RG_DEPTH)->name;
}

uint32_t rg_dump_binding(const struct rg_plan_use *use)
{
    const struct rg_access_info *info = rg_access_info(use->use->access);
    VkDescriptorType type =
        use->image != RG_NONE ? info->image_descriptor : info->buffer_descriptor;
    return type == VK_DESCRIPTOR_TYPE_MAX_ENUM ? RG_NONE : use->use->binding;
}

uint32_t rg_dump_barrier_count(const struct rg_plan *plan)
{
    uint32_t count = plan->final_barrier_count;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        count += plan->passes[i].barrier_count;
    return count;
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
