/* json_dump.c: dumps a plan as a JSON object (docs/reference/render-graph.md). */
#include "graph/dump/dump_internal.h"

enum {
    REPLACEMENT = 0xfffd
};

/* Returns the nonzero UTF-8 character at *text, or U+FFFD if invalid, and advances *text. */
static uint32_t decode_utf8(const char **text)
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
        if ((s[i] & 0xc0) != 0x80) /* also rejects the terminating 0 */
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

static void print_utf8(FILE *out, uint32_t character)
{
    static const unsigned char leads[] = { 0, 0xc0, 0xe0, 0xf0 };
    int rest = character < 0x80 ? 0 : character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
    fputc((int)(leads[rest] | character >> (6 * rest)), out);
    while (rest--)
        fputc((int)(0x80 | (character >> (6 * rest) & 0x3f)), out);
}

/* Writes a quoted and escaped string. '<' is escaped because it could end the page's script. */
static void json_name(FILE *out, const char *text)
{
    fputc('"', out);
    while (*text) {
        uint32_t c = decode_utf8(&text);
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", (int)c);
        else if (c < 0x20 || (c >= 0x7f && c < 0xa0) || c == '<' ||
                 (c >= REPLACEMENT && c <= 0xffff))
            fprintf(out, "\\u%04x", c);
        else
            print_utf8(out, c);
    }
    fputc('"', out);
}

/* Prints a string member that is not the first of its object; nothing if `text` is NULL. */
static void string_member(const struct rg_dump *d, const char *key, const char *text)
{
    if (text)
        rg_dump_print(d, ", \"%s\": %n", key, text);
}

static const char *bool_of(bool value)
{
    return value ? "true" : "false";
}

typedef void element_fn(const struct rg_dump *d, uint32_t index);

/* Prints `count` elements from `first` on, one per line, indented by `indent`. */
static void print_array(const struct rg_dump *d, element_fn *element, uint32_t first,
                        uint32_t count, const char *indent)
{
    rg_dump_print(d, "[");
    for (uint32_t i = 0; i < count; i++) {
        rg_dump_print(d, "%s\n%s", i ? "," : "", indent);
        element(d, first + i);
    }
    rg_dump_print(d, "]");
}

/* Prints an array as a member of the outermost object. */
static void array_member(const struct rg_dump *d, const char *key, element_fn *element,
                         uint32_t first, uint32_t count)
{
    rg_dump_print(d, ",\n  \"%s\": ", key);
    print_array(d, element, first, count, "    ");
}

static void print_fault(const struct rg_dump *d, uint32_t index)
{
    const struct rg_fault *f = &d->plan->faults[index];
    char text[512];
    rg_fault_text(f, text, sizeof(text));
    rg_dump_print(d, "{\"error\": %u", f->error);
    string_member(d, "text", text);
    string_member(d, "technique", f->technique);
    if (f->row != RG_NONE)
        rg_dump_print(d, ", \"row\": %u", f->row);
    string_member(d, "pass", f->pass);
    string_member(d, "resource", f->resource);
    string_member(d, "hint", f->hint);
    rg_dump_print(d, "}");
}

/* Prints flags: "key": ["flag", ...] */
static void print_flags(const struct rg_dump *d, const char *key,
                        const struct rg_dump_flag_name *words, uint64_t flags)
{
    const char *quote = flags ? "\"" : "";
    rg_dump_print(d, "\"%s\": [%s", key, quote);
    rg_dump_flags(d->out, words, flags, "\", \"");
    rg_dump_print(d, "%s]", quote);
}

static void range_member(const struct rg_dump *d, const VkImageSubresourceRange *r)
{
    rg_dump_print(d, ", \"range\": {");
    print_flags(d, "aspects", rg_dump_aspects, r->aspectMask);
    rg_dump_print(d, ", \"mip\": %u, \"mips\": %u, \"layer\": %u, \"layers\": %u}", r->baseMipLevel,
                  r->levelCount, r->baseArrayLayer, r->layerCount);
}

/* Prints the members common to images and buffers, and closes the object. */
static void resource_members(const struct rg_dump *d, const struct rg_dump_resource *r)
{
    rg_dump_print(d, ", \"imported\": %s, \"persistent\": %s, \"first\": %u, \"last\": %u",
                  bool_of(r->imported), bool_of(r->persistent), r->first, r->last);
    if (r->block != RG_NONE)
        rg_dump_print(d, ", \"block\": %u, \"offset\": %z", r->block, r->offset);
    if (!r->imported && !r->host)
        rg_dump_print(d, ", \"memory_size\": %z", r->size);
    rg_dump_print(d, "}");
}

static void print_image(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_image *i = &d->plan->images[index];
    const struct rg_dump_resource r = rg_dump_resource(d->plan, index);
    rg_dump_print(d, "{\"name\": %n, \"format\": %n, ", r.name,
                  rg_format_info(i->image->format)->name);
    print_flags(d, "aspects", rg_dump_aspects, i->aspects);
    rg_dump_print(d,
                  ", \"width\": %u, \"height\": %u, \"layers\": %u, \"mips\": %u, \"samples\": %u",
                  i->extent.width, i->extent.height, i->layers, i->mips, i->samples);
    if (i->image->depth)
        rg_dump_print(d, ", \"depth\": %u", i->depth);
    rg_dump_print(d, ", \"cube\": %s", bool_of(i->image->cube));
    if (i->image->previous && i->partner != RG_NONE)
        rg_dump_print(d, ", \"previous\": %n", i->image->previous->name);
    resource_members(d, &r);
}

static void print_buffer(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_buffer *b = &d->plan->buffers[index];
    const struct rg_dump_resource r = rg_dump_resource(d->plan, d->plan->image_count + index);
    rg_dump_print(d, "{\"name\": %n, \"size\": %z, \"memory\": \"%s\"", r.name, b->size,
                  rg_dump_flag_name(rg_dump_memories, b->buffer->memory));
    resource_members(d, &r);
}

static void print_block(const struct rg_dump *d, uint32_t index)
{
    const struct rg_block *block = &d->plan->blocks[index];
    rg_dump_print(d, "{\"of\": \"%s\", \"size\": %z}", block->buffers ? "buffers" : "images",
                  block->size);
}

/* Prints a synchronisation scope: {"stages": [...], "access": [...]} */
static void scope_member(const struct rg_dump *d, const char *key, VkPipelineStageFlags2 stages,
                         VkAccessFlags2 accesses)
{
    rg_dump_print(d, ", \"%s\": {", key);
    print_flags(d, "stages", rg_dump_stages, stages);
    rg_dump_print(d, ", ");
    print_flags(d, "access", rg_dump_accesses, accesses);
    rg_dump_print(d, "}");
}

static void print_barrier(const struct rg_dump *d, uint32_t index)
{
    const struct rg_barrier *b = &d->plan->barriers[index];
    if (b->image != RG_NONE) {
        rg_dump_print(d, "{\"image\": %u", b->image);
        range_member(d, &b->range);
        string_member(d, "old_layout", rg_dump_flag_name(rg_dump_layouts, b->old_layout));
        string_member(d, "new_layout", rg_dump_flag_name(rg_dump_layouts, b->new_layout));
    } else {
        rg_dump_print(d, "{\"buffer\": %u", b->buffer);
    }
    scope_member(d, "src", b->src_stages, b->src_access);
    scope_member(d, "dst", b->dst_stages, b->dst_access);
    rg_dump_print(d, "}");
}

static void print_target(const struct rg_dump *d, const struct rg_plan_target *t,
                         const char *access)
{
    rg_dump_print(d, "{\"access\": \"%s\", \"image\": %u, \"mip\": %u, \"layer\": %u", access,
                  t->image, t->mip, t->layer);
    string_member(d, "load", rg_dump_flag_name(rg_dump_loads, t->load));
    string_member(d, "store", rg_dump_flag_name(rg_dump_stores, t->store));
    if (t->resolve != RG_NONE)
        rg_dump_print(d, ", \"resolve\": {\"image\": %u, \"mip\": %u, \"layer\": %u}", t->resolve,
                      t->resolve_mip, t->resolve_layer);
    rg_dump_print(d, "}");
}

static void print_use(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_use *u = &d->plan->uses[index];
    bool of_image = u->image != RG_NONE;
    rg_dump_print(d, "{\"access\": \"%s\", \"%s\": %u", rg_access_info(u->use->access)->name,
                  of_image ? "image" : "buffer", of_image ? u->image : u->buffer);
    if (of_image)
        range_member(d, &u->range);
    if (rg_dump_binding(u) != RG_NONE)
        rg_dump_print(d, ", \"binding\": %u, \"element\": %u", rg_dump_binding(u),
                      (uint32_t)u->use->element);
    if (u->buffer != RG_NONE)
        rg_dump_print(d, ", \"texels\": %s", bool_of(u->use->texels));
    rg_dump_print(d, "}");
}

/* Prints the members that live and culled passes have in common. */
static void print_pass_name(const struct rg_dump *d, const struct rg_pass *pass,
                            uint32_t repetition)
{
    rg_dump_print(d,
                  pass->repeat != RG_ONCE ? "{\"name\": %n, \"repetition\": %u" : "{\"name\": %n",
                  pass->name, repetition);
}

static void print_pass(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_pass *p = &d->plan->passes[index];
    print_pass_name(d, p->pass, p->repetition);
    string_member(d, "technique", p->technique->name);
    rg_dump_print(d, ", \"row\": %u, \"kind\": \"%s\", \"width\": %u, \"height\": %u", p->row,
                  rg_dump_flag_name(rg_dump_kinds, p->pass->kind), p->extent.width,
                  p->extent.height);
    if (p->pass->layers)
        rg_dump_print(d, ", \"layers\": %u", p->pass->layers);
    if (p->pass->multiview)
        rg_dump_print(d, ", \"multiview\": true");
    string_member(d, "set", p->pass->set ? p->pass->set->name : NULL);
    rg_dump_print(d, ", \"conditional\": %s, \"targets\": [", bool_of(p->pass->when));
    for (uint32_t i = 0; i < p->color_count; i++) {
        rg_dump_print(d, i ? ", " : "");
        print_target(d, &p->color[i], rg_access_info(RG_COLOR)->name);
    }
    if (p->depth.image != RG_NONE) {
        rg_dump_print(d, p->color_count ? ", " : "");
        print_target(d, &p->depth, rg_dump_depth(p->pass));
    }
    rg_dump_print(d, "], \"uses\": ");
    print_array(d, print_use, p->first_use, p->use_count, "      ");
    rg_dump_print(d, ", \"barriers\": ");
    print_array(d, print_barrier, p->first_barrier, p->barrier_count, "      ");
    rg_dump_print(d, "}");
}

static void print_culled(const struct rg_dump *d, uint32_t index)
{
    print_pass_name(d, d->plan->culled[index].pass, d->plan->culled[index].repetition);
    rg_dump_print(d, "}");
}

static void print_submission(const struct rg_dump *d, uint32_t index)
{
    const struct rg_submission *s = &d->plan->submissions[index];
    const char *separator = "";
    rg_dump_print(d, "{\"queue\": \"%s\", \"first_pass\": %u, \"pass_count\": %u, \"after\": [",
                  rg_dump_flag_name(rg_dump_queues, s->queue), s->first_pass, s->pass_count);
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++) {
        if (!s->waits[i])
            continue;
        rg_dump_print(d, "%s%u", separator, s->waits[i] - 1);
        separator = ", ";
    }
    rg_dump_print(d, "]}");
}

static void print_members(const struct rg_dump *d)
{
    const struct rg_plan *plan = d->plan;
    rg_dump_print(d, ",\n  \"view\": {\"width\": %u, \"height\": %u}", plan->view.width,
                  plan->view.height);
    rg_dump_print(d, ",\n  \"memory\": {\"used\": %z, \"without_aliasing\": %z, \"bound\": %z",
                  plan->memory_used, plan->memory_without_aliasing, plan->memory_bound);
    rg_dump_print(d, ", \"persistent\": %z}", plan->memory_persistent);
    rg_dump_print(d, ",\n  \"barrier_count\": %u,\n  \"batch_count\": %u", plan->barrier_count,
                  plan->batch_count);
    array_member(d, "images", print_image, 0, plan->image_count);
    array_member(d, "buffers", print_buffer, 0, plan->buffer_count);
    array_member(d, "blocks", print_block, 0, plan->block_count);
    array_member(d, "initial_barriers", print_barrier, plan->first_initial_barrier,
                 plan->initial_barrier_count);
    array_member(d, "passes", print_pass, 0, plan->pass_count);
    array_member(d, "final_barriers", print_barrier, plan->first_final_barrier,
                 plan->final_barrier_count);
    array_member(d, "submissions", print_submission, 0, plan->submission_count);
    array_member(d, "culled", print_culled, 0, plan->culled_count);
}

void rg_dump_json(const struct rg_plan *plan, FILE *out)
{
    const struct rg_dump d = { plan, out, json_name };
    rg_dump_print(&d, "{\n  \"faults\": ");
    print_array(&d, print_fault, 0, plan->fault_count, "    ");
    if (!plan->fault_count)
        print_members(&d);
    rg_dump_print(&d, "\n}\n");
}

void rg_dump_html(const struct rg_plan *plan, FILE *out)
{
    fputs(rg_dump_page_begin, out);
    rg_dump_json(plan, out);
    fputs(rg_dump_page_end, out);
}
