/* rg_dump.c: the plan as text and as a Graphviz digraph. */
#include <inttypes.h>
#include "graph/rg.h"

struct bit_name {
    uint64_t bit;
    const char *name;
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
    { VK_ACCESS_2_MEMORY_WRITE_BIT, "memory_write" },
    { 0, NULL },
};

static void print_bits(FILE *out, uint64_t bits, const struct bit_name *names)
{
    const char *separator = "";
    if (!bits)
        fputs("none", out);
    for (; names->name; names++) {
        if (!(bits & names->bit) || (bits & names->bit) != names->bit)
            continue;
        fprintf(out, "%s%s", separator, names->name);
        separator = "|";
        bits &= ~names->bit;
    }
    if (bits)
        fprintf(out, "%s0x%" PRIx64, separator, bits);
}

static const char *layout_name(VkImageLayout layout)
{
    switch ((int)layout) {
    case VK_IMAGE_LAYOUT_UNDEFINED:
        return "undefined";
    case VK_IMAGE_LAYOUT_GENERAL:
        return "general";
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
        return "color";
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
        return "depth";
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
        return "depth_read";
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
        return "shader_read";
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
        return "transfer_src";
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
        return "transfer_dst";
    case VK_IMAGE_LAYOUT_PRESENT_SRC_KHR:
        return "present";
    default:
        return "?";
    }
}

static void print_span(FILE *out, const char *what, uint32_t first, uint32_t count, uint32_t all)
{
    if (count == all)
        return;
    if (count == 1)
        fprintf(out, " %s %u", what, first);
    else
        fprintf(out, " %ss %u-%u", what, first, first + count - 1);
}

static void print_range(FILE *out, const struct rg_plan_image *image,
                        const VkImageSubresourceRange *range)
{
    if (range->aspectMask != image->aspects)
        fprintf(out, " %s", range->aspectMask & VK_IMAGE_ASPECT_STENCIL_BIT ? "stencil" : "depth");
    print_span(out, "mip", range->baseMipLevel, range->levelCount, image->mips);
    print_span(out, "layer", range->baseArrayLayer, range->layerCount, image->layers);
}

static void print_place(FILE *out, bool imported, uint32_t block, VkDeviceSize offset,
                        VkDeviceSize size)
{
    if (imported)
        fputs("imported", out);
    else if (block == RG_NONE)
        fputs("host", out);
    else
        fprintf(out, "block %u offset %" PRIu64 " size %" PRIu64, block, offset, size);
}

static void print_life(FILE *out, const struct rg_plan *plan, uint32_t first, uint32_t last)
{
    if (last == plan->pass_count)
        fprintf(out, ", passes %u-end\n", first);
    else
        fprintf(out, ", passes %u-%u\n", first, last);
}

static void print_resources(FILE *out, const struct rg_plan *plan)
{
    for (uint32_t i = 0; i < plan->image_count; i++) {
        const struct rg_plan_image *image = &plan->images[i];
        fprintf(out, "image %s %s %ux%u", image->image->name,
                rg_format_info(image->image->format)->name, image->extent.width,
                image->extent.height);
        if (image->layers > 1)
            fprintf(out, " layers %u", image->layers);
        if (image->mips > 1)
            fprintf(out, " mips %u", image->mips);
        fputs(image->image->cube ? " cube, " : ", ", out);
        print_place(out, image->imported, image->block, image->offset, image->size);
        print_life(out, plan, image->first, image->last);
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        const struct rg_plan_buffer *buffer = &plan->buffers[i];
        fprintf(out, "buffer %s %" PRIu64 " bytes, ", buffer->buffer->name, buffer->size);
        print_place(out, buffer->imported, buffer->block, buffer->offset, buffer->memory_size);
        print_life(out, plan, buffer->first, buffer->last);
    }
    for (uint32_t i = 0; i < plan->block_count; i++)
        fprintf(out, "block %u %s size %" PRIu64 "\n", i,
                plan->blocks[i].buffers ? "buffers" : "images", plan->blocks[i].size);
    fprintf(out,
            "transient memory: used %" PRIu64 ", without aliasing %" PRIu64 ", bound %" PRIu64 "\n",
            plan->memory_used, plan->memory_without_aliasing, plan->memory_bound);
    fprintf(out, "barriers: %u in %u batches\n", plan->barrier_count, plan->batch_count);
}

static void print_barriers(FILE *out, const struct rg_plan *plan, uint32_t first, uint32_t count)
{
    for (uint32_t i = first; i < first + count; i++) {
        const struct rg_barrier *b = &plan->barriers[i];
        fputs("  barrier ", out);
        if (b->image != RG_NONE) {
            fputs(plan->images[b->image].image->name, out);
            print_range(out, &plan->images[b->image], &b->range);
            fprintf(out, ": %s -> %s", layout_name(b->old_layout), layout_name(b->new_layout));
        } else {
            fprintf(out, "%s:", plan->buffers[b->buffer].buffer->name);
        }
        fputs("  ", out);
        print_bits(out, b->src_stages, stage_names);
        fputs("/", out);
        print_bits(out, b->src_access, access_names);
        fputs(" -> ", out);
        print_bits(out, b->dst_stages, stage_names);
        fputs("/", out);
        print_bits(out, b->dst_access, access_names);
        fputs("\n", out);
    }
}

static void print_target(FILE *out, const struct rg_plan *plan, const struct rg_plan_target *target,
                         const char *what)
{
    const struct rg_plan_image *image = &plan->images[target->image];
    const char *load = target->load == VK_ATTACHMENT_LOAD_OP_LOAD    ? "load"
                       : target->load == VK_ATTACHMENT_LOAD_OP_CLEAR ? "clear"
                                                                     : "dont_care";
    const char *store = target->store == VK_ATTACHMENT_STORE_OP_STORE  ? "store"
                        : target->store == VK_ATTACHMENT_STORE_OP_NONE ? "none"
                                                                       : "dont_care";
    fprintf(out, "  %s %s", what, image->image->name);
    print_span(out, "mip", target->mip, 1, image->mips);
    print_span(out, "layer", target->layer, 1, image->layers);
    fprintf(out, " %s %s\n", load, store);
}

static void print_name(FILE *out, const struct rg_pass *pass, uint32_t repetition)
{
    fputs(pass->name, out);
    if (pass->repeat != RG_ONCE)
        fprintf(out, "[%u]", repetition);
}

static void print_pass(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_plan_pass *pass = &plan->passes[index];
    static const char *const kinds[] = { "raster", "compute", "transfer" };
    print_barriers(out, plan, pass->first_barrier, pass->barrier_count);
    fprintf(out, "pass %u ", index);
    print_name(out, pass->pass, pass->repetition);
    fprintf(out, " %s %ux%u\n", kinds[pass->pass->kind], pass->extent.width, pass->extent.height);
    for (uint32_t i = 0; i < pass->color_count; i++)
        print_target(out, plan, &pass->color[i], "color");
    if (pass->depth.image != RG_NONE)
        print_target(out, plan, &pass->depth, pass->pass->depth_read_only ? "depth read" : "depth");
    for (uint32_t i = 0; i < pass->use_count; i++) {
        const struct rg_plan_use *use = &plan->uses[pass->first_use + i];
        const struct rg_access_info *info = rg_access_info(use->use->access);
        fprintf(out, "  %s %s", info->name,
                use->image != RG_NONE ? plan->images[use->image].image->name
                                      : plan->buffers[use->buffer].buffer->name);
        if (use->image != RG_NONE)
            print_range(out, &plan->images[use->image], &use->range);
        if ((use->image != RG_NONE ? info->image_descriptor : info->buffer_descriptor) !=
            VK_DESCRIPTOR_TYPE_MAX_ENUM)
            fprintf(out, " binding %u", use->use->binding);
        fputs("\n", out);
    }
}

void rg_dump(const struct rg_plan *plan, FILE *out)
{
    if (plan->fault_count) {
        for (uint32_t i = 0; i < plan->fault_count; i++) {
            char text[512];
            rg_fault_text(&plan->faults[i], text, sizeof(text));
            fprintf(out, "fault: %s\n", text);
        }
        return;
    }
    fprintf(out, "view %ux%u\n", plan->view.width, plan->view.height);
    print_resources(out, plan);
    for (uint32_t p = 0; p < plan->pass_count; p++)
        print_pass(out, plan, p);
    print_barriers(out, plan, plan->first_final_barrier, plan->final_barrier_count);
    for (uint32_t i = 0; i < plan->culled_count; i++) {
        fputs("culled ", out);
        print_name(out, plan->culled[i].pass, plan->culled[i].repetition);
        fputs("\n", out);
    }
}

/* ---- Graphviz ---- */

static void dot_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fputc('\\', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

static void dot_edge(FILE *out, uint32_t pass, char kind, uint32_t resource, bool reads,
                     bool writes)
{
    if (reads)
        fprintf(out, "  %c%u -> p%u;\n", kind, resource, pass);
    if (writes)
        fprintf(out, "  p%u -> %c%u;\n", pass, kind, resource);
}

static void dot_pass(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_plan_pass *pass = &plan->passes[index];
    char name[256];
    if (pass->pass->repeat != RG_ONCE)
        snprintf(name, sizeof(name), "%s[%u]", pass->pass->name, pass->repetition);
    else
        snprintf(name, sizeof(name), "%s", pass->pass->name);
    fprintf(out, "  p%u [shape=box, style=filled, fillcolor=lightblue, label=", index);
    dot_quoted(out, name);
    fputs("];\n", out);
    for (uint32_t i = 0; i < pass->color_count; i++)
        dot_edge(out, index, 'i', pass->color[i].image,
                 pass->color[i].load == VK_ATTACHMENT_LOAD_OP_LOAD, true);
    if (pass->depth.image != RG_NONE)
        dot_edge(out, index, 'i', pass->depth.image, pass->depth.load == VK_ATTACHMENT_LOAD_OP_LOAD,
                 !pass->pass->depth_read_only);
    for (uint32_t i = 0; i < pass->use_count; i++) {
        const struct rg_plan_use *use = &plan->uses[pass->first_use + i];
        const struct rg_access_info *info = rg_access_info(use->use->access);
        bool image = use->image != RG_NONE;
        dot_edge(out, index, image ? 'i' : 'b', image ? use->image : use->buffer,
                 info->reads_content, info->writes_content);
    }
}

void rg_dump_dot(const struct rg_plan *plan, FILE *out)
{
    fputs("digraph plan {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n", out);
    for (uint32_t i = 0; i < plan->image_count; i++) {
        fprintf(out, "  i%u [shape=ellipse, label=", i);
        dot_quoted(out, plan->images[i].image->name);
        fputs("];\n", out);
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        fprintf(out, "  b%u [shape=cylinder, label=", i);
        dot_quoted(out, plan->buffers[i].buffer->name);
        fputs("];\n", out);
    }
    for (uint32_t p = 0; p < plan->pass_count; p++)
        dot_pass(out, plan, p);
    fputs("}\n", out);
}
