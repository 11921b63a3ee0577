/* rg_tail.c: how a frame ends: who touches each resource last. */
#include "graph/rg_internal.h"

struct access rg_end_access(const struct compiler *c, uint32_t resource, enum rg_access access)
{
    const struct rg_access_info *info = rg_access_info(access);
    const struct resource *r = &c->resources[resource];
    bool shader = !info->stages && (info->reads || info->writes);
    return (struct access){
        .resource = resource,
        .access = access,
        .range = { r->aspects, 0, r->mips, 0, r->layers },
        .stages = shader ? RG_ANY_SHADER : info->stages,
        .reads = info->reads,
        .writes = info->writes,
        .layout = r->image ? info->layout : VK_IMAGE_LAYOUT_UNDEFINED,
        .reads_content = true,
        .writes_content = info->writes_content,
    };
}

enum rg_access rg_output_access(const struct compiler *c, const struct resource *r)
{
    return r->output == RG_NONE ? RG_ACCESS_NONE : c->params->outputs[r->output].access;
}

/* Who touches each cell last in a frame, and what of it is not yet available then. */
struct tail {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 writes;
};

static void follow(const struct compiler *c, struct tail *tails, const struct access *a)
{
    for (struct cell_walk w = rg_walk(c, a); rg_walk_next(&w);) {
        struct tail *tail = &tails[w.cell];
        if (a->writes_content)
            *tail = (struct tail){ a->stages, a->writes };
        else if (tail->writes)
            *tail = (struct tail){ a->stages, VK_ACCESS_2_NONE };
        else
            tail->stages |= a->stages;
    }
}

void rg_find_tails(struct compiler *c)
{
    struct tail *tails = ARENA_ARRAY(&c->scratch, struct tail, c->cell_count);
    if (!tails)
        return;
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        for (uint32_t i = 0; i < pass->access_count && pass->alive; i++)
            follow(c, tails, &c->accesses[pass->first_access + i]);
    }
    for (uint32_t i = 0; i < c->resource_count; i++) {
        struct resource *r = &c->resources[i];
        if (rg_output_access(c, r) != RG_ACCESS_NONE) {
            const struct access a = rg_end_access(c, i, rg_output_access(c, r));
            follow(c, tails, &a);
        }
        for (uint32_t k = 0; k < r->cell_count; k++) {
            r->tail_stages |= tails[r->first_cell + k].stages;
            r->tail_writes |= tails[r->first_cell + k].writes;
        }
    }
}
