/* mutation_proof.c: finds the accesses to a subresource before and after a barrier or store. */
#include "tests/support/mutation_proof.h"

#include <stddef.h>

#include "tests/support/hazard_private.h"

/* A subresource: one mip, layer and aspect of an image, or a buffer. */
struct cell {
    uint32_t image, buffer; /* indices in the plan; one is RG_NONE */
    uint32_t mip, layer;
    VkImageAspectFlags aspect;
};

/* A search through a frame, in which conditional passes run unless `none_true`. */
struct search {
    const struct rg_plan *plan;
    const struct rg_compile_params *params;
    struct cell cell;
    bool none_true;
};

struct access_record {
    bool found;
    uint32_t pass; /* index in the plan; pass_count for an access after the frame */
    enum rg_access access;
    bool writes, needs_content;
    bool another_frame; /* true if the access is in another frame */
    bool returned;
};

static bool is_in(const VkImageSubresourceRange *range, const struct cell *cell)
{
    return (range->aspectMask & cell->aspect) &&
           cell->mip - range->baseMipLevel < range->levelCount &&
           cell->layer - range->baseArrayLayer < range->layerCount;
}

static struct access_record record_of(uint32_t pass, enum rg_access access)
{
    const struct hazard_rule *rule = hazard_rule(access);
    return (struct access_record){
        .found = true,
        .pass = pass,
        .access = access,
        .writes = rule->writes != 0,
        .needs_content = rule->reads != 0,
    };
}

static struct access_record target_access(const struct search *s, uint32_t pass,
                                          const struct rg_plan_target *target,
                                          enum rg_access access)
{
    if (s->cell.image == RG_NONE || target->image == RG_NONE)
        return (struct access_record){ 0 };
    if (target->image == s->cell.image && target->mip == s->cell.mip &&
        target->layer == s->cell.layer) {
        struct access_record access_record = record_of(pass, access);
        access_record.needs_content = target->load == VK_ATTACHMENT_LOAD_OP_LOAD;
        access_record.writes |= target->store != VK_ATTACHMENT_STORE_OP_NONE;
        return access_record;
    }
    if (target->resolve == s->cell.image && target->resolve_mip == s->cell.mip &&
        target->resolve_layer == s->cell.layer)
        return record_of(pass, RG_RESOLVE);
    return (struct access_record){ 0 };
}

static struct access_record pass_access(const struct search *s, uint32_t index)
{
    const struct rg_plan_pass *pass = &s->plan->passes[index];
    if (s->none_true && pass->pass->when)
        return (struct access_record){ 0 };
    for (uint32_t i = 0; i < pass->color_count; i++) {
        struct access_record access_record = target_access(s, index, &pass->color[i], RG_COLOR);
        if (access_record.found)
            return access_record;
    }
    struct access_record access_record = target_access(
        s, index, &pass->depth, pass->pass->depth_read_only ? RG_DEPTH_READ : RG_DEPTH);
    for (uint32_t i = pass->first_use;
         !access_record.found && i < pass->first_use + pass->use_count; i++) {
        const struct rg_plan_use *use = &s->plan->uses[i];
        bool same = s->cell.image == RG_NONE
                        ? use->buffer == s->cell.buffer
                        : use->image == s->cell.image && is_in(&use->range, &s->cell);
        if (same)
            access_record = record_of(index, use->use->access);
    }
    return access_record;
}

static const struct rg_import *import_of(const struct search *s)
{
    uint32_t index = s->cell.image != RG_NONE ? s->plan->images[s->cell.image].import
                                              : s->plan->buffers[s->cell.buffer].import;
    return index == RG_NONE ? NULL : &s->params->imports[index];
}

/* Returns the application's access to an output or import after the frame. */
static struct access_record outside_access(const struct search *s)
{
    const struct rg_import *import = import_of(s);
    struct access_record access_record = { 0 };
    for (size_t i = 0; i < s->params->output_count; i++) {
        const struct rg_output *output = &s->params->outputs[i];
        bool same = s->cell.image != RG_NONE
                        ? output->image == s->plan->images[s->cell.image].image
                        : output->buffer == s->plan->buffers[s->cell.buffer].buffer;
        if (same && !(import && import->access == RG_ACCESS_NONE))
            access_record = record_of(s->plan->pass_count, output->access);
    }
    access_record.needs_content =
        access_record.found; /* also for PRESENT, whose access flags are 0 */
    if (!access_record.found && import && import->access != RG_ACCESS_NONE) {
        access_record = record_of(s->plan->pass_count, import->access);
        access_record.needs_content = false; /* such writes may be discarded */
        access_record.returned = true;
    }
    return access_record;
}

static bool is_persistent(const struct search *s)
{
    return s->cell.image != RG_NONE ? s->plan->images[s->cell.image].persistent
                                    : s->plan->buffers[s->cell.buffer].persistent;
}

/* Finds the next access after the barriers of pass `from`, also in the next frame. */
static struct access_record find_next(const struct search *s, uint32_t from)
{
    struct access_record access_record = { 0 };
    for (uint32_t p = from; !access_record.found && p < s->plan->pass_count; p++)
        access_record = pass_access(s, p);
    if (!access_record.found)
        access_record = outside_access(s);
    for (uint32_t p = 0;
         !access_record.found && is_persistent(s) && p < from && p < s->plan->pass_count; p++) {
        access_record = pass_access(s, p);
        access_record.another_frame = access_record.found;
    }
    return access_record;
}

/* Finds the last access before the barriers of pass `from`, also in the previous frame. */
static struct access_record find_before(const struct search *s, uint32_t from)
{
    struct access_record access_record = { 0 };
    for (uint32_t p = from; !access_record.found && p-- > 0;)
        access_record = pass_access(s, p);
    bool host = s->cell.image == RG_NONE &&
                s->plan->buffers[s->cell.buffer].buffer->memory != RG_MEMORY_DEVICE;
    if (access_record.found || host || import_of(s))
        return access_record;
    access_record = outside_access(s);
    for (uint32_t p = s->plan->pass_count; !access_record.found && p-- > from;)
        access_record = pass_access(s, p);
    access_record.another_frame = access_record.found;
    return access_record;
}

/* Returns the pass that a barrier precedes; pass_count if it is final, RG_NONE if it is initial. */
static uint32_t pass_of(const struct rg_plan *plan, uint32_t barrier)
{
    for (uint32_t p = 0; p < plan->pass_count; p++)
        if (barrier - plan->passes[p].first_barrier < plan->passes[p].barrier_count)
            return p;
    return barrier - plan->first_final_barrier < plan->final_barrier_count ? plan->pass_count
                                                                           : RG_NONE;
}

static bool is_of(const struct rg_barrier *barrier, const struct cell *cell)
{
    if (barrier->image == RG_NONE)
        return barrier->buffer == cell->buffer;
    return barrier->image == cell->image && is_in(&barrier->range, cell);
}

/* Counts barriers on the subresource in the batches of passes `first` to `last`. */
static uint32_t count_barriers(const struct search *s, uint32_t first, uint32_t last)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->plan->barrier_count; i++) {
        uint32_t pass = pass_of(s->plan, i);
        count += pass != RG_NONE && pass >= first && pass <= last &&
                 is_of(&s->plan->barriers[i], &s->cell);
    }
    return count;
}

static uint32_t barriers_before(const struct search *s, const struct access_record *before,
                                uint32_t from)
{
    if (!before->another_frame)
        return count_barriers(s, before->pass + 1, from);
    uint32_t count = count_barriers(s, 0, from);
    if (before->pass < s->plan->pass_count)
        count += count_barriers(s, before->pass + 1, s->plan->pass_count);
    return count;
}

static uint32_t barriers_after(const struct search *s, uint32_t from,
                               const struct access_record *next)
{
    if (!next->another_frame)
        return count_barriers(s, from, next->pass);
    return count_barriers(s, from, s->plan->pass_count) + count_barriers(s, 0, next->pass);
}

typedef bool prove_fn(const struct search *search, uint32_t barrier);

/* Returns true if `proof` succeeds for any subresource of the barrier. */
static bool prove(const struct rg_plan *plan, const struct rg_compile_params *params,
                  uint32_t barrier, prove_fn *proof)
{
    const struct rg_barrier *b = &plan->barriers[barrier];
    struct search s = { plan, params, { .image = b->image, .buffer = b->buffer }, false };
    if (b->image == RG_NONE)
        return proof(&s, barrier);
    for (uint32_t bit = 1; bit <= VK_IMAGE_ASPECT_STENCIL_BIT; bit *= 2)
        for (uint32_t mip = 0; (b->range.aspectMask & bit) && mip < b->range.levelCount; mip++)
            for (uint32_t layer = 0; layer < b->range.layerCount; layer++) {
                s.cell.aspect = bit;
                s.cell.mip = b->range.baseMipLevel + mip;
                s.cell.layer = b->range.baseArrayLayer + layer;
                if (proof(&s, barrier))
                    return true;
            }
    return false;
}

static bool is_transition(const struct rg_barrier *barrier)
{
    return barrier->image != RG_NONE && barrier->old_layout != barrier->new_layout;
}

static bool depends(const struct search *s, uint32_t barrier)
{
    uint32_t pass = pass_of(s->plan, barrier);
    if (pass == RG_NONE)
        return false;
    struct access_record before = find_before(s, pass), next = find_next(s, pass);
    return before.found && before.writes && before.access != RG_PRESENT && next.found &&
           !(next.returned && !is_transition(&s->plan->barriers[barrier])) &&
           barriers_before(s, &before, pass) == 1 && barriers_after(s, pass, &next) == 1;
}

static bool depends_in_frame(const struct search *s, uint32_t barrier)
{
    uint32_t pass = pass_of(s->plan, barrier);
    return depends(s, barrier) && !find_before(s, pass).another_frame &&
           !find_next(s, pass).another_frame && find_next(s, pass).pass < s->plan->pass_count;
}

bool mutation_proof_depends(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier, bool in_frame)
{
    return prove(plan, params, barrier, in_frame ? depends_in_frame : depends);
}

/* Returns the first barrier on the subresource in batches `first` to `last`, or NULL. */
static const struct rg_barrier *first_barrier(const struct search *s, uint32_t first, uint32_t last)
{
    const struct rg_barrier *found = NULL;
    uint32_t earliest = RG_NONE;
    for (uint32_t i = 0; i < s->plan->barrier_count; i++) {
        uint32_t pass = pass_of(s->plan, i);
        if (pass >= first && pass <= last && pass < earliest &&
            is_of(&s->plan->barriers[i], &s->cell)) {
            found = &s->plan->barriers[i];
            earliest = pass;
        }
    }
    return found;
}

/* Returns true if the next barrier or access after pass `pass` relies on the current layout. */
static bool is_layout_used(const struct search *s, uint32_t pass, const struct access_record *next)
{
    uint32_t last = next->another_frame ? s->plan->pass_count : next->pass;
    const struct rg_barrier *other = first_barrier(s, pass + 1, last);
    if (!other && next->another_frame)
        other = first_barrier(s, 0, next->pass);
    return next->found && (!other || other->old_layout != VK_IMAGE_LAYOUT_UNDEFINED);
}

static bool gives_layout(const struct search *s, uint32_t barrier)
{
    const struct rg_barrier *b = &s->plan->barriers[barrier];
    uint32_t pass = pass_of(s->plan, barrier);
    if (!is_transition(b) || pass == RG_NONE)
        return false;
    struct access_record next = find_next(s, pass);
    if (!is_layout_used(s, pass, &next))
        return false;
    if (b->old_layout != VK_IMAGE_LAYOUT_UNDEFINED)
        return true;
    /* in the first frame the image is still in layout UNDEFINED */
    struct access_record before = find_before(s, pass);
    return (!before.found || before.another_frame) && !is_persistent(s) && !import_of(s) &&
           barriers_before(
               s, &(struct access_record){ .another_frame = true, .pass = s->plan->pass_count },
               pass) == 1;
}

/* Returns true if no other barrier, on any resource, is between a read and a later write. */
static bool orders(const struct search *s, uint32_t barrier)
{
    uint32_t pass = pass_of(s->plan, barrier), between = 0;
    if (pass == RG_NONE)
        return false;
    struct access_record before = find_before(s, pass), next = find_next(s, pass);
    if (!before.found || before.another_frame || !next.found || !next.writes ||
        next.another_frame || next.pass == s->plan->pass_count)
        return false;
    for (uint32_t p = before.pass + 1; p <= next.pass; p++)
        between += s->plan->passes[p].barrier_count;
    return between == 1;
}

bool mutation_proof_orders(const struct rg_plan *plan, const struct rg_compile_params *params,
                           uint32_t barrier)
{
    return prove(plan, params, barrier, orders);
}

static bool gives_layout_to_pass(const struct search *s, uint32_t barrier)
{
    struct access_record next = find_next(s, pass_of(s->plan, barrier));
    return gives_layout(s, barrier) && next.pass < s->plan->pass_count && !next.another_frame;
}

bool mutation_proof_layout(const struct rg_plan *plan, const struct rg_compile_params *params,
                           uint32_t barrier, bool in_frame)
{
    return prove(plan, params, barrier, in_frame ? gives_layout_to_pass : gives_layout);
}

static bool makes_visible(const struct search *s, uint32_t barrier)
{
    uint32_t pass = pass_of(s->plan, barrier);
    if (pass == RG_NONE)
        return false;
    struct access_record next = find_next(s, pass);
    return next.found && !next.another_frame && next.access != RG_PRESENT &&
           barriers_after(s, pass, &next) == 1 &&
           (is_transition(&s->plan->barriers[barrier]) || depends(s, barrier));
}

bool mutation_proof_visible(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier)
{
    return prove(plan, params, barrier, makes_visible);
}

static bool keeps_content(const struct search *s, uint32_t barrier)
{
    uint32_t pass = pass_of(s->plan, barrier);
    if (pass == RG_NONE || s->plan->barriers[barrier].old_layout == VK_IMAGE_LAYOUT_UNDEFINED)
        return false;
    struct search none_true = *s;
    none_true.none_true = true;
    return find_next(s, pass).needs_content || find_next(&none_true, pass).needs_content;
}

bool mutation_proof_content(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier)
{
    return plan->barriers[barrier].image != RG_NONE && prove(plan, params, barrier, keeps_content);
}

static bool is_needed_first(const struct search *s, uint32_t barrier)
{
    struct access_record access_record = find_next(s, 0);
    const struct rg_barrier *first = first_barrier(s, 0, access_record.pass);
    if (!first)
        return access_record.found;
    return is_transition(&s->plan->barriers[barrier]) &&
           first->old_layout != VK_IMAGE_LAYOUT_UNDEFINED;
}

bool mutation_proof_initial(const struct rg_plan *plan, const struct rg_compile_params *params,
                            uint32_t barrier)
{
    return pass_of(plan, barrier) == RG_NONE && prove(plan, params, barrier, is_needed_first);
}

bool mutation_proof_store(const struct rg_plan *plan, const struct rg_compile_params *params,
                          uint32_t pass, const struct rg_plan_target *target)
{
    VkImageAspectFlags aspects = plan->images[target->image].aspects;
    struct search s = {
        plan,
        params,
        { target->image, RG_NONE, target->mip, target->layer, aspects },
        false,
    };
    bool needed = find_next(&s, pass + 1).needs_content;
    s.none_true = true;
    return needed || (!plan->passes[pass].pass->when && find_next(&s, pass + 1).needs_content);
}

static const struct rg_output *output_of(const struct rg_compile_params *params,
                                         const struct rg_image *image,
                                         const struct rg_buffer *buffer)
{
    for (size_t i = 0; i < params->output_count; i++)
        if (params->outputs[i].image == image && params->outputs[i].buffer == buffer)
            return &params->outputs[i];
    return NULL;
}

static VkImageUsageFlags target_usage(const struct rg_plan_target *target, uint32_t image)
{
    if (image == RG_NONE || (target->image != image && target->resolve != image))
        return 0;
    return VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
}

VkImageUsageFlags mutation_proof_image_usage(const struct rg_plan *plan,
                                             const struct rg_compile_params *params, uint32_t image)
{
    const struct rg_output *output = output_of(params, plan->images[image].image, NULL);
    VkImageUsageFlags usage = output ? hazard_rule(output->access)->image_usage : 0;
    if (plan->images[image].persistent)
        usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        const struct rg_plan_pass *pass = &plan->passes[p];
        for (uint32_t i = 0; i < pass->color_count; i++)
            usage |= target_usage(&pass->color[i], image);
        if (pass->depth.image == image)
            usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
        for (uint32_t i = pass->first_use; i < pass->first_use + pass->use_count; i++)
            if (plan->uses[i].image == image)
                usage |= hazard_rule(plan->uses[i].use->access)->image_usage;
    }
    return usage;
}

VkBufferUsageFlags mutation_proof_buffer_usage(const struct rg_plan *plan,
                                               const struct rg_compile_params *params,
                                               uint32_t buffer)
{
    const struct rg_output *output = output_of(params, NULL, plan->buffers[buffer].buffer);
    VkBufferUsageFlags usage = output ? hazard_rule(output->access)->buffer_usage : 0;
    if (plan->buffers[buffer].persistent)
        usage |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    for (uint32_t i = 0; i < plan->use_count; i++)
        if (plan->uses[i].buffer == buffer)
            usage |= plan->uses[i].use->texels
                         ? VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT
                         : hazard_rule(plan->uses[i].use->access)->buffer_usage;
    return usage;
}
