/* text.c: the plan as text. */
#include <inttypes.h>
#include "graph/dump/dump.h"

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

/* Prints the memory of a resource, and the passes during which it lives. */
static void print_place(const struct rg_dump *d, uint32_t index)
{
    const struct rg_dump_resource r = rg_dump_resource(d->plan, index);
    if (r.imported)
        fputs("imported", d->out);
    else if (r.persistent)
        fprintf(d->out, "persistent size %" PRIu64, r.size);
    else if (r.block == RG_NONE)
        fputs("host", d->out);
    else
        fprintf(d->out, "block %u offset %" PRIu64 " size %" PRIu64, r.block, r.offset, r.size);
    if (r.last == d->plan->pass_count)
        fprintf(d->out, ", passes %u-end\n", r.first);
    else
        fprintf(d->out, ", passes %u-%u\n", r.first, r.last);
}

void rg_dump_image(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_image *image = &d->plan->images[index];
    fputs("image ", d->out);
    d->name(d->out, image->image->name);
    fprintf(d->out, " %s %ux%u", rg_format_info(image->image->format)->name, image->extent.width,
            image->extent.height);
    if (image->layers > 1)
        fprintf(d->out, " layers %u", image->layers);
    if (image->mips > 1)
        fprintf(d->out, " mips %u", image->mips);
    if (image->samples > 1)
        fprintf(d->out, " samples %u", image->samples);
    fputs(image->image->cube ? " cube, " : ", ", d->out);
    print_place(d, index);
}

void rg_dump_buffer(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_buffer *buffer = &d->plan->buffers[index];
    fputs("buffer ", d->out);
    d->name(d->out, buffer->buffer->name);
    fprintf(d->out, " %" PRIu64 " bytes, ", buffer->size);
    print_place(d, d->plan->image_count + index);
}

static void print_memory(const struct rg_dump *d)
{
    const struct rg_plan *plan = d->plan;
    for (uint32_t i = 0; i < plan->block_count; i++)
        fprintf(d->out, "block %u %s size %" PRIu64 "\n", i,
                plan->blocks[i].buffers ? "buffers" : "images", plan->blocks[i].size);
    fprintf(d->out,
            "transient memory: used %" PRIu64 ", without aliasing %" PRIu64 ", bound %" PRIu64,
            plan->memory_used, plan->memory_without_aliasing, plan->memory_bound);
    if (plan->memory_least != plan->memory_bound)
        fprintf(d->out, ", least %" PRIu64 " if batches did not count", plan->memory_least);
    fputc('\n', d->out);
    if (plan->memory_persistent)
        fprintf(d->out, "persistent memory: %" PRIu64 "\n", plan->memory_persistent);
    fprintf(d->out, "barriers: %u in %u batches\n", rg_dump_barrier_count(plan), plan->batch_count);
}

static void print_flags(FILE *out, VkPipelineStageFlags2 stages, VkAccessFlags2 accesses)
{
    if (!stages)
        fputs("none", out);
    rg_dump_stages(out, stages, "|");
    fputs(accesses ? "/" : "/none", out);
    rg_dump_accesses(out, accesses, "|");
}

void rg_dump_barriers(const struct rg_dump *d, const char *what, uint32_t first, uint32_t count)
{
    for (uint32_t i = first; i < first + count; i++) {
        const struct rg_barrier *b = &d->plan->barriers[i];
        fprintf(d->out, "  %s ", what);
        if (b->image != RG_NONE) {
            d->name(d->out, d->plan->images[b->image].image->name);
            print_range(d->out, &d->plan->images[b->image], &b->range);
            fprintf(d->out, ": %s -> %s", rg_dump_layout(b->old_layout),
                    rg_dump_layout(b->new_layout));
        } else {
            d->name(d->out, d->plan->buffers[b->buffer].buffer->name);
            fputc(':', d->out);
        }
        fputs("  ", d->out);
        print_flags(d->out, b->src_stages, b->src_access);
        fputs(" -> ", d->out);
        print_flags(d->out, b->dst_stages, b->dst_access);
        fputc('\n', d->out);
    }
}

static void print_texels(const struct rg_dump *d, uint32_t index, uint32_t mip, uint32_t layer)
{
    const struct rg_plan_image *image = &d->plan->images[index];
    fputc(' ', d->out);
    d->name(d->out, image->image->name);
    print_span(d->out, "mip", mip, 1, image->mips);
    print_span(d->out, "layer", layer, 1, image->layers);
}

static void print_target(const struct rg_dump *d, const struct rg_plan_target *target,
                         const char *what)
{
    fprintf(d->out, "  %s", what);
    print_texels(d, target->image, target->mip, target->layer);
    fprintf(d->out, " %s %s", rg_dump_load(target->load), rg_dump_store(target->store));
    if (target->resolve != RG_NONE) {
        fputs(" resolve", d->out);
        print_texels(d, target->resolve, target->resolve_mip, target->resolve_layer);
    }
    fputc('\n', d->out);
}

void rg_dump_pass_name(const struct rg_dump *d, const struct rg_pass *pass, uint32_t repetition)
{
    d->name(d->out, pass->name);
    if (pass->repeat != RG_ONCE)
        fprintf(d->out, "[%u]", repetition);
}

static void print_use(const struct rg_dump *d, const struct rg_plan_use *use)
{
    fprintf(d->out, "  %s ", rg_access_info(use->use->access)->name);
    if (use->image != RG_NONE) {
        d->name(d->out, d->plan->images[use->image].image->name);
        print_range(d->out, &d->plan->images[use->image], &use->range);
    } else {
        d->name(d->out, d->plan->buffers[use->buffer].buffer->name);
    }
    if (rg_dump_binding(use) != RG_NONE)
        fprintf(d->out, " binding %u", rg_dump_binding(use));
    fputc('\n', d->out);
}

void rg_dump_pass(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_pass *pass = &d->plan->passes[index];
    fprintf(d->out, "pass %u ", index);
    rg_dump_pass_name(d, pass->pass, pass->repetition);
    fprintf(d->out, " %s %ux%u%s\n", rg_dump_kind(pass->pass->kind), pass->extent.width,
            pass->extent.height, pass->pass->when ? " conditional" : "");
    for (uint32_t i = 0; i < pass->color_count; i++)
        print_target(d, &pass->color[i], "color");
    if (pass->depth.image != RG_NONE)
        print_target(d, &pass->depth, rg_dump_depth(pass->pass));
    for (uint32_t i = 0; i < pass->use_count; i++)
        print_use(d, &d->plan->uses[pass->first_use + i]);
}

void rg_dump_text(const struct rg_dump *d)
{
    const struct rg_plan *plan = d->plan;
    fprintf(d->out, "view %ux%u\n", plan->view.width, plan->view.height);
    for (uint32_t i = 0; i < plan->image_count; i++)
        rg_dump_image(d, i);
    for (uint32_t i = 0; i < plan->buffer_count; i++)
        rg_dump_buffer(d, i);
    print_memory(d);
    rg_dump_barriers(d, "initial barrier", plan->first_initial_barrier,
                     plan->initial_barrier_count);
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        rg_dump_barriers(d, "barrier", plan->passes[p].first_barrier,
                         plan->passes[p].barrier_count);
        rg_dump_pass(d, p);
    }
    rg_dump_barriers(d, "barrier", plan->first_final_barrier, plan->final_barrier_count);
    for (uint32_t i = 0; i < plan->culled_count; i++) {
        fputs("culled ", d->out);
        rg_dump_pass_name(d, plan->culled[i].pass, plan->culled[i].repetition);
        fputc('\n', d->out);
    }
}

static void plain_name(FILE *out, const char *name)
{
    fputs(name, out);
}

void rg_dump(const struct rg_plan *plan, FILE *out)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&plan->faults[i], text, sizeof(text));
        fprintf(out, "fault: %s\n", text);
    }
    if (!plan->fault_count)
        rg_dump_text(&(struct rg_dump){ plan, out, plain_name });
}
