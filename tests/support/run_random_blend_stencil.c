/* run_random_blend_stencil.c: blend states and stencil tests of random passes. */
#include "tests/support/run_random_private.h"

/* Write masks for integer formats, which do not support blending. */
static const VkPipelineColorBlendAttachmentState masks[] = {
    { .colorWriteMask = VK_COLOR_COMPONENT_R_BIT },
    { .colorWriteMask = VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_A_BIT },
};

#define ONE_BY_ONE(op) \
    { \
        .blendEnable = VK_TRUE, .srcColorBlendFactor = VK_BLEND_FACTOR_ONE, \
        .dstColorBlendFactor = VK_BLEND_FACTOR_ONE, .colorBlendOp = (op), \
        .colorWriteMask = VK_COLOR_COMPONENT_R_BIT, \
    }

static const VkPipelineColorBlendAttachmentState blends[] = {
    ONE_BY_ONE(VK_BLEND_OP_MAX),
    ONE_BY_ONE(VK_BLEND_OP_REVERSE_SUBTRACT),
};

void run_random_blend(struct run_random_tables *t, struct rg_target *target, bool sum)
{
    if (sum && run_random_chance(t, 30))
        target->blend = RG_BLEND_ADD;
    else if (sum && run_random_chance(t, 60))
        target->blend_state = &blends[run_random_below(t, 2)];
    else if (!sum && run_random_chance(t, 25))
        target->blend_state = &masks[run_random_below(t, 2)];
}

#define BOTH_FACES(...) \
    { \
        { __VA_ARGS__ }, \
        { \
            __VA_ARGS__ \
        } \
    }

static const struct rg_stencil marks =
    BOTH_FACES(.passOp = VK_STENCIL_OP_REPLACE, .compareOp = VK_COMPARE_OP_ALWAYS,
               .writeMask = 0xff, .reference = 2);
static const struct rg_stencil counts =
    BOTH_FACES(.failOp = VK_STENCIL_OP_REPLACE, .passOp = VK_STENCIL_OP_INCREMENT_AND_WRAP,
               .compareOp = VK_COMPARE_OP_LESS, .compareMask = 3, .writeMask = 0x7f,
               .reference = 1);
static const struct rg_stencil looks =
    BOTH_FACES(.compareOp = VK_COMPARE_OP_EQUAL, .compareMask = 0xff, .reference = 2);

void run_random_stencil(struct run_random_tables *t, struct rg_pass *pass, bool whole)
{
    const struct rg_image *image = pass->depth.image;
    if (!image || !t->known[image - t->images].stencil)
        return;
    const bool marked = pass->depth.load == RG_LOAD_DISCARD || run_random_chance(t, 20);
    if (marked && !pass->depth_read_only)
        pass->stencil = &marks;
    else if (!whole && !pass->depth_read_only && run_random_chance(t, 30))
        pass->stencil = &counts;
    else if (!whole && run_random_chance(t, 60))
        pass->stencil = &looks;
}
