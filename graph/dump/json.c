/* json.c: the plan as a JSON object. docs/render-graph.md describes its members. */
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

/* Prints a member that is not the object's first one; nothing if `text` is NULL. */
static void string_member(FILE *out, const char *key, const char *text)
{
    if (!text)
        return;
    fprintf(out, ", \"%s\": ", key);
    print_string(out, text);
}

static const char *bool_of(bool value)
{
    return value ? "true" : "false";
}

typedef void element_fn(FILE *out, const struct rg_plan *plan, uint32_t index);

/* Prints `count` elements from `first` on, each on a line of its own, indented by `indent`. */
static void print_array(FILE *out, const struct rg_plan *plan, element_fn *element, uint32_t first,
                        uint32_t count, int indent)
{
    fputc('[', out);
    for (uint32_t i = 0; i < count; i++) {
        fprintf(out, "%s\n%*s", i ? "," : "", indent, "");
        element(out, plan, first + i);
    }
    fputc(']', out);
}

/* Prints an array that is a member of the outermost object. */
static void array_member(FILE *out, const struct rg_plan *plan, const char *key,
                         element_fn *element, uint32_t first, uint32_t count)
{
    fprintf(out, ",\n  \"%s\": ", key);
    print_array(out, plan, element, first, count, 4);
}

static void print_fault(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_fault *f = &plan->faults[index];
    char text[512];
    rg_fault_text(f, text, sizeof(text));
    fprintf(out, "{\"error\": %d", (int)f->error);
    string_member(out, "text", text);
    string_member(out, "technique", f->technique);
    if (f->row != RG_NONE)
        fprintf(out, ", \"row\": %u", f->row);
    string_member(out, "pass", f->pass);
    string_member(out, "resource", f->resource);
    string_member(out, "hint", f->hint);
    fputc('}', out);
}

static void print_aspects(FILE *out, VkImageAspectFlags flags)
{
    fprintf(out, "\"aspects\": [%s", flags ? "\"" : "");
    rg_dump_aspects(out, flags, "\", \"");
    fprintf(out, "%s]", flags ? "\"" : "");
}

static void range_member(FILE *out, const VkImageSubresourceRange *r)
{
    fputs(", \"range\": {", out);
    print_aspects(out, r->aspectMask);
    fprintf(out, ", \"mip\": %u, \"mips\": %u, \"layer\": %u, \"layers\": %u}", r->baseMipLevel,
            r->levelCount, r->baseArrayLayer, r->layerCount);
}

/* Prints the members that images and buffers have in common, and closes the object. */
static void resource_members(FILE *out, const struct rg_dump_resource *r)
{
    fprintf(out, ", \"imported\": %s, \"persistent\": %s, \"first\": %u, \"last\": %u",
            bool_of(r->imported), bool_of(r->persistent), r->first, r->last);
    if (r->block != RG_NONE)
        fprintf(out, ", \"block\": %u, \"offset\": %" PRIu64, r->block, r->offset);
    if (!r->imported && !r->host)
        fprintf(out, ", \"memory_size\": %" PRIu64, r->size);
    fputc('}', out);
}

static void print_image(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_plan_image *i = &plan->images[index];
    const struct rg_dump_resource r = rg_dump_resource(plan, index);
    fputs("{\"name\": ", out);
    print_string(out, i->image->name);
    string_member(out, "format", rg_format_info(i->image->format)->name);
    fputs(", ", out);
    print_aspects(out, i->aspects);
    fprintf(out,
            ", \"width\": %u, \"height\": %u, \"layers\": %u, \"mips\": %u, \"samples\": %u, "
            "\"cube\": %s",
            i->extent.width, i->extent.height, i->layers, i->mips, i->samples,
            bool_of(i->image->cube));
    resource_members(out, &r);
}

static void print_buffer(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    static const char *const memories[] = {
        [RG_MEMORY_DEVICE] = "device",
        [RG_MEMORY_UPLOAD] = "upload",
        [RG_MEMORY_READBACK] = "readback",
    };
    const struct rg_plan_buffer *b = &plan->buffers[index];
    const struct rg_dump_resource r = rg_dump_resource(plan, plan->image_count + index);
    fputs("{\"name\": ", out);
    print_string(out, b->buffer->name);
    fprintf(out, ", \"size\": %" PRIu64 ", \"memory\": \"%s\"", b->size,
            memories[b->buffer->memory]);
    resource_members(out, &r);
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
    fprintf(out,
            "{\"access\": \"%s\", \"image\": %u, \"mip\": %u, \"layer\": %u, \"load\": \"%s\", "
            "\"store\": \"%s\"",
            access, t->image, t->mip, t->layer, rg_dump_load(t->load), rg_dump_store(t->store));
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
        fprintf(out, ", \"binding\": %u", rg_dump_binding(u));
    fputc('}', out);
}

/* Prints the first members of a pass, whether it is culled or not. */
static void print_pass_name(FILE *out, const struct rg_pass *pass, uint32_t repetition)
{
    fputs("{\"name\": ", out);
    print_string(out, pass->name);
    if (pass->repeat != RG_ONCE)
        fprintf(out, ", \"repetition\": %u", repetition);
}

static void print_pass(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    const struct rg_plan_pass *p = &plan->passes[index];
    print_pass_name(out, p->pass, p->repetition);
    string_member(out, "technique", p->technique->name);
    fprintf(out,
            ", \"row\": %u, \"kind\": \"%s\", \"width\": %u, \"height\": %u, \"conditional\": %s",
            p->row, rg_dump_kind(p->pass->kind), p->extent.width, p->extent.height,
            bool_of(p->pass->when));
    targets_member(out, p);
    fputs(", \"uses\": ", out);
    print_array(out, plan, print_use, p->first_use, p->use_count, 6);
    fputs(", \"barriers\": ", out);
    print_array(out, plan, print_barrier, p->first_barrier, p->barrier_count, 6);
    fputc('}', out);
}

static void print_culled(FILE *out, const struct rg_plan *plan, uint32_t index)
{
    print_pass_name(out, plan->culled[index].pass, plan->culled[index].repetition);
    fputc('}', out);
}

void rg_dump_json(const struct rg_plan *plan, FILE *out)
{
    fputs("{\n  \"faults\": ", out);
    print_array(out, plan, print_fault, 0, plan->fault_count, 4);
    if (!plan->fault_count) {
        fprintf(out,
                ",\n  \"view\": {\"width\": %u, \"height\": %u},\n  \"memory\": {\"used\": %" PRIu64
                ", \"without_aliasing\": %" PRIu64 ", \"bound\": %" PRIu64 ", \"least\": %" PRIu64
                ", \"persistent\": %" PRIu64 "},\n  \"barrier_count\": %u,\n  \"batch_count\": %u",
                plan->view.width, plan->view.height, plan->memory_used,
                plan->memory_without_aliasing, plan->memory_bound, plan->memory_least,
                plan->memory_persistent, rg_dump_barrier_count(plan), plan->batch_count);
        array_member(out, plan, "images", print_image, 0, plan->image_count);
        array_member(out, plan, "buffers", print_buffer, 0, plan->buffer_count);
        array_member(out, plan, "blocks", print_block, 0, plan->block_count);
        array_member(out, plan, "initial_barriers", print_barrier, plan->first_initial_barrier,
                     plan->initial_barrier_count);
        array_member(out, plan, "passes", print_pass, 0, plan->pass_count);
        array_member(out, plan, "final_barriers", print_barrier, plan->first_final_barrier,
                     plan->final_barrier_count);
        array_member(out, plan, "culled", print_culled, 0, plan->culled_count);
    }
    fputs("\n}\n", out);
}
