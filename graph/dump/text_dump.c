/* text_dump.c: dumps a plan as text. */
#include <inttypes.h>
#include <stdarg.h>
#include "graph/dump/dump_internal.h"

void rg_dump_print(const struct rg_dump *d, const char *text, ...)
{
    va_list arguments;
    va_start(arguments, text);
    for (; *text; text++) {
        if (*text != '%')
            fputc(*text, d->out);
        else if (*++text == 'u')
            fprintf(d->out, "%u", va_arg(arguments, uint32_t));
        else if (*text == 'z')
            fprintf(d->out, "%" PRIu64, va_arg(arguments, VkDeviceSize));
        else if (*text == 's')
            fputs(va_arg(arguments, const char *), d->out);
        else
            d->name(d->out, va_arg(arguments, const char *));
    }
    va_end(arguments);
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

/* Prints a resource's memory location, and its lifetime as a range of passes. */
static void print_placement(const struct rg_dump *d, uint32_t index)
{
    const struct rg_dump_resource r = rg_dump_resource(d->plan, index);
    if (r.imported)
        rg_dump_print(d, "imported");
    else if (r.persistent)
        rg_dump_print(d, "persistent size %z", r.size);
    else if (r.block == RG_NONE)
        rg_dump_print(d, "host");
    else
        rg_dump_print(d, "block %u offset %z size %z", r.block, r.offset, r.size);
    rg_dump_print(d, ", passes %u-", r.first);
    rg_dump_print(d, r.last == d->plan->pass_count ? "end\n" : "%u\n", r.last);
}

static void print_image(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_image *image = &d->plan->images[index];
    rg_dump_print(d, "image %n %s %ux%u", image->image->name,
                  rg_format_info(image->image->format)->name, image->extent.width,
                  image->extent.height);
    if (image->image->depth)
        rg_dump_print(d, "x%u", image->depth);
    if (image->layers > 1)
        rg_dump_print(d, " layers %u", image->layers);
    if (image->mips > 1)
        rg_dump_print(d, " mips %u", image->mips);
    if (image->samples > 1)
        rg_dump_print(d, " samples %u", image->samples);
    rg_dump_print(d, image->image->cube ? " cube" : "");
    if (image->image->previous && image->partner != RG_NONE)
        rg_dump_print(d, " previous %n", image->image->previous->name);
    rg_dump_print(d, ", ");
    print_placement(d, index);
}

static void print_buffer(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_buffer *buffer = &d->plan->buffers[index];
    rg_dump_print(d, "buffer %n %z bytes, ", buffer->buffer->name, buffer->size);
    print_placement(d, d->plan->image_count + index);
}

static void print_memory(const struct rg_dump *d)
{
    const struct rg_plan *plan = d->plan;
    for (uint32_t i = 0; i < plan->block_count; i++)
        rg_dump_print(d, "block %u %s size %z\n", i, plan->blocks[i].buffers ? "buffers" : "images",
                      plan->blocks[i].size);
    rg_dump_print(d, "transient memory: used %z, without aliasing %z, bound %z", plan->memory_used,
                  plan->memory_without_aliasing, plan->memory_bound);
    if (plan->memory_persistent)
        rg_dump_print(d, "\npersistent memory: %z", plan->memory_persistent);
    rg_dump_print(d, "\nbarriers: %u in %u batches\n", plan->barrier_count, plan->batch_count);
}

static void print_scope(FILE *out, VkPipelineStageFlags2 stages, VkAccessFlags2 accesses)
{
    if (!stages)
        fputs("none", out);
    rg_dump_flags(out, rg_dump_stages, stages, "|");
    fputs(accesses ? "/" : "/none", out);
    rg_dump_flags(out, rg_dump_accesses, accesses, "|");
}

static void print_barriers(const struct rg_dump *d, const char *what, uint32_t first,
                           uint32_t count)
{
    for (uint32_t i = first; i < first + count; i++) {
        const struct rg_barrier *b = &d->plan->barriers[i];
        if (b->image != RG_NONE) {
            const struct rg_plan_image *image = &d->plan->images[b->image];
            rg_dump_print(d, "  %s %n", what, image->image->name);
            print_range(d->out, image, &b->range);
            rg_dump_print(d, ": %s -> %s  ", rg_dump_flag_name(rg_dump_layouts, b->old_layout),
                          rg_dump_flag_name(rg_dump_layouts, b->new_layout));
        } else {
            rg_dump_print(d, "  %s %n:  ", what, d->plan->buffers[b->buffer].buffer->name);
        }
        print_scope(d->out, b->src_stages, b->src_access);
        rg_dump_print(d, " -> ");
        print_scope(d->out, b->dst_stages, b->dst_access);
        rg_dump_print(d, "\n");
    }
}

static void print_texels(const struct rg_dump *d, uint32_t index, uint32_t mip, uint32_t layer,
                         uint32_t layers)
{
    const struct rg_plan_image *image = &d->plan->images[index];
    rg_dump_print(d, " %n", image->image->name);
    print_span(d->out, "mip", mip, 1, image->mips);
    print_span(d->out, "layer", layer, layers ? layers : 1, image->layers);
}

static void print_target(const struct rg_dump *d, const struct rg_plan_target *target,
                         const char *what, uint32_t layers)
{
    rg_dump_print(d, "  %s", what);
    print_texels(d, target->image, target->mip, target->layer, layers);
    rg_dump_print(d, " %s %s", rg_dump_flag_name(rg_dump_loads, target->load),
                  rg_dump_flag_name(rg_dump_stores, target->store));
    if (target->resolve != RG_NONE) {
        rg_dump_print(d, " resolve");
        print_texels(d, target->resolve, target->resolve_mip, target->resolve_layer, layers);
    }
    rg_dump_print(d, "\n");
}

static void print_pass_name(const struct rg_dump *d, const struct rg_pass *pass,
                            uint32_t repetition)
{
    rg_dump_print(d, pass->repeat != RG_ONCE ? "%n[%u]" : "%n", pass->name, repetition);
}

static void print_use(const struct rg_dump *d, const struct rg_plan_use *use)
{
    bool of_image = use->image != RG_NONE;
    rg_dump_print(d, "  %s %n", rg_access_info(use->use->access)->name,
                  of_image ? d->plan->images[use->image].image->name
                           : d->plan->buffers[use->buffer].buffer->name);
    if (of_image)
        print_range(d->out, &d->plan->images[use->image], &use->range);
    rg_dump_print(d, use->use->texels ? " texels" : "");
    rg_dump_print(d, rg_dump_binding(use) != RG_NONE ? " binding %u" : "", rg_dump_binding(use));
    rg_dump_print(d, use->use->element ? "[%u]\n" : "\n", (uint32_t)use->use->element);
}

static void print_pass(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_pass *pass = &d->plan->passes[index];
    rg_dump_print(d, "pass %u ", index);
    print_pass_name(d, pass->pass, pass->repetition);
    rg_dump_print(d, " %s %ux%u%s", rg_dump_flag_name(rg_dump_kinds, pass->pass->kind),
                  pass->extent.width, pass->extent.height, pass->pass->when ? " conditional" : "");
    rg_dump_print(d, pass->pass->multiview ? " multiview\n" : "\n");
    for (uint32_t i = 0; i < pass->color_count; i++)
        print_target(d, &pass->color[i], "color", pass->pass->layers);
    if (pass->depth.image != RG_NONE)
        print_target(d, &pass->depth, rg_dump_depth(pass->pass), pass->pass->layers);
    for (uint32_t i = 0; i < pass->use_count; i++)
        print_use(d, &d->plan->uses[pass->first_use + i]);
    if (pass->pass->set)
        rg_dump_print(d, "  set %n\n", pass->pass->set->name);
}

static void print_submission(const struct rg_dump *d, uint32_t index)
{
    const struct rg_submission *s = &d->plan->submissions[index];
    rg_dump_print(d, "submission %u %s first %u count %u", index,
                  rg_dump_flag_name(rg_dump_queues, s->queue), s->first_pass, s->pass_count);
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++)
        rg_dump_print(d, s->waits[i] ? " after %u" : "", s->waits[i] - 1);
    rg_dump_print(d, "\n");
}

static void print_plan(const struct rg_dump *d)
{
    const struct rg_plan *plan = d->plan;
    rg_dump_print(d, "view %ux%u\n", plan->view.width, plan->view.height);
    for (uint32_t i = 0; i < plan->image_count; i++)
        print_image(d, i);
    for (uint32_t i = 0; i < plan->buffer_count; i++)
        print_buffer(d, i);
    print_memory(d);
    print_barriers(d, "initial barrier", plan->first_initial_barrier, plan->initial_barrier_count);
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        print_barriers(d, "barrier", plan->passes[p].first_barrier, plan->passes[p].barrier_count);
        print_pass(d, p);
    }
    print_barriers(d, "barrier", plan->first_final_barrier, plan->final_barrier_count);
    for (uint32_t i = 0; i < plan->submission_count; i++)
        print_submission(d, i);
    for (uint32_t i = 0; i < plan->culled_count; i++) {
        rg_dump_print(d, "culled ");
        print_pass_name(d, plan->culled[i].pass, plan->culled[i].repetition);
        rg_dump_print(d, "\n");
    }
}

static void plain_name(FILE *out, const char *name)
{
    fputs(name, out);
}

/* ---- faults ---- */

static const char *const messages[RG_ERROR_COUNT] = {
    [RG_ERROR_NONE] = "no fault",
    [RG_ERROR_NO_OUTPUT] = "no output is requested",
    [RG_ERROR_NO_NAME] = "has no name",
    [RG_ERROR_DUPLICATE_NAME] = "name is used twice",
    [RG_ERROR_NO_SIZE] = "has no size",
    [RG_ERROR_TOO_LARGE] = "is too large",
    [RG_ERROR_FORMAT] = "format does not support this use",
    [RG_ERROR_CUBE] = "is not a valid cube",
    [RG_ERROR_RANGE] = "has no such mip, layer or aspect",
    [RG_ERROR_NOT_ONE_RESOURCE] = "entry without exactly one resource and an access",
    [RG_ERROR_ACCESS] = "access does not fit",
    [RG_ERROR_DUPLICATE_BINDING] = "binding is used twice",
    [RG_ERROR_TARGET_SIZE] = "target differs in size",
    [RG_ERROR_NO_TARGET] = "raster pass without a target",
    [RG_ERROR_NO_SHADER] = "shader is missing",
    [RG_ERROR_NO_RECORD] = "record function is missing",
    [RG_ERROR_PUSH_SIZE] = "push constants have an invalid size",
    [RG_ERROR_CONFLICT] = "has conflicting uses in one pass",
    [RG_ERROR_READ_BEFORE_WRITE] = "is read before anything writes it",
    [RG_ERROR_OUTPUT_NOT_WRITTEN] = "is an output that nothing writes",
    [RG_ERROR_WRITES_NOTHING] = "writes nothing",
    [RG_ERROR_REPEAT] = "has no image that defines its repetitions",
    [RG_ERROR_LISTED_TWICE] = "is listed twice",
    [RG_ERROR_SAMPLES] = "has an unsupported sample count or resolve",
    [RG_ERROR_PERSISTENT] = "cannot be persistent or imported",
    [RG_ERROR_VALUE] = "has an invalid value",
    [RG_ERROR_TABLE] = "has a table that is NULL or too long",
    [RG_ERROR_SHADER] = "is not a valid shader",
    [RG_ERROR_SHADER_PUSH] = "push constants differ from those of the shader",
    [RG_ERROR_SHADER_BINDING] = "binding differs from that of the shader",
    [RG_ERROR_SHADER_ACCESS] = "access differs from that of the shader",
    [RG_ERROR_SHADER_VERTEX] = "vertex attribute differs from that of the shader",
    [RG_ERROR_SHADER_INPUT] = "is not an output of the vertex shader",
    [RG_ERROR_SHADER_OUTPUT] = "target differs from the output of the shader",
    [RG_ERROR_DEVICE] = "has impossible properties on this device",
};

static const char *or_else(const char *text, const char *instead)
{
    return text ? text : instead;
}

int rg_fault_text(const struct rg_fault *fault, char *text, size_t size)
{
    char row[24] = "";
    bool in_row = fault->row != RG_NONE;
    const char *end = fault->technique ? ": " : "";
    if (in_row) {
        snprintf(row, sizeof(row), " row %u (", fault->row);
        end = "): ";
    }
    return snprintf(text, size, "%s%s%s%s%s%s%s; %s", or_else(fault->technique, in_row ? "?" : ""),
                    row, in_row ? or_else(fault->pass, "?") : "", end, or_else(fault->resource, ""),
                    fault->resource ? " " : "", messages[fault->error], fault->hint);
}

void rg_dump(const struct rg_plan *plan, FILE *out)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&plan->faults[i], text, sizeof(text));
        fprintf(out, "fault: %s\n", text);
    }
    if (!plan->fault_count)
        print_plan(&(struct rg_dump){ plan, out, plain_name });
}
