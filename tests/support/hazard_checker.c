/* hazard_checker.c: entry point of the hazard checker: validates the plan, then simulates frames.
 */
#include "tests/support/hazard_checker.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/hazard_private.h"

enum {
    REPORTED = 20, /* number of findings printed; further ones are only counted */
};

static void write_out(struct hazard *h, const char *format, va_list arguments)
{
    const struct rg_plan *plan = h->plan;
    bool in_frame = h->slot >= HAZARD_FIRST_SLOT;
    uint32_t index = in_frame ? (h->slot - HAZARD_FIRST_SLOT) % (plan->pass_count + 1) : 0;
    fputs("hazard: ", h->report);
    if (h->slot && h->condition_count)
        fprintf(h->report, "scenario %u: ", h->scenario);
    if (in_frame && index < plan->pass_count)
        fprintf(h->report, "slot %u (frame %u, %s[%u]): ", h->slot, h->frame + 1,
                plan->passes[index].pass->name, plan->passes[index].repetition);
    else if (in_frame)
        fprintf(h->report, "slot %u (end of frame %u): ", h->slot, h->frame + 1);
    else
        fputs(h->slot ? "before the first frame: " : "plan: ", h->report);
    vfprintf(h->report, format, arguments);
}

void hazard_report(struct hazard *h, const char *format, ...)
{
    if (h->report && h->findings < REPORTED) {
        va_list arguments;
        va_start(arguments, format);
        write_out(h, format, arguments);
        va_end(arguments);
        fputc('\n', h->report);
    }
    h->findings++;
}

void hazard_report_subresource(struct hazard *h, uint32_t cell, const char *format, ...)
{
    if (h->report && h->findings < REPORTED) {
        const struct hazard_resource *r = &h->resources[h->cells[cell].resource];
        uint32_t aspects = r->cell_count / (r->mips * r->layers), index = cell - r->first_cell;
        va_list arguments;
        va_start(arguments, format);
        write_out(h, format, arguments);
        va_end(arguments);
        fprintf(h->report, " ('%s' mip %u layer %u aspect %u)\n",
                r->image ? r->image->name : r->buffer->name, index / aspects % r->mips,
                index / aspects / r->mips, index % aspects);
    }
    h->findings++;
}

void *hazard_grow(void *array, uint32_t *capacity, uint32_t count, size_t size)
{
    if (count <= *capacity)
        return array;
    uint32_t wanted = *capacity ? *capacity * 2 : 16;
    if (wanted < count)
        wanted = count;
    void *grown = realloc(array, wanted * size);
    if (!grown)
        abort();
    memset((char *)grown + *capacity * size, 0, (wanted - *capacity) * size);
    *capacity = wanted;
    return grown;
}

uint32_t hazard_next_subresource(const struct hazard_resource *resource,
                                 const VkImageSubresourceRange *range, uint32_t *index)
{
    if (resource->buffer)
        return (*index)++ == 0 ? resource->first_cell : RG_NONE;
    bool both = resource->cell_count > resource->mips * resource->layers; /* depth and stencil */
    uint32_t place = both ? *index / 2 : *index;
    uint32_t layer = place / resource->mips, mip = place - layer * resource->mips;
    while (*index < resource->cell_count) {
        VkImageAspectFlags aspect = resource->aspects;
        if (both)
            aspect = *index % 2 ? VK_IMAGE_ASPECT_STENCIL_BIT : VK_IMAGE_ASPECT_DEPTH_BIT;
        (*index)++;
        /* a mip or layer below the base wraps around, so that it exceeds the count */
        if (mip - range->baseMipLevel < range->levelCount &&
            layer - range->baseArrayLayer < range->layerCount && (range->aspectMask & aspect))
            return resource->first_cell + *index - 1;
        if (both && *index % 2)
            continue;
        mip++;
        if (mip == resource->mips) {
            mip = 0;
            layer++;
        }
    }
    return RG_NONE;
}

static void check_image_barrier(struct hazard *h, uint32_t index)
{
    const struct rg_barrier *barrier = &h->plan->barriers[index];
    const struct rg_plan_image *image = &h->plan->images[barrier->image];
    const VkImageSubresourceRange *range = &barrier->range;
    const char *name = image->image->name;
    h->barriers[index].transition = barrier->old_layout == VK_IMAGE_LAYOUT_UNDEFINED ||
                                    barrier->old_layout != barrier->new_layout;
    if (!range->aspectMask || (range->aspectMask & ~image->aspects) ||
        range->baseMipLevel >= image->mips || range->baseArrayLayer >= image->layers ||
        range->levelCount == 0 || range->levelCount > image->mips - range->baseMipLevel ||
        range->layerCount == 0 || range->layerCount > image->layers - range->baseArrayLayer)
        hazard_report(h, "barrier %u: range outside of '%s'", index, name);
    if (barrier->new_layout == VK_IMAGE_LAYOUT_UNDEFINED)
        hazard_report(h, "barrier %u: '%s' has new layout UNDEFINED", index, name);
    VkImageUsageFlags usage = hazard_layout_usage(barrier->new_layout);
    if (usage && !image->imported && !(usage & image->usage))
        hazard_report(h, "barrier %u: '%s' has no usage for its new layout", index, name);
}

/* Decodes the masks of a barrier. Returns false unless the barrier names exactly one resource. */
static bool check_barrier(struct hazard *h, uint32_t index)
{
    const struct rg_barrier *barrier = &h->plan->barriers[index];
    struct hazard_barrier *b = &h->barriers[index];
    *b = (struct hazard_barrier){
        .src = hazard_stages(barrier->src_stages, true),
        .dst = hazard_stages(barrier->dst_stages, false),
        .src_access = hazard_accesses(barrier->src_access),
        .dst_access = hazard_accesses(barrier->dst_access),
    };
    b->earlier = hazard_earlier(b->src);
    b->later = hazard_later(b->dst);
    if (!hazard_access_fits(b->src, barrier->src_access) ||
        !hazard_access_fits(b->dst, barrier->dst_access))
        hazard_report(h, "barrier %u: access that its stages do not support", index);
    bool of_image = barrier->image < h->plan->image_count;
    bool of_buffer = barrier->buffer < h->plan->buffer_count;
    if (of_image == of_buffer || (!of_image && barrier->image != RG_NONE) ||
        (!of_buffer && barrier->buffer != RG_NONE)) {
        hazard_report(h, "barrier %u: does not name exactly one resource", index);
        return false;
    }
    if (of_image)
        check_image_barrier(h, index);
    return true;
}

/* Maps the plan's images and buffers to the declared ones. Returns false if any is unmatched. */
static bool map_resources(struct hazard *h)
{
    const struct rg_plan *plan = h->plan;
    uint32_t image_room = 0, buffer_room = 0;
    h->plan_images = hazard_grow(NULL, &image_room, plan->image_count + 1, sizeof(uint32_t));
    h->plan_buffers = hazard_grow(NULL, &buffer_room, plan->buffer_count + 1, sizeof(uint32_t));
    uint32_t mapped = 0;
    for (uint32_t r = 0; r < h->resource_count; r++) {
        const struct hazard_resource *resource = &h->resources[r];
        if (resource->plan == RG_NONE)
            continue;
        (resource->image ? h->plan_images : h->plan_buffers)[resource->plan] = r;
        mapped++;
    }
    if (mapped == plan->image_count + plan->buffer_count)
        return true;
    hazard_report(h, "%u images and buffers, but only %u match the tables",
                  plan->image_count + plan->buffer_count, mapped);
    return false;
}

static bool is_batch(const struct rg_plan *plan, uint32_t first, uint32_t count)
{
    return first <= plan->barrier_count && count <= plan->barrier_count - first;
}

/* Returns the index of a planned pass in h->passes, searching from `from`; RG_NONE if missing. */
static uint32_t find_pass(const struct hazard *h, const struct rg_plan_pass *pass, uint32_t from)
{
    for (uint32_t i = from; i < h->pass_count; i++)
        if (h->passes[i].pass == pass->pass && h->passes[i].technique == pass->technique &&
            h->passes[i].row == pass->row && h->passes[i].repetition == pass->repetition)
            return i;
    return RG_NONE;
}

/* Checks that the plan contains exactly the passes that outputs need, in order. Returns false if
 * the plan is too broken to simulate. */
static bool check_passes(struct hazard *h)
{
    const struct rg_plan *plan = h->plan;
    uint32_t from = 0, capacity = 0;
    h->plan_passes =
        hazard_grow(h->plan_passes, &capacity, plan->pass_count + 1, sizeof(*h->plan_passes));
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct rg_plan_pass *pass = &plan->passes[i];
        uint32_t index = find_pass(h, pass, from);
        if (index == RG_NONE || !is_batch(plan, pass->first_barrier, pass->barrier_count) ||
            pass->first_use > plan->use_count ||
            pass->use_count > plan->use_count - pass->first_use) {
            hazard_report(h, "pass %u '%s' is out of order or broken", i, pass->pass->name);
            return false;
        }
        if (!h->passes[index].useful)
            hazard_report(h, "'%s'[%u] is not needed, but not culled", pass->pass->name,
                          pass->repetition);
        h->passes[index].lives = true;
        h->plan_passes[i] = index;
        from = index + 1;
    }
    for (uint32_t i = 0; !h->condition_count && i < h->pass_count; i++)
        if (h->passes[i].useful && !h->passes[i].lives)
            hazard_report(h, "'%s'[%u] is needed, but culled", h->passes[i].pass->name,
                          h->passes[i].repetition);
    if (plan->culled_count != h->pass_count - plan->pass_count)
        hazard_report(h, "culled_count is %u of %u passes", plan->culled_count, h->pass_count);
    if (is_batch(plan, plan->first_final_barrier, plan->final_barrier_count) &&
        plan->first_initial_barrier == plan->barrier_count)
        return true;
    hazard_report(h, "final barriers are out of range, or initial ones are not the last");
    return false;
}

/* Chooses the number of frames, and all scenarios if they are few, otherwise a random sample. */
static void choose_scenarios(struct hazard *h)
{
    uint32_t passes = h->plan->pass_count + 1;
    h->frame_count = 2;
    for (uint32_t i = 0; i < h->resource_count; i++)
        if (h->resources[i].persistent)
            h->frame_count = HAZARD_FRAMES;
    uint32_t most = HAZARD_PASSES_RUN / (passes * h->frame_count);
    if (most > HAZARD_SCENARIOS)
        most = HAZARD_SCENARIOS;
    if (most < HAZARD_SOME_SCENARIOS)
        most = HAZARD_SOME_SCENARIOS;
    uint32_t bits = h->condition_count * h->frame_count;
    h->every_scenario = bits < 16 && UINT32_C(1) << bits <= most;
    h->scenario_count = h->every_scenario ? UINT32_C(1) << bits : most;
}

static void run_scenario(struct hazard *h)
{
    h->time = 0;
    h->node_count = 0;
    h->slot = 0;
    hazard_expect(h);
    hazard_frame_before(h);
    for (h->frame = 0; h->frame < h->frame_count; h->frame++)
        hazard_frame(h);
}

static void run(struct hazard *h)
{
    uint32_t capacity = 0;
    hazard_tables(h);
    hazard_expect_useful(h);
    if (!map_resources(h) || !check_passes(h))
        return;
    if (!hazard_check_queues(h))
        return;
    hazard_check_memory(h);
    hazard_check_statistics(h);
    uint32_t barrier_count = h->plan->barrier_count + h->plan->initial_barrier_count;
    h->barriers = hazard_grow(NULL, &capacity, barrier_count + 1, sizeof(*h->barriers));
    for (uint32_t i = 0; i < barrier_count; i++)
        if (!check_barrier(h, i))
            return;
    choose_scenarios(h);
    h->slot_count = HAZARD_FIRST_SLOT + h->frame_count * (h->plan->pass_count + 1);
    capacity = 0;
    h->reach = hazard_grow(NULL, &capacity, h->slot_count * HAZARD_STAGE_COUNT, sizeof(*h->reach));
    capacity = 0;
    h->expected =
        hazard_grow(NULL, &capacity, h->frame_count * h->expected_count + 1, sizeof(*h->expected));
    capacity = 0;
    h->ends = hazard_grow(NULL, &capacity, h->frame_count * h->cell_count + 1, sizeof(*h->ends));
    for (h->scenario = 0; h->scenario < h->scenario_count; h->scenario++)
        run_scenario(h);
}

static void finish(struct hazard *h)
{
    for (uint32_t i = 0; h->reach && i < h->slot_count * HAZARD_STAGE_COUNT; i++)
        free(h->reach[i].after);
    void *const arrays[] = {
        h->resources,   h->passes,       h->uses,  h->cells,         h->barriers,
        h->nodes,       h->expected,     h->ends,  h->aliases,       h->plan_passes,
        h->plan_images, h->plan_buffers, h->reach, h->happens_after,
    };
    for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); i++)
        free(arrays[i]);
}

uint32_t hazard_check(const struct rg_plan *plan, const struct rg_compile_params *params,
                      FILE *report)
{
    struct hazard h = { .plan = plan, .params = params, .report = report };
    if (plan->fault_count)
        hazard_report(&h, "the plan has faults");
    else
        run(&h);
    finish(&h);
    return h.findings;
}
