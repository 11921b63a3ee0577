/* boundary.c: what is done to a whole resource outside the frame. */
#include "graph/compile/compiler.h"

struct access rg_end_access(struct resource *r, enum rg_access access, struct effect *effect)
{
    const struct rg_access_info *info = &rg_access_table[access];
    bool shader = !info->stages && (info->reads || info->writes);
    VkPipelineStageFlags2 stages = shader ? RG_ANY_SHADER : info->stages;
    *effect = rg_effect(access, true, stages);
    if (!r->image)
        effect->layout = VK_IMAGE_LAYOUT_UNDEFINED;
    return (struct access){
        .resource = r,
        .effect = effect,
        .flags = ACCESS_READS_CONTENT | (info->writes_content ? ACCESS_WRITES_CONTENT : 0),
    };
}
