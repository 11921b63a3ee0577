/* run_random_stencil.c: the stencil tests of random passes. */
#include "tests/support/run_random_private.h"

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

void run_random_stencil(struct run_random_tables *t, struct rg_pass *pass)
{
    const struct rg_image *image = pass->depth.image;
    if (!image || !t->known[image - t->images].stencil)
        return;
    if (pass->depth.load == RG_LOAD_DISCARD)
        pass->stencil = &marks;
    else if (!pass->depth_read_only && run_random_chance(t, 40))
        pass->stencil = run_random_chance(t, 50) ? &marks : &counts;
    else if (run_random_chance(t, 60))
        pass->stencil = &looks;
}
