/* dot_dump.c: dumps a plan as a Graphviz digraph. */
#include "graph/dump/dump_internal.h"

/* Writes a name with escapes for a quoted string. */
static void dot_name(FILE *out, const char *name)
{
    while (*name) {
        uint32_t c = rg_dump_printable(rg_dump_decode_utf8(&name));
        if (c == '"' || c == '\\')
            fputc('\\', out);
        rg_dump_utf8(out, c);
    }
}

static void print_resource(const struct rg_dump *d, const char *kind, uint32_t index,
                           const char *name, bool persistent)
{
    rg_dump_print(d, "  %s%u [shape=%s%s, label=\"%n\"];\n", kind, index,
                  *kind == 'i' ? "ellipse" : "cylinder", persistent ? ", peripheries=2" : "", name);
    if (persistent)
        rg_dump_print(d, "  %s%u -> %s%u [style=dashed, label=\"next frame\"];\n", kind, index,
                      kind, index);
}

static void print_edge(FILE *out, uint32_t pass, char kind, uint32_t resource, bool reads,
                       bool writes)
{
    if (reads)
        fprintf(out, "  %c%u -> p%u;\n", kind, resource, pass);
    if (writes)
        fprintf(out, "  p%u -> %c%u;\n", pass, kind, resource);
}

static void print_target(FILE *out, uint32_t pass, const struct rg_plan_target *target, bool writes)
{
    print_edge(out, pass, 'i', target->image, target->load == VK_ATTACHMENT_LOAD_OP_LOAD, writes);
    if (target->resolve != RG_NONE)
        print_edge(out, pass, 'i', target->resolve, false, true);
}

static void print_pass(const struct rg_dump *d, uint32_t index)
{
    const struct rg_plan_pass *pass = &d->plan->passes[index];
    rg_dump_print(d, "  p%u [shape=box, style=\"filled%s\", fillcolor=lightblue, label=\"", index,
                  pass->pass->when ? ",dashed" : "");
    rg_dump_pass_name(d, pass->pass, pass->repetition);
    fputs("\"];\n", d->out);
    for (uint32_t i = 0; i < pass->color_count; i++)
        print_target(d->out, index, &pass->color[i], true);
    if (pass->depth.image != RG_NONE)
        print_target(d->out, index, &pass->depth, !pass->pass->depth_read_only);
    for (uint32_t i = 0; i < pass->use_count; i++) {
        const struct rg_plan_use *use = &d->plan->uses[pass->first_use + i];
        const struct rg_access_info *info = rg_access_info(use->use->access);
        bool image = use->image != RG_NONE;
        print_edge(d->out, index, image ? 'i' : 'b', image ? use->image : use->buffer,
                   info->reads_content, info->writes_content);
    }
}

void rg_dump_dot(const struct rg_plan *plan, FILE *out)
{
    const struct rg_dump d = { plan, out, dot_name };
    fputs("digraph plan {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n", out);
    for (uint32_t i = 0; i < plan->image_count; i++)
        print_resource(&d, "i", i, plan->images[i].image->name, plan->images[i].persistent);
    for (uint32_t i = 0; i < plan->buffer_count; i++)
        print_resource(&d, "b", i, plan->buffers[i].buffer->name, plan->buffers[i].persistent);
    for (uint32_t p = 0; p < plan->pass_count; p++)
        print_pass(&d, p);
    fputs("}\n", out);
}
