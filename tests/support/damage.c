/* One thing broken in a copy of a good plan. */
#include "tests/support/damage.h"

#include <stdlib.h>
#include <string.h>

static void *duplicate(const void *array, size_t count, size_t size)
{
    void *copy = calloc(count + 1, size);
    if (!copy)
        abort();
    if (count)
        memcpy(copy, array, count * size);
    return copy;
}

static struct damage_copy copy_of(const struct rg_plan *plan)
{
    struct damage_copy c = { .plan = *plan };
    c.plan.passes = c.passes = duplicate(plan->passes, plan->pass_count, sizeof(*c.passes));
    c.plan.images = c.images = duplicate(plan->images, plan->image_count, sizeof(*c.images));
    c.plan.buffers = c.buffers = duplicate(plan->buffers, plan->buffer_count, sizeof(*c.buffers));
    c.plan.barriers = c.barriers =
        duplicate(plan->barriers, plan->barrier_count, sizeof(*c.barriers));
    c.plan.uses = c.uses = duplicate(plan->uses, plan->use_count, sizeof(*c.uses));
    c.plan.blocks = c.blocks = duplicate(plan->blocks, plan->block_count, sizeof(*c.blocks));
    return c;
}

void damage_finish(struct damage_copy *c)
{
    free(c->passes);
    free(c->images);
    free(c->buffers);
    free(c->barriers);
    free(c->uses);
    free(c->blocks);
}

/* Brings a barrier to the end of its batch; returns the pass, or pass_count for the final one. */
static uint32_t put_last(struct damage_copy *c, uint32_t *barrier)
{
    uint32_t pass = 0;
    uint32_t first = c->plan.first_final_barrier, count = c->plan.final_barrier_count;
    for (; pass < c->plan.pass_count; pass++)
        if (*barrier - c->passes[pass].first_barrier < c->passes[pass].barrier_count) {
            first = c->passes[pass].first_barrier;
            count = c->passes[pass].barrier_count;
            break;
        }
    struct rg_barrier last = c->barriers[first + count - 1];
    c->barriers[first + count - 1] = c->barriers[*barrier];
    c->barriers[*barrier] = last;
    *barrier = first + count - 1;
    return pass;
}

/* ---- ways to damage it: thing number `i`; false if there is no such thing to damage ---- */

static bool drop_barrier(struct damage_copy *c, uint32_t i)
{
    uint32_t pass = put_last(c, &i);
    if (pass < c->plan.pass_count)
        c->passes[pass].barrier_count--;
    else
        c->plan.final_barrier_count--;
    return true;
}

/* To the end of the frame, after whatever waits for it. */
static bool delay_barrier(struct damage_copy *c, uint32_t i)
{
    uint32_t pass = put_last(c, &i);
    uint32_t last = c->plan.barrier_count - 1;
    if (pass == c->plan.pass_count)
        return false;
    const struct rg_barrier barrier = c->barriers[i];
    memmove(&c->barriers[i], &c->barriers[i + 1], (last - i) * sizeof(barrier));
    c->barriers[last] = barrier;
    c->passes[pass].barrier_count--;
    for (uint32_t p = 0; p < c->plan.pass_count; p++)
        c->passes[p].first_barrier -= c->passes[p].first_barrier > i;
    c->plan.final_barrier_count++;
    c->plan.first_final_barrier = c->plan.barrier_count - c->plan.final_barrier_count;
    return true;
}

static bool wrong_new_layout(struct damage_copy *c, uint32_t i)
{
    if (c->barriers[i].image == RG_NONE)
        return false;
    c->barriers[i].new_layout = VK_IMAGE_LAYOUT_PREINITIALIZED;
    return true;
}

static bool wrong_old_layout(struct damage_copy *c, uint32_t i)
{
    if (c->barriers[i].image == RG_NONE)
        return false;
    c->barriers[i].old_layout = VK_IMAGE_LAYOUT_PREINITIALIZED;
    return true;
}

static bool lose_content(struct damage_copy *c, uint32_t i)
{
    if (c->barriers[i].image == RG_NONE || c->barriers[i].old_layout == VK_IMAGE_LAYOUT_UNDEFINED)
        return false;
    c->barriers[i].old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    return true;
}

static bool no_source(struct damage_copy *c, uint32_t i)
{
    c->barriers[i].src_stages = VK_PIPELINE_STAGE_2_NONE;
    c->barriers[i].src_access = VK_ACCESS_2_NONE;
    return true;
}

/* What a first barrier needs of the frame before: without it, one frame alone is right. */
static bool no_last_frame(struct damage_copy *c, uint32_t i)
{
    const struct rg_barrier *barrier = &c->barriers[i];
    if (barrier->image == RG_NONE || barrier->old_layout != VK_IMAGE_LAYOUT_UNDEFINED ||
        c->images[barrier->image].imported)
        return false;
    uint32_t pass = put_last(c, &i);
    if (c->images[c->barriers[i].image].first != pass)
        return false;
    return no_source(c, i);
}

static bool no_source_access(struct damage_copy *c, uint32_t i)
{
    if (!c->barriers[i].src_access)
        return false;
    c->barriers[i].src_access = VK_ACCESS_2_NONE;
    return true;
}

static bool weak_source(struct damage_copy *c, uint32_t i)
{
    VkPipelineStageFlags2 stages = c->barriers[i].src_stages;
    if (stages != VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT)
        return false;
    c->barriers[i].src_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    c->barriers[i].src_access = VK_ACCESS_2_NONE;
    return true;
}

static bool no_destination_access(struct damage_copy *c, uint32_t i)
{
    if (!c->barriers[i].dst_access)
        return false;
    c->barriers[i].dst_access = VK_ACCESS_2_NONE;
    return true;
}

static bool wrong_destination(struct damage_copy *c, uint32_t i)
{
    if (!c->barriers[i].dst_access)
        return false;
    c->barriers[i].dst_stages = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    c->barriers[i].dst_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    return true;
}

static bool impossible_access(struct damage_copy *c, uint32_t i)
{
    c->barriers[i].dst_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    c->barriers[i].dst_access |= VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    return true;
}

static bool drop_store(struct damage_copy *c, uint32_t i)
{
    struct rg_plan_target *target = &c->passes[i].depth;
    if (c->passes[i].color_count)
        target = &c->passes[i].color[c->passes[i].color_count - 1];
    if (target->image == RG_NONE || target->store != VK_ATTACHMENT_STORE_OP_STORE)
        return false;
    target->store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return true;
}

static bool drop_load(struct damage_copy *c, uint32_t i)
{
    struct rg_plan_target *target = &c->passes[i].depth;
    if (c->passes[i].color_count)
        target = &c->passes[i].color[0];
    if (target->image == RG_NONE || target->load != VK_ATTACHMENT_LOAD_OP_LOAD)
        return false;
    target->load = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    return true;
}

static bool drop_pass(struct damage_copy *c, uint32_t i)
{
    memmove(&c->passes[i], &c->passes[i + 1], (c->plan.pass_count - i - 1) * sizeof(c->passes[0]));
    c->plan.pass_count--;
    c->plan.culled_count++;
    return true;
}

static bool swap_passes(struct damage_copy *c, uint32_t i)
{
    if (i + 1 == c->plan.pass_count)
        return false;
    struct rg_plan_pass pass = c->passes[i];
    c->passes[i] = c->passes[i + 1];
    c->passes[i + 1] = pass;
    return true;
}

static bool wrong_use_layout(struct damage_copy *c, uint32_t i)
{
    struct rg_plan_use *use = &c->uses[c->passes[i].first_use];
    if (c->passes[i].use_count == 0 || use->image == RG_NONE)
        return false;
    use->layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return true;
}

/* The image is put where another one lies while that is alive. */
static bool overlap(struct damage_copy *c, uint32_t i)
{
    struct rg_plan_image *image = &c->images[i];
    for (uint32_t j = 0; j < c->plan.image_count; j++) {
        const struct rg_plan_image *other = &c->images[j];
        if (j != i && image->block != RG_NONE && other->block == image->block &&
            other->first <= image->last && image->first <= other->last) {
            image->offset = other->offset;
            return true;
        }
    }
    return false;
}

static bool misalign(struct damage_copy *c, uint32_t i)
{
    if (c->images[i].block == RG_NONE)
        return false;
    c->images[i].offset += 4;
    c->images[i].size -= 4;
    c->blocks[c->images[i].block].size += 4;
    c->plan.memory_used += 4;
    return true;
}

static bool outside_block(struct damage_copy *c, uint32_t i)
{
    if (c->images[i].block == RG_NONE)
        return false;
    c->images[i].offset = c->blocks[c->images[i].block].size;
    return true;
}

static bool wrong_memory_type(struct damage_copy *c, uint32_t i)
{
    if (c->images[i].block == RG_NONE)
        return false;
    c->blocks[c->images[i].block].type_bits = 1U << 31;
    return true;
}

static bool no_image_usage(struct damage_copy *c, uint32_t i)
{
    c->images[i].usage &= c->images[i].usage - 1; /* the lowest flag */
    return true;
}

static bool no_buffer_usage(struct damage_copy *c, uint32_t i)
{
    c->buffers[i].usage &= c->buffers[i].usage - 1;
    return true;
}

enum things {
    BARRIERS,
    PASSES,
    IMAGES,
    BUFFERS,
};

static const struct {
    const char *name;
    bool (*apply)(struct damage_copy *c, uint32_t i);
    enum things things;
    bool sometimes; /* right: a plan may do more than it must */
} damages[] = {
    { "drop_barrier", drop_barrier, BARRIERS, true },
    { "delay_barrier", delay_barrier, BARRIERS, true },
    { "wrong_new_layout", wrong_new_layout, BARRIERS },
    { "wrong_old_layout", wrong_old_layout, BARRIERS },
    { "lose_content", lose_content, BARRIERS, true },
    { "no_source", no_source, BARRIERS, true },
    { "no_last_frame", no_last_frame, BARRIERS },
    { "no_source_access", no_source_access, BARRIERS, true },
    { "weak_source", weak_source, BARRIERS, true },
    { "no_destination_access", no_destination_access, BARRIERS, true },
    { "wrong_destination", wrong_destination, BARRIERS, true },
    { "impossible_access", impossible_access, BARRIERS },
    { "drop_store", drop_store, PASSES },
    { "drop_load", drop_load, PASSES },
    { "drop_pass", drop_pass, PASSES },
    { "swap_passes", swap_passes, PASSES },
    { "wrong_use_layout", wrong_use_layout, PASSES },
    { "overlap", overlap, IMAGES },
    { "misalign", misalign, IMAGES },
    { "outside_block", outside_block, IMAGES },
    { "wrong_memory_type", wrong_memory_type, IMAGES },
    { "no_image_usage", no_image_usage, IMAGES },
    { "no_buffer_usage", no_buffer_usage, BUFFERS },
};

static uint32_t thing_count(const struct rg_plan *plan, enum things things)
{
    const uint32_t counts[] = {
        [BARRIERS] = plan->barrier_count,
        [PASSES] = plan->pass_count,
        [IMAGES] = plan->image_count,
        [BUFFERS] = plan->buffer_count,
    };
    return counts[things];
}

size_t damage_count(void)
{
    return sizeof(damages) / sizeof(damages[0]);
}

const char *damage_name(size_t damage, bool *sometimes)
{
    *sometimes = damages[damage].sometimes;
    return damages[damage].name;
}

bool damage_init(struct damage_copy *c, const struct rg_plan *plan, size_t damage, uint32_t *next)
{
    uint32_t count = thing_count(plan, damages[damage].things);
    while (*next < count) {
        *c = copy_of(plan);
        if (damages[damage].apply(c, (*next)++))
            return true;
        damage_finish(c);
    }
    return false;
}
