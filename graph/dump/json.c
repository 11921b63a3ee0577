/* json.c: the plan as a JSON object. docs/render-graph.md says what is in it. */
#include <inttypes.h>
#include "graph/dump/dump.h"

static void print_string(FILE *out, const char *text)
{
    fputc('"', out);
    while (*text) {
        uint32_t c = rg_dump_character(&text);
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", (int)c);
        else if (rg_dump_visible(c) != c || c == 0xfffd)
            fprintf(out, "\\u%04x", c);
        else
            rg_dump_utf8(out, c);
    }
    fputc('"', out);
}

/* A member of an object that has one before. */
static void string_member(FILE *out, const char *key, const char *text)
{
    fprintf(out, ", \"%s\": ", key);
    print_string(out, text);
}

static void number_member(FILE *out, const char *key, uint64_t number)
{
    fprintf(out, ", \"%s\": %" PRIu64, key, number);
}

static void bool_member(FILE *out, const char *key, bool value)
{
    fprintf(out, ", \"%s\": %s", key, value ? "true" : "false");
}

typedef void element_fn(FILE *out, const struct rg_plan *plan, uint32_t index);

/* Elements from `first` on, each on a line of its own, indented by so much. */
struct span {
    uint32_t first, count;
    int indent;
};

static void print_array(FILE *out, const struct rg_plan *plan, element_fn *element,
                        struct span span)
{
    fputc('[', out);
    for (uint32_t i = 0; i < span.count; i++) {
        fprintf(out, "%s\n%*s", i ? "," : "", span.indent, "");
        element(out, plan, span.first + i);
    }
    fputc(']', out);
}

/* A member of the outermost object. */
static void array_member(FILE *out, const struct rg_plan *plan, const char *key,
                         element_fn *element, struct span span)
{
    fprintf(out, ",\n  \"%s\": ", key);
    span.indent = 4;
    print_array(out, plan, element, span);
}

static void print_fault(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_fault *f = &plan->faults[index];
    char text[512];
    rg_fault_text(f, text, sizeof(text));
    fprintf(out, "{\"error\": %d", (int)f->error);
    string_member(out, "text", text);
    if (f->technique)
        string_member(out, "technique", f->technique);
    if (f->row != RG_NONE)
        number_member(out, "row", f->row);
    if (f->pass)
        string_member(out, "pass", f->pass);
    if (f->resource)
        string_member(out, "resource", f->resource);
    if (f->hint)
        string_member(out, "hint", f->hint);
    fputc('}', out);
}

static void print_aspects(FILE *out, VkImageAspectFlags flags)
{
    static const struct {
        VkImageAspectFlags flag;
        const char *name;
    } names[] = {
        { VK_IMAGE_ASPECT_COLOR_BIT, "color" },
        { VK_IMAGE_ASPECT_DEPTH_BIT, "depth" },
        { VK_IMAGE_ASPECT_STENCIL_BIT, "stencil" },
    };

    const char *comma = "";
    fputs("\"aspects\": [", out);
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        if (!(flags & names[i].flag))
            continue;
        fprintf(out, "%s\"%s\"", comma, names[i].name);
        comma = ", ";
    }
    fputc(']', out);
}

static void range_member(FILE *out, const VkImageSubresourceRange *range)
{
    fputs(", \"range\": {", out);
    print_aspects(out, range->aspectMask);
    number_member(out, "mip", range->baseMipLevel);
    number_member(out, "mips", range->levelCount);
    number_member(out, "layer", range->baseArrayLayer);
    number_member(out, "layers", range->layerCount);
    fputc('}', out);
}

static void life_members(FILE *out, uint32_t first, uint32_t last)
{
    number_member(out, "first", first);
    number_member(out, "last", last);
}

static void place_members(FILE *out, uint32_t block, VkDeviceSize offset)
{
    if (block == RG_NONE)
        return;
    number_member(out, "block", block);
    number_member(out, "offset", offset);
}

static void print_image(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_plan_image *i = &plan->images[index];
    fputs("{\"name\": ", out);
    print_string(out, i->image->name);
    string_member(out, "format", rg_format_info(i->image->format)->name);
    fputs(", ", out);
    print_aspects(out, i->aspects);
    number_member(out, "width", i->extent.width);
    number_member(out, "height", i->extent.height);
    number_member(out, "layers", i->layers);
    number_member(out, "mips", i->mips);
    number_member(out, "samples", i->samples);
    bool_member(out, "cube", i->image->cube);
    bool_member(out, "imported", i->imported);
    bool_member(out, "persistent", i->persistent);
    life_members(out, i->first, i->last);
    place_members(out, i->block, i->offset);
    if (!i->imported)
        number_member(out, "memory_size", i->size);
    fputc('}', out);
}

static void print_buffer(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    static const char *const memories[] = {
        [RG_MEMORY_DEVICE] = "device",
        [RG_MEMORY_UPLOAD] = "upload",
        [RG_MEMORY_READBACK] = "readback",
    };
    const struct rg_plan_buffer *b = &plan->buffers[index];
    fputs("{\"name\": ", out);
    print_string(out, b->buffer->name);
    number_member(out, "size", b->size);
    string_member(out, "memory", memories[b->buffer->memory]);
    bool_member(out, "imported", b->imported);
    bool_member(out, "persistent", b->persistent);
    life_members(out, b->first, b->last);
    place_members(out, b->block, b->offset);
    if (!b->imported && b->buffer->memory == RG_MEMORY_DEVICE)
        number_member(out, "memory_size", b->memory_size);
    fputc('}', out);
}

static void print_block(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    fprintf(out, "{\"of\": \"%s\", \"size\": %" PRIu64 "}",
            plan->blocks[index].buffers ? "buffers" : "images", plan->blocks[index].size);
}

/* {"stages": [...], "access": [...]} */
static void scope_member(FILE *out, const char *key, VkPipelineStageFlags2 stages,
                         VkAccessFlags2 accesses)
{
    fprintf(out, ", \"%s\": {\"stages\": [%s", key, stages ? "\"" : "");
    rg_dump_stages(out, stages, "\", \"");
    fprintf(out, "%s], \"access\": [%s", stages ? "\"" : "", accesses ? "\"" : "");
    rg_dump_accesses(out, accesses, "\", \"");
    fprintf(out, "%s]}", accesses ? "\"" : "");
}

static void print_barrier(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_barrier *b = &plan->barriers[index];
    bool of_image = b->image != RG_NONE;
    fprintf(out, "{\"%s\": %u", of_image ? "image" : "buffer", of_image ? b->image : b->buffer);
    if (of_image) {
        range_member(out, &b->range);
        string_member(out, "old_layout", rg_dump_layout(b->old_layout));
        string_member(out, "new_layout", rg_dump_layout(b->new_layout));
    }
    scope_member(out, "src", b->src_stages, b->src_access);
    scope_member(out, "dst", b->dst_stages, b->dst_access);
    fputc('}', out);
}

static void print_target(FILE *out, const struct rg_plan_target *t, const char *access)
{
    fprintf(out, "{\"access\": \"%s\", \"image\": %u", access, t->image);
    number_member(out, "mip", t->mip);
    number_member(out, "layer", t->layer);
    string_member(out, "load", rg_dump_load(t->load));
    string_member(out, "store", rg_dump_store(t->store));
    if (t->resolve != RG_NONE)
        fprintf(out, ", \"resolve\": {\"image\": %u, \"mip\": %u, \"layer\": %u}", t->resolve,
                t->resolve_mip, t->resolve_layer);
    fputc('}', out);
}

static void targets_member(FILE *out, const struct rg_plan_pass *pass)
{
    fputs(", \"targets\": [", out);
    for (uint32_t i = 0; i < pass->color_count; i++) {
        fputs(i ? ", " : "", out);
        print_target(out, &pass->color[i], rg_access_info(RG_COLOR)->name);
    }
    if (pass->depth.image != RG_NONE) {
        fputs(pass->color_count ? ", " : "", out);
        print_target(out, &pass->depth, rg_dump_depth(pass->pass));
    }
    fputc(']', out);
}

static void print_use(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_plan_use *u = &plan->uses[index];
    bool of_image = u->image != RG_NONE;
    fprintf(out, "{\"access\": \"%s\", \"%s\": %u", rg_access_info(u->use->access)->name,
            of_image ? "image" : "buffer", of_image ? u->image : u->buffer);
    if (of_image)
        range_member(out, &u->range);
    if (rg_dump_binding(u) != RG_NONE)
        number_member(out, "binding", rg_dump_binding(u));
    fputc('}', out);
}

static void repetition_member(FILE *out, const struct rg_pass *pass, uint32_t repetition)
{
    if (pass->repeat != RG_ONCE)
        number_member(out, "repetition", repetition);
}

static void print_pass(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_plan_pass *p = &plan->passes[index];
    fputs("{\"name\": ", out);
    print_string(out, p->pass->name);
    repetition_member(out, p->pass, p->repetition);
    string_member(out, "technique", p->technique->name);
    number_member(out, "row", p->row);
    string_member(out, "kind", rg_dump_kind(p->pass->kind));
    number_member(out, "width", p->extent.width);
    number_member(out, "height", p->extent.height);
    bool_member(out, "conditional", p->pass->when != NULL);
    targets_member(out, p);
    fputs(", \"uses\": ", out);
    print_array(out, plan, print_use, (struct span){ p->first_use, p->use_count, 6 });
    fputs(", \"barriers\": ", out);
    print_array(out, plan, print_barrier, (struct span){ p->first_barrier, p->barrier_count, 6 });
    fputc('}', out);
}

static void print_culled(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    fputs("{\"name\": ", out);
    print_string(out, plan->culled[index].pass->name);
    repetition_member(out, plan->culled[index].pass, plan->culled[index].repetition);
    fputc('}', out);
}

static void print_sums(FILE *out, const struct rg_plan *plan)
{
    fprintf(out, ",\n  \"view\": {\"width\": %u, \"height\": %u}", plan->view.width,
            plan->view.height);
    fprintf(out, ",\n  \"memory\": {\"used\": %" PRIu64, plan->memory_used);
    number_member(out, "without_aliasing", plan->memory_without_aliasing);
    number_member(out, "bound", plan->memory_bound);
    number_member(out, "least", plan->memory_least);
    number_member(out, "persistent", plan->memory_persistent);
    fprintf(out, "},\n  \"barrier_count\": %u,\n  \"batch_count\": %u", rg_dump_barrier_count(plan),
            plan->batch_count);
}

void rg_dump_json(const struct rg_plan *plan, FILE *out)
{
    fputs("{\n  \"faults\": ", out);
    print_array(out, plan, print_fault, (struct span){ 0, plan->fault_count, 4 });
    if (!plan->fault_count) {
        const struct span initial = { plan->first_initial_barrier, plan->initial_barrier_count };
        const struct span final = { plan->first_final_barrier, plan->final_barrier_count };
        print_sums(out, plan);
        array_member(out, plan, "images", print_image, (struct span){ 0, plan->image_count });
        array_member(out, plan, "buffers", print_buffer, (struct span){ 0, plan->buffer_count });
        array_member(out, plan, "blocks", print_block, (struct span){ 0, plan->block_count });
        array_member(out, plan, "initial_barriers", print_barrier, initial);
        array_member(out, plan, "passes", print_pass, (struct span){ 0, plan->pass_count });
        array_member(out, plan, "final_barriers", print_barrier, final);
        array_member(out, plan, "culled", print_culled, (struct span){ 0, plan->culled_count });
    }
    fputs("\n}\n", out);
}
