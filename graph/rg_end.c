/* rg_end.c: what is done to a whole resource outside the frame. */
#include "graph/rg_internal.h"

struct access rg_end_access(const struct compiler *c, uint32_t resource, enum rg_access access)
{
    const struct rg_access_info *info = &rg_access_table[access];
    const struct resource *r = &c->resources[resource];
    bool shader = !info->stages && (info->reads || info->writes);
    VkPipelineStageFlags2 stages = shader ? RG_ANY_SHADER : info->stages;
    unsigned flags = ACCESS_READS_CONTENT;
    if (info->reads)
        flags |= ACCESS_READS;
    if (info->writes_content)
        flags |= ACCESS_WRITES_CONTENT;
    return (struct access){
        .resource = resource,
        .access = (uint8_t)access,
        .flags = (uint8_t)flags,
        .whole = r->cell_count == 1,
        .visibility = rg_visibility(access, stages),
        .layout = r->image ? info->layout : VK_IMAGE_LAYOUT_UNDEFINED,
        .stages = stages,
        .range = { r->aspects, 0, r->mips, 0, r->layers },
    };
}

VkAccessFlags2 rg_access_reads(const struct access *a)
{
    return a->flags & ACCESS_READS ? rg_access_table[a->access].reads : VK_ACCESS_2_NONE;
}
