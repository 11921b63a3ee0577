/* plan_mutation.c: mutation operators; each injects one fault that provably breaks a valid plan. */
#include "tests/support/plan_mutation.h"

#include <stdlib.h>
#include <string.h>

#include "tests/support/mutation_proof.h"

static void *duplicate(const void *array, size_t count, size_t capacity, size_t size)
{
    void *copy = calloc(capacity, size);
    if (!copy)
        abort();
    if (count)
        memcpy(copy, array, count * size);
    return copy;
}

/* Copies an array into one of twice the capacity plus one, for operators that add elements. */
#define DUPLICATE(array, count) duplicate(array, count, 2 * (size_t)(count) + 1, sizeof(*(array)))

static struct plan_mutant copy_of(const struct rg_plan *plan,
                                  const struct rg_compile_params *params)
{
    struct plan_mutant c = { .params = params, .plan = *plan };
    c.plan.passes = c.passes = DUPLICATE(plan->passes, plan->pass_count);
    c.plan.images = c.images = DUPLICATE(plan->images, plan->image_count);
    c.plan.buffers = c.buffers = DUPLICATE(plan->buffers, plan->buffer_count);
    c.plan.barriers = c.barriers =
        DUPLICATE(plan->barriers, plan->barrier_count + plan->initial_barrier_count);
    c.plan.uses = c.uses = DUPLICATE(plan->uses, plan->use_count);
    c.plan.colors = c.colors = DUPLICATE(plan->colors, plan->color_count);
    for (uint32_t i = 0; i < plan->pass_count; i++)
        c.passes[i].color = c.colors + (plan->passes[i].color - plan->colors);
    c.plan.blocks = c.blocks = DUPLICATE(plan->blocks, plan->block_count);
    return c;
}

void plan_mutation_finish(struct plan_mutant *c)
{
    free(c->passes);
    free(c->images);
    free(c->buffers);
    free(c->barriers);
    free(c->uses);
    free(c->colors);
    free(c->blocks);
}

/* ---- mutation operators: return false if a fault in element `i` may not break the plan ---- */

static bool is_initial(const struct plan_mutant *c, uint32_t i)
{
    return i - c->plan.first_initial_barrier < c->plan.initial_barrier_count;
}

static bool depends(const struct plan_mutant *c, uint32_t i)
{
    return mutation_proof_depends(&c->plan, c->params, i, false);
}

static bool orders(const struct plan_mutant *c, uint32_t i)
{
    return mutation_proof_orders(&c->plan, c->params, i);
}

/* Returns the barrier count of the batch of barrier `i`, and sets *first to its first barrier. */
static uint32_t *batch_of(struct plan_mutant *c, uint32_t i, uint32_t *first)
{
    for (uint32_t p = 0; p < c->plan.pass_count; p++) {
        *first = c->passes[p].first_barrier;
        if (i - *first < c->passes[p].barrier_count)
            return &c->passes[p].barrier_count;
    }
    bool initial = is_initial(c, i);
    *first = initial ? c->plan.first_initial_barrier : c->plan.first_final_barrier;
    return initial ? &c->plan.initial_barrier_count : &c->plan.final_barrier_count;
}

/* Removes a barrier from its batch, and updates the batch count if the batch is now empty. */
static void remove_barrier(struct plan_mutant *c, uint32_t i)
{
    bool initial = is_initial(c, i);
    uint32_t first;
    uint32_t *count = batch_of(c, i, &first);
    c->barriers[i] = c->barriers[first + --*count];
    c->plan.batch_count -= !initial && *count == 0;
}

static bool drop_barrier(struct plan_mutant *c, uint32_t i)
{
    if (!depends(c, i) && !orders(c, i) && !mutation_proof_layout(&c->plan, c->params, i, false) &&
        !mutation_proof_initial(&c->plan, c->params, i))
        return false;
    remove_barrier(c, i);
    return true;
}

/* Moves a barrier to the end of the frame, after the accesses that depend on it. */
static bool delay_barrier(struct plan_mutant *c, uint32_t i)
{
    const struct rg_barrier barrier = c->barriers[i];
    uint32_t first, count = c->plan.final_barrier_count, initial = c->plan.initial_barrier_count;
    if (batch_of(c, i, &first) == &c->plan.final_barrier_count ||
        (!orders(c, i) && !mutation_proof_depends(&c->plan, c->params, i, true) &&
         !mutation_proof_layout(&c->plan, c->params, i, true)))
        return false;
    remove_barrier(c, i);
    /* moves the final batch, with one more barrier, to the free end of the array, before the
     * initial barriers */
    struct rg_barrier *batch = &c->barriers[c->plan.barrier_count];
    memmove(batch + count + 1, batch, initial * sizeof(barrier));
    memmove(batch, &c->barriers[c->plan.first_final_barrier], count * sizeof(barrier));
    batch[count] = barrier;
    c->plan.first_final_barrier = c->plan.barrier_count;
    c->plan.final_barrier_count = count + 1;
    c->plan.barrier_count += count + 1;
    c->plan.first_initial_barrier = c->plan.barrier_count;
    c->plan.batch_count += count == 0;
    return true;
}

static bool wrong_new_layout(struct plan_mutant *c, uint32_t i)
{
    if (c->barriers[i].image == RG_NONE ||
        (is_initial(c, i) && !mutation_proof_initial(&c->plan, c->params, i)))
        return false;
    c->barriers[i].new_layout = VK_IMAGE_LAYOUT_PREINITIALIZED;
    return true;
}

static bool wrong_old_layout(struct plan_mutant *c, uint32_t i)
{
    if (c->barriers[i].image == RG_NONE)
        return false;
    c->barriers[i].old_layout = VK_IMAGE_LAYOUT_PREINITIALIZED;
    return true;
}

/* Discards image content that a frame needs, perhaps only if conditional passes are skipped. */
static bool lose_content(struct plan_mutant *c, uint32_t i)
{
    if (!mutation_proof_content(&c->plan, c->params, i))
        return false;
    c->barriers[i].old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    return true;
}

/* Clears a barrier's source scope, so that it no longer waits for earlier accesses. */
static bool no_source(struct plan_mutant *c, uint32_t i)
{
    bool transition =
        c->barriers[i].image != RG_NONE && c->barriers[i].old_layout != c->barriers[i].new_layout;
    if (!transition && !depends(c, i) && !orders(c, i))
        return false;
    c->barriers[i].src_stages = VK_PIPELINE_STAGE_2_NONE;
    c->barriers[i].src_access = VK_ACCESS_2_NONE;
    return true;
}

static bool no_source_access(struct plan_mutant *c, uint32_t i)
{
    if (!depends(c, i) && !mutation_proof_initial(&c->plan, c->params, i))
        return false;
    c->barriers[i].src_access = VK_ACCESS_2_NONE;
    return true;
}

static bool weak_source(struct plan_mutant *c, uint32_t i)
{
    VkPipelineStageFlags2 stages = c->barriers[i].src_stages;
    if (stages != VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT || !depends(c, i))
        return false;
    c->barriers[i].src_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    c->barriers[i].src_access = VK_ACCESS_2_NONE;
    return true;
}

static bool no_destination_access(struct plan_mutant *c, uint32_t i)
{
    if (!mutation_proof_visible(&c->plan, c->params, i))
        return false;
    c->barriers[i].dst_access = VK_ACCESS_2_NONE;
    return true;
}

static bool wrong_destination(struct plan_mutant *c, uint32_t i)
{
    if (!mutation_proof_visible(&c->plan, c->params, i))
        return false;
    c->barriers[i].dst_stages = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    c->barriers[i].dst_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    return true;
}

static bool impossible_access(struct plan_mutant *c, uint32_t i)
{
    c->barriers[i].dst_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    c->barriers[i].dst_access |= VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    return true;
}

/* Adds an unnecessary batch by moving a barrier to a pass without barriers. */
static bool add_batch(struct plan_mutant *c, uint32_t i)
{
    struct rg_plan_pass *pass = &c->passes[i];
    if (pass->barrier_count || c->params->sharing == RG_SHARE_LEAST_MEMORY)
        return false;
    for (uint32_t p = 0; p < c->plan.pass_count; p++)
        if (c->passes[p].barrier_count > 1) {
            pass->first_barrier = c->passes[p].first_barrier + --c->passes[p].barrier_count;
            pass->barrier_count = 1;
            c->plan.batch_count++;
            return true;
        }
    return false;
}

static struct rg_plan_target *color_of(const struct plan_mutant *c, uint32_t pass, uint32_t i)
{
    return &c->colors[c->passes[pass].color - c->colors + i];
}

static bool drop_store(struct plan_mutant *c, uint32_t i)
{
    struct rg_plan_target *target = &c->passes[i].depth;
    if (c->passes[i].color_count)
        target = color_of(c, i, c->passes[i].color_count - 1);
    if (target->image == RG_NONE || target->store != VK_ATTACHMENT_STORE_OP_STORE ||
        !mutation_proof_store(&c->plan, c->params, i, target))
        return false;
    target->store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return true;
}

static bool drop_load(struct plan_mutant *c, uint32_t i)
{
    struct rg_plan_target *target = &c->passes[i].depth;
    if (c->passes[i].color_count)
        target = color_of(c, i, 0);
    if (target->image == RG_NONE || target->load != VK_ATTACHMENT_LOAD_OP_LOAD)
        return false;
    target->load = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    return true;
}

static bool drop_pass(struct plan_mutant *c, uint32_t i)
{
    memmove(&c->passes[i], &c->passes[i + 1], (c->plan.pass_count - i - 1) * sizeof(c->passes[0]));
    c->plan.pass_count--;
    c->plan.culled_count++;
    return true;
}

static bool swap_passes(struct plan_mutant *c, uint32_t i)
{
    if (i + 1 == c->plan.pass_count)
        return false;
    struct rg_plan_pass pass = c->passes[i];
    c->passes[i] = c->passes[i + 1];
    c->passes[i + 1] = pass;
    return true;
}

static bool drop_resolve(struct plan_mutant *c, uint32_t i)
{
    if (c->passes[i].color_count == 0 || c->passes[i].color[0].resolve == RG_NONE)
        return false;
    color_of(c, i, 0)->resolve = RG_NONE;
    return true;
}

static bool resolve_elsewhere(struct plan_mutant *c, uint32_t i)
{
    if (c->passes[i].color_count == 0 || c->passes[i].color[0].resolve == RG_NONE)
        return false;
    color_of(c, i, 0)->resolve_layer++;
    return true;
}

static bool wrong_extent(struct plan_mutant *c, uint32_t i)
{
    c->passes[i].extent.height++;
    return true;
}

static bool wrong_use_layout(struct plan_mutant *c, uint32_t i)
{
    struct rg_plan_use *use = &c->uses[c->passes[i].first_use];
    if (c->passes[i].use_count == 0 || use->image == RG_NONE)
        return false;
    use->layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return true;
}

/* Places an image at the memory offset of another image with an overlapping lifetime. */
static bool overlap(struct plan_mutant *c, uint32_t i)
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

static bool misalign(struct plan_mutant *c, uint32_t i)
{
    if (c->images[i].block == RG_NONE)
        return false;
    c->images[i].offset += 4;
    c->images[i].size -= 4;
    c->blocks[c->images[i].block].size += 4;
    c->plan.memory_used += 4;
    return true;
}

static bool outside_block(struct plan_mutant *c, uint32_t i)
{
    if (c->images[i].block == RG_NONE)
        return false;
    c->images[i].offset = c->blocks[c->images[i].block].size;
    return true;
}

static bool wrong_memory_type(struct plan_mutant *c, uint32_t i)
{
    if (c->images[i].block == RG_NONE)
        return false;
    c->blocks[c->images[i].block].type_bits = 1U << 31;
    return true;
}

static bool no_image_usage(struct plan_mutant *c, uint32_t i)
{
    VkImageUsageFlags needed = mutation_proof_image_usage(&c->plan, c->params, i);
    c->images[i].usage &= ~needed | (needed - 1); /* clears the lowest usage bit that is needed */
    return needed != 0;
}

static bool no_buffer_usage(struct plan_mutant *c, uint32_t i)
{
    VkBufferUsageFlags needed = mutation_proof_buffer_usage(&c->plan, c->params, i);
    c->buffers[i].usage &= ~needed | (needed - 1);
    return needed != 0;
}

static bool wrong_shape(struct plan_mutant *c, uint32_t i)
{
    if (c->images[i].imported)
        c->images[i].layers++; /* an import's real layer count, not the declared one */
    else
        c->images[i].extent.width++;
    return true;
}

static bool wrong_size(struct plan_mutant *c, uint32_t i)
{
    c->buffers[i].size += 16;
    return true;
}

static bool wrong_samples(struct plan_mutant *c, uint32_t i)
{
    c->images[i].samples ^= 3; /* swaps 1 and 2 samples per texel */
    return true;
}

static bool wrong_persistence(struct plan_mutant *c, uint32_t i)
{
    c->images[i].persistent = !c->images[i].persistent;
    return true;
}

static bool wrong_buffer_persistence(struct plan_mutant *c, uint32_t i)
{
    c->buffers[i].persistent = !c->buffers[i].persistent;
    return true;
}

/* Places a persistent image in a memory block that aliased images use. */
static bool share_history(struct plan_mutant *c, uint32_t i)
{
    if (!c->images[i].persistent || c->plan.block_count == 0)
        return false;
    c->images[i].block = 0;
    c->images[i].offset = 0;
    return true;
}

static bool share_buffer_history(struct plan_mutant *c, uint32_t i)
{
    if (!c->buffers[i].persistent || c->plan.block_count == 0)
        return false;
    c->buffers[i].block = c->plan.block_count - 1;
    c->buffers[i].offset = 0;
    return true;
}

static bool wrong_count(struct plan_mutant *c, uint32_t i)
{
    VkDeviceSize *const bytes[] = {
        &c->plan.memory_used,
        &c->plan.memory_least,
        &c->plan.memory_bound,
        &c->plan.memory_persistent,
    };
    if (i < sizeof(bytes) / sizeof(bytes[0]))
        ++*bytes[i];
    else
        c->plan.batch_count++;
    return true;
}

enum things {
    BARRIERS,
    PASSES,
    IMAGES,
    BUFFERS,
    COUNTS,
};

static const struct {
    const char *name;
    bool (*apply)(struct plan_mutant *c, uint32_t i);
    enum things things;
} operators[] = {
    { "drop_barrier", drop_barrier, BARRIERS },
    { "delay_barrier", delay_barrier, BARRIERS },
    { "wrong_new_layout", wrong_new_layout, BARRIERS },
    { "wrong_old_layout", wrong_old_layout, BARRIERS },
    { "lose_content", lose_content, BARRIERS },
    { "no_source", no_source, BARRIERS },
    { "no_source_access", no_source_access, BARRIERS },
    { "weak_source", weak_source, BARRIERS },
    { "no_destination_access", no_destination_access, BARRIERS },
    { "wrong_destination", wrong_destination, BARRIERS },
    { "impossible_access", impossible_access, BARRIERS },
    { "add_batch", add_batch, PASSES },
    { "drop_store", drop_store, PASSES },
    { "drop_load", drop_load, PASSES },
    { "drop_pass", drop_pass, PASSES },
    { "swap_passes", swap_passes, PASSES },
    { "drop_resolve", drop_resolve, PASSES },
    { "resolve_elsewhere", resolve_elsewhere, PASSES },
    { "wrong_extent", wrong_extent, PASSES },
    { "wrong_use_layout", wrong_use_layout, PASSES },
    { "overlap", overlap, IMAGES },
    { "misalign", misalign, IMAGES },
    { "outside_block", outside_block, IMAGES },
    { "wrong_memory_type", wrong_memory_type, IMAGES },
    { "no_image_usage", no_image_usage, IMAGES },
    { "wrong_shape", wrong_shape, IMAGES },
    { "wrong_samples", wrong_samples, IMAGES },
    { "wrong_persistence", wrong_persistence, IMAGES },
    { "share_history", share_history, IMAGES },
    { "no_buffer_usage", no_buffer_usage, BUFFERS },
    { "wrong_size", wrong_size, BUFFERS },
    { "wrong_buffer_persistence", wrong_buffer_persistence, BUFFERS },
    { "share_buffer_history", share_buffer_history, BUFFERS },
    { "wrong_count", wrong_count, COUNTS },
};

static uint32_t element_count(const struct rg_plan *plan, enum things things)
{
    const uint32_t counts[] = {
        [BARRIERS] = plan->barrier_count + plan->initial_barrier_count,
        [PASSES] = plan->pass_count,
        [IMAGES] = plan->image_count,
        [BUFFERS] = plan->buffer_count,
        [COUNTS] = 5,
    };
    return counts[things];
}

size_t plan_mutation_count(void)
{
    return sizeof(operators) / sizeof(operators[0]);
}

const char *plan_mutation_name(size_t damage)
{
    return operators[damage].name;
}

bool plan_mutation_init(struct plan_mutant *c, const struct rg_plan *plan,
                        const struct rg_compile_params *params, size_t damage, uint32_t *next)
{
    uint32_t count = element_count(plan, operators[damage].things);
    while (*next < count) {
        *c = copy_of(plan, params);
        if (operators[damage].apply(c, (*next)++))
            return true;
        plan_mutation_finish(c);
    }
    return false;
}
