/* check_pipeline_state.c: validates the fixed-function state of a pass declaration. */
#include <math.h>
#include "graph/compile/compiler.h"

bool rg_is_blended(const struct rg_target *target)
{
    return target->blend || (target->blend_state && target->blend_state->blendEnable);
}

bool rg_keeps_color(const struct rg_target *target)
{
    return rg_is_blended(target) ||
           (target->blend_state && target->blend_state->colorWriteMask != ALL_CHANNELS);
}

static bool is_factor(VkBlendFactor factor)
{
    return (uint32_t)factor <= VK_BLEND_FACTOR_SRC_ALPHA_SATURATE;
}

static bool is_blend_state(const VkPipelineColorBlendAttachmentState *s)
{
    return s->blendEnable <= VK_TRUE && s->colorWriteMask <= ALL_CHANNELS &&
           is_factor(s->srcColorBlendFactor) && is_factor(s->dstColorBlendFactor) &&
           is_factor(s->srcAlphaBlendFactor) && is_factor(s->dstAlphaBlendFactor) &&
           (uint32_t)s->colorBlendOp <= VK_BLEND_OP_MAX &&
           (uint32_t)s->alphaBlendOp <= VK_BLEND_OP_MAX;
}

void rg_check_target(struct compiler *c, const struct rg_target *target)
{
    const VkPipelineColorBlendAttachmentState *state = target->blend_state;
    RG_CHECK_ENUM(c, target, load, RG_LOAD_DISCARD, target->image->name, "enum rg_load");
    RG_CHECK_ENUM(c, target, blend, RG_BLEND_ADD, target->image->name, "enum rg_blend");
    rg_fault_if(
        c, state && (target->blend || !is_blend_state(state)), RG_ERROR_VALUE, target->image->name,
        "blend_state: expected Vulkan constants without dual-source blending, and no .blend");
}

/* Adds a layout's vertex locations to a bit mask. Returns false if any is invalid or repeated. */
static bool is_layout(const struct rg_vertex_layout *v, uint32_t binding, uint32_t *locations)
{
    bool fits = v->stride <= RG_MAX_STRIDE && (uint32_t)v->rate <= VK_VERTEX_INPUT_RATE_INSTANCE;
    for (uint32_t i = 0; i < v->attribute_count; i++) {
        const VkVertexInputAttributeDescription *a = &v->attributes[i];
        fits = fits && a->binding == binding && a->offset < RG_MAX_STRIDE &&
               a->location < RG_MAX_ATTRIBUTES && !(*locations >> a->location & 1) &&
               /* E5B9G9R9 is the last format before the block-compressed ones */
               a->format - 1u < VK_FORMAT_E5B9G9R9_UFLOAT_PACK32;
        *locations |= 1u << (a->location & 31);
    }
    return fits;
}

void rg_check_vertices(struct compiler *c, const struct rg_vertex_layout *v)
{
    uint32_t locations = 0, binding = 0;
    for (; v && binding < RG_MAX_VERTEX_BUFFERS; v = v->next, binding++) {
        RG_CHECK_TABLE(c, v, attributes, attribute_count, RG_MAX_ATTRIBUTES, NULL);
        if (rg_is_bad_table(v->attributes, v->attribute_count, RG_MAX_ATTRIBUTES))
            return;
        rg_fault_if(c, !is_layout(v, binding, &locations), RG_ERROR_VALUE, NULL,
                    "vertices: expected a stride up to 2048, and attributes with the layout's "
                    "binding, a colour format, an offset below 2048 and a unique location below "
                    "16");
    }
    rg_fault_if(c, v, RG_ERROR_VALUE, NULL, "vertices: expected at most 8 layouts");
}

static bool is_stencil_state(const VkStencilOpState *s)
{
    return (uint32_t)s->failOp <= VK_STENCIL_OP_DECREMENT_AND_WRAP &&
           (uint32_t)s->passOp <= VK_STENCIL_OP_DECREMENT_AND_WRAP &&
           (uint32_t)s->depthFailOp <= VK_STENCIL_OP_DECREMENT_AND_WRAP &&
           (uint32_t)s->compareOp <= VK_COMPARE_OP_ALWAYS;
}

static bool writes_stencil(const VkStencilOpState *s)
{
    return s->writeMask && (s->failOp || s->passOp || s->depthFailOp);
}

void rg_check_depth(struct compiler *c, const struct rg_pass *pass)
{
    const struct rg_stencil *s = pass->stencil;
    const struct rg_depth_bias *bias = &pass->depth_bias;
    rg_fault_if(c, !isfinite(bias->constant) || !isfinite(bias->clamp) || !isfinite(bias->slope),
                RG_ERROR_VALUE, NULL, "depth_bias: expected finite numbers");
    rg_fault_if(c, s && (!is_stencil_state(&s->front) || !is_stencil_state(&s->back)),
                RG_ERROR_VALUE, NULL, "stencil: expected Vulkan constants");
    rg_fault_if(c, s && !pass->depth.image, RG_ERROR_NO_TARGET, NULL,
                "a stencil test needs .depth");
    rg_fault_if(
        c, s && pass->depth_read_only && (writes_stencil(&s->front) || writes_stencil(&s->back)),
        RG_ERROR_VALUE, NULL, "stencil: expected no writes with depth_read_only");
}
