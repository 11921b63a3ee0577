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
        .access = (uint16_t)access,
        .flags = (uint16_t)flags,
        .visibility = rg_visibility(access, stages),
        .layout = r->image ? info->layout : VK_IMAGE_LAYOUT_UNDEFINED,
        .stages = stages,
    };
}
