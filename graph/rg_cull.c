/* rg_cull.c: what is read before it is written, which passes anybody needs, and when. */
#include "graph/rg_internal.h"

static bool import_has_content(const struct compiler *c, const struct resource *r)
{
    return r->import != RG_NONE && c->params->imports[r->import].access != RG_ACCESS_NONE;
}

/* All cells of a resource, as an access walks them. */
static struct access whole(uint32_t resource, const struct resource *r)
{
    return (struct access){
        .resource = resource,
        .range = { r->aspects, 0, r->mips, 0, r->layers },
    };
}

static void fill_imports(struct compiler *c, bool *filled)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        bool uploaded = r->buffer && r->buffer->memory == RG_MEMORY_UPLOAD;
        for (uint32_t k = 0; k < r->cell_count && (uploaded || import_has_content(c, r)); k++)
            filled[r->first_cell + k] = true;
    }
}

static void check_access_content(struct compiler *c, const struct pass *pass,
                                 const struct access *access, const bool *filled)
{
    if (!access->reads_content)
        return;
    for (struct cell_walk w = rg_walk(c, access); rg_walk_next(&w);) {
        if (filled[w.cell])
            continue;
        const struct place place = { rg_technique_of(c, pass), pass->row, w.resource->name };
        rg_fault_add(c, RG_ERROR_READ_BEFORE_WRITE, place,
                     access->target ? "clear it, or put the pass that fills it before this one"
                                    : "put the pass that writes it before this one, or import it");
        return;
    }
}

static void check_outputs_content(struct compiler *c, const bool *filled)
{
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        bool complete = true;
        for (uint32_t k = 0; k < r->cell_count; k++)
            complete = complete && filled[r->first_cell + k];
        if (r->output != RG_NONE && !complete)
            rg_fault_add(c, RG_ERROR_OUTPUT_NOT_WRITTEN,
                         (struct place){ .row = RG_NONE, .resource = r->name },
                         "list the technique whose pass writes all of it");
    }
}

void rg_check_content(struct compiler *c)
{
    bool *filled = ARENA_ARRAY(&c->scratch, bool, c->cell_count);
    if (!filled)
        return;
    fill_imports(c, filled);
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        const struct access *accesses = &c->accesses[pass->first_access];
        for (uint32_t i = 0; i < pass->access_count; i++)
            check_access_content(c, pass, &accesses[i], filled);
        for (uint32_t i = 0; i < pass->access_count; i++) {
            for (struct cell_walk w = rg_walk(c, &accesses[i]); rg_walk_next(&w);)
                filled[w.cell] = filled[w.cell] || accesses[i].writes_content;
        }
    }
    check_outputs_content(c, filled);
}

/* Whether later passes or outputs want any of what this access leaves. */
static bool is_wanted(const struct compiler *c, const struct access *access, const bool *wanted)
{
    bool any = false;
    for (struct cell_walk w = rg_walk(c, access); rg_walk_next(&w);)
        any = any || wanted[w.cell];
    return any;
}

static void mark(const struct compiler *c, const struct access *access, bool *wanted, bool value)
{
    for (struct cell_walk w = rg_walk(c, access); rg_walk_next(&w);)
        wanted[w.cell] = value;
}

static void cull_pass(struct compiler *c, struct pass *pass, bool *wanted)
{
    struct access *accesses = &c->accesses[pass->first_access];
    for (uint32_t i = 0; i < pass->access_count; i++) {
        struct access *a = &accesses[i];
        a->needed = a->writes_content && is_wanted(c, a, wanted);
        pass->alive = pass->alive || a->needed;
    }
    if (!pass->alive)
        return;
    for (uint32_t i = 0; i < pass->access_count; i++) {
        if (accesses[i].overwrites)
            mark(c, &accesses[i], wanted, false);
    }
    for (uint32_t i = 0; i < pass->access_count; i++) {
        if (accesses[i].reads_content)
            mark(c, &accesses[i], wanted, true);
    }
}

void rg_cull(struct compiler *c)
{
    bool *wanted = ARENA_ARRAY(&c->scratch, bool, c->cell_count);
    if (!wanted)
        return;
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        const struct access all = whole(i, r);
        if (r->output != RG_NONE)
            mark(c, &all, wanted, true);
    }
    for (uint32_t p = c->pass_count; p-- > 0;)
        cull_pass(c, &c->passes[p], wanted);
}

static VkFlags usage_of(const struct resource *r, enum rg_access access)
{
    const struct rg_access_info *info = rg_access_info(access);
    return r->image ? info->image_usage : info->buffer_usage;
}

static void check_format(struct compiler *c, const struct pass *pass, const struct access *access)
{
    const struct rg_device *device = c->params->device;
    const struct resource *r = &c->resources[access->resource];
    if (!r->image || !device || !device->format_features)
        return;
    VkFormatFeatureFlags wanted = rg_access_info(access->access)->format_features;
    if (access->use && access->use->sampler && access->use->sampler->linear)
        wanted |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (access->target && access->access == RG_COLOR && access->target->blend)
        wanted |= VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
    if (wanted & ~device->format_features(device->user, r->image->format))
        rg_fault_add(c, RG_ERROR_FORMAT,
                     (struct place){ rg_technique_of(c, pass), pass->row, r->name },
                     "this device cannot use the format so; choose another format or device");
}

void rg_lifetimes(struct compiler *c)
{
    uint32_t alive = 0;
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        if (!pass->alive)
            continue;
        for (uint32_t i = 0; i < pass->access_count; i++) {
            const struct access *access = &c->accesses[pass->first_access + i];
            struct resource *r = &c->resources[access->resource];
            if (r->first == RG_NONE)
                r->first = alive;
            r->last = alive;
            r->usage |= usage_of(r, access->access);
            check_format(c, pass, access);
        }
        alive++;
    }
    for (uint32_t i = 0; i < c->resource_count; i++) {
        struct resource *r = &c->resources[i];
        if (r->output == RG_NONE)
            continue;
        if (r->first == RG_NONE) /* an import that no pass touches, handed through */
            r->first = alive;
        r->last = alive;
        r->usage |= usage_of(r, c->params->outputs[r->output].access);
    }
    c->plan->pass_count = c->fault_count ? 0 : alive;
}
