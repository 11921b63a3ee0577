/* hazard_simulate_frame.c: simulates the barriers, passes, imports and outputs of one frame. */
#include "tests/support/hazard_private.h"

#include <stdlib.h>

static const VkImageSubresourceRange everything = {
    .aspectMask =
        VK_IMAGE_ASPECT_COLOR_BIT | VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT,
    .levelCount = UINT32_MAX,
    .layerCount = UINT32_MAX,
};

static void arrive(struct hazard *h, uint32_t cell, const struct hazard_resource *resource)
{
    enum rg_access access = resource->import->access;
    if (access != RG_ACCESS_NONE) {
        hazard_sync_import(h, cell, h->slot - 1, access);
        return;
    }
    /* a presented image is acquired again through a semaphore */
    if (resource->output && resource->output->access == RG_PRESENT)
        hazard_sync_import(h, cell, h->slot - 1, RG_PRESENT);
    h->cells[cell].layout = VK_IMAGE_LAYOUT_UNDEFINED;
    h->cells[cell].content = HAZARD_UNDEFINED;
}

/* Starts a frame: only persistent content survives; imports and host buffers get new content. */
static void begin(struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++) {
        struct hazard_subresource *cell = &h->cells[i];
        const struct hazard_resource *resource = &h->resources[cell->resource];
        if (hazard_partner(h, i) != i && !hazard_is_history(h, i))
            cell->content = HAZARD_UNDEFINED;
        if (resource->persistent)
            continue;
        cell->content = HAZARD_UNDEFINED;
        if (resource->import) {
            arrive(h, i, resource);
        } else if (resource->buffer && resource->buffer->memory != RG_MEMORY_DEVICE) {
            cell->written = false;
            cell->reads = cell->barriers = cell->last_barrier = RG_NONE;
            if (resource->buffer->memory == RG_MEMORY_UPLOAD)
                cell->content = HAZARD_UPLOADED;
        }
    }
}

static void run_barriers(struct hazard *h, uint32_t first, uint32_t count)
{
    for (uint32_t i = first; i < first + count; i++) {
        const struct rg_barrier *barrier = &h->plan->barriers[i];
        bool of_image = barrier->image != RG_NONE;
        uint32_t r = of_image ? h->plan_images[barrier->image] : h->plan_buffers[barrier->buffer];
        if (h->slot < HAZARD_FIRST_SLOT && !h->resources[r].persistent)
            hazard_report(h, "initial barrier %u: resource is not persistent", i);
        uint32_t cell;
        for (uint32_t c = 0;
             (cell = hazard_next_subresource(
                  &h->resources[r], of_image ? &barrier->range : &everything, &c)) != RG_NONE;)
            hazard_sync_barrier(h, cell, i);
    }
}

/* An access of a planned pass to one resource. */
struct action {
    const struct hazard_use *use;
    struct hazard_event event;
    VkImageLayout layout;
    uint32_t content; /* content after the access, if it writes */
};

static bool same_range(const VkImageSubresourceRange *a, const VkImageSubresourceRange *b)
{
    return a->aspectMask == b->aspectMask && a->baseMipLevel == b->baseMipLevel &&
           a->levelCount == b->levelCount && a->baseArrayLayer == b->baseArrayLayer &&
           a->layerCount == b->layerCount;
}

static void check_resolve(struct hazard *h, const struct rg_plan_pass *pass,
                          const struct rg_plan_target *planned, struct action *action)
{
    const struct hazard_use *use = action->use;
    action->layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    action->event.writes = use->writes;
    if (planned->resolve != h->resources[use->resource].plan ||
        planned->resolve_mip != use->range.baseMipLevel ||
        planned->resolve_layer != use->range.baseArrayLayer)
        hazard_report(h, "'%s': resolve to '%s' differs from the row", pass->pass->name,
                      use->target->resolve->name);
}

static void check_target(struct hazard *h, const struct rg_plan_pass *pass, struct action *action)
{
    const struct hazard_use *use = action->use;
    const struct rg_target *target = use->target;
    const struct rg_plan_target *planned =
        target == &pass->pass->depth ? &pass->depth : &pass->color[target - pass->pass->color];
    const char *name = target->image->name;
    if (use->resolve) {
        check_resolve(h, pass, planned, action);
        return;
    }
    if (planned->image != h->resources[use->resource].plan ||
        planned->mip != use->range.baseMipLevel || planned->layer != use->range.baseArrayLayer ||
        (planned->resolve != RG_NONE) != (use->access == RG_COLOR && target->resolve))
        hazard_report(h, "'%s': target '%s' differs from the row", pass->pass->name, name);
    if ((use->needs_content && planned->load != VK_ATTACHMENT_LOAD_OP_LOAD) ||
        (target->load == RG_LOAD_CLEAR && planned->load != VK_ATTACHMENT_LOAD_OP_CLEAR))
        hazard_report(h, "'%s': load op of '%s' differs from the row", pass->pass->name, name);
    action->layout = planned->layout;
    if (use->access == RG_DEPTH_READ) {
        action->event.reads = use->reads;
        /* store op STORE counts as a write, even if nothing was drawn */
        if (planned->store == VK_ATTACHMENT_STORE_OP_NONE)
            return;
        action->event.writes = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
        if (planned->store != VK_ATTACHMENT_STORE_OP_STORE)
            hazard_report(h, "'%s': '%s' is lost by its store op", pass->pass->name, name);
        return;
    }
    /* a resolve reads only what its own pass wrote, which needs no barrier */
    action->event.reads = planned->load == VK_ATTACHMENT_LOAD_OP_LOAD ? use->reads : 0;
    action->event.writes = use->writes;
    if (planned->store != VK_ATTACHMENT_STORE_OP_STORE)
        action->content = HAZARD_UNDEFINED;
}

static void check_use(struct hazard *h, const struct rg_plan_pass *pass, struct action *action)
{
    const struct hazard_use *use = action->use;
    const struct hazard_resource *resource = &h->resources[use->resource];
    action->event.reads = use->reads;
    action->event.writes = use->writes;
    const struct rg_plan_use *planned = NULL;
    for (uint32_t i = 0; i < pass->use_count; i++)
        if (h->plan->uses[pass->first_use + i].use == use->use)
            planned = &h->plan->uses[pass->first_use + i];
    if (!planned || (resource->image ? planned->image : planned->buffer) != resource->plan ||
        (resource->image ? planned->buffer : planned->image) != RG_NONE) {
        hazard_report(h, "'%s': use of '%s' is missing or wrong", pass->pass->name,
                      resource->image ? resource->image->name : resource->buffer->name);
        return;
    }
    action->layout = planned->layout;
    if (resource->image && !same_range(&planned->range, &use->range))
        hazard_report(h, "'%s': range of '%s' differs from the row", pass->pass->name,
                      resource->image->name);
}

static void check_content(struct hazard *h, uint32_t cell, uint32_t expected)
{
    uint32_t content = h->cells[cell].content;
    if (hazard_sync_overwritten(h, cell))
        hazard_report_subresource(h, cell,
                                  "read, but its memory was used by another resource since");
    else if (content == HAZARD_UNDEFINED)
        hazard_report_subresource(h, cell, "read, but its content is undefined");
    else if (content != expected)
        hazard_report_subresource(h, cell, "read, but it holds content %u instead of %u", content,
                                  expected);
}

static void check_action(struct hazard *h, const struct action *action)
{
    const struct hazard_use *use = action->use;
    const struct hazard_resource *resource = &h->resources[use->resource];
    const struct hazard_expected *expected = hazard_expected(h, use, h->frame);
    if (resource->image && !hazard_layout_fits(action->layout, use->access, resource->aspects))
        hazard_report(h, "'%s' is used in a layout that does not fit", resource->image->name);
    uint32_t cell;
    for (uint32_t i = 0; (cell = hazard_next_subresource(resource, &use->range, &i)) != RG_NONE;) {
        if (resource->image && h->cells[cell].layout != action->layout)
            hazard_report_subresource(h, cell, "is in layout %d, used in %d",
                                      (int)h->cells[cell].layout, (int)action->layout);
        if (expected->wanted)
            check_content(h, cell, expected->content);
        expected++;
    }
}

static void perform(struct hazard *h, const struct action *action)
{
    const struct hazard_use *use = action->use;
    const struct hazard_resource *resource = &h->resources[use->resource];
    uint32_t cell;
    for (uint32_t i = 0; (cell = hazard_next_subresource(resource, &use->range, &i)) != RG_NONE;) {
        hazard_sync_event(h, cell, &action->event);
        if (use->gives_content)
            h->cells[cell].content = action->content;
    }
}

/* Checks that all attachments have the extent of the pass, and the same sample count. */
static void check_extent(struct hazard *h, const struct rg_plan_pass *pass,
                         const struct hazard_pass *declared)
{
    VkExtent2D extent = h->params->view;
    uint32_t samples = 0;
    for (uint32_t u = declared->first_use; u < declared->first_use + declared->use_count; u++) {
        const struct hazard_use *use = &h->uses[u];
        const struct hazard_resource *resource = &h->resources[use->resource];
        if (!use->target || use->dropped)
            continue;
        extent.width = resource->extent.width >> use->range.baseMipLevel;
        extent.height = resource->extent.height >> use->range.baseMipLevel;
        extent.width += extent.width == 0;
        extent.height += extent.height == 0;
        if (pass->extent.width != extent.width || pass->extent.height != extent.height)
            hazard_report(h, "'%s' has the wrong extent", pass->pass->name);
        if (use->resolve ? resource->samples != 1 : samples && resource->samples != samples)
            hazard_report(h, "'%s' has a target with %u samples", pass->pass->name,
                          resource->samples);
        samples = use->resolve ? samples : resource->samples;
    }
    if (pass->extent.width != extent.width || pass->extent.height != extent.height)
        hazard_report(h, "'%s' has the wrong extent", pass->pass->name);
}

static void run_pass(struct hazard *h, uint32_t index)
{
    const struct rg_plan_pass *pass = &h->plan->passes[index];
    const struct hazard_pass *declared = &h->passes[h->plan_passes[index]];
    check_extent(h, pass, declared);
    uint32_t targets = 0, uses = 0, capacity = 0, count = 0;
    struct action *actions =
        hazard_grow(NULL, &capacity, declared->use_count + 1, sizeof(*actions));
    for (uint32_t i = 0; i < declared->use_count; i++) {
        const struct hazard_use *use = &h->uses[declared->first_use + i];
        if (use->dropped)
            continue;
        struct action *action = &actions[count++];
        *action = (struct action){
            .use = use,
            .event = { .slot = h->slot, .stages = use->stages },
            .content = HAZARD_WRITTEN + h->frame * h->pass_count + h->plan_passes[index],
        };
        uses += use->use != NULL;
        if (use->target)
            check_target(h, pass, action);
        else
            check_use(h, pass, action);
        targets += use->target && !use->resolve;
    }
    if (targets != pass->color_count + (pass->depth.image != RG_NONE) || uses != pass->use_count)
        hazard_report(h, "'%s' has not the targets and uses of its row", pass->pass->name);
    bool runs = hazard_runs(h, declared, h->frame);
    for (uint32_t i = 0; runs && i < count; i++)
        check_action(h, &actions[i]);
    for (uint32_t i = 0; runs && i < count; i++)
        perform(h, &actions[i]);
    free(actions);
}

static void leave(struct hazard *h, uint32_t index, enum rg_access access, bool returned)
{
    struct hazard_subresource *cell = &h->cells[index];
    const struct hazard_resource *resource = &h->resources[cell->resource];
    const struct hazard_rule *rule = hazard_rule(access);
    if (resource->image && cell->layout != rule->layout)
        hazard_report_subresource(h, index, "leaves in layout %d instead of %d", (int)cell->layout,
                                  (int)rule->layout);
    uint32_t content = h->ends[h->frame * h->cell_count + index];
    if (content == HAZARD_UNDEFINED && !resource->import)
        hazard_report_subresource(h, index, "put out, but nothing writes it");
    if (content != HAZARD_UNDEFINED && !(returned && content != HAZARD_IMPORTED))
        check_content(h, index, content);
    if (access == RG_PRESENT || content == HAZARD_UNDEFINED)
        return;
    hazard_sync_event(h, index,
                      &(struct hazard_event){
                          .slot = h->slot,
                          .stages = rule->stages ? rule->stages : (uint32_t)HAZARD_SHADERS,
                          .reads = rule->reads,
                          .writes = rule->writes,
                          .returned = returned,
                      });
}

static void end(struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++) {
        const struct hazard_resource *resource = &h->resources[h->cells[i].resource];
        if (resource->plan == RG_NONE)
            continue;
        if (resource->output)
            leave(h, i, resource->output->access, false);
        else if (resource->import && resource->import->access != RG_ACCESS_NONE)
            leave(h, i, resource->import->access, true);
    }
}

static void swap_partners(struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++) {
        if (!hazard_is_history(h, i))
            continue;
        struct hazard_subresource *a = &h->cells[i], *b = &h->cells[hazard_partner(h, i)];
        const struct hazard_subresource moved = *a;
        *a = *b;
        *b = moved;
        b->resource = a->resource;
        a->resource = moved.resource;
    }
}

void hazard_frame_before(struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++)
        hazard_sync_reset(h, i);
    h->slot = 1;
    run_barriers(h, h->plan->first_initial_barrier, h->plan->initial_barrier_count);
}

void hazard_frame(struct hazard *h)
{
    const struct rg_plan *plan = h->plan;
    h->slot = HAZARD_FIRST_SLOT + h->frame * (plan->pass_count + 1);
    begin(h);
    for (uint32_t i = 0; i < plan->pass_count; i++, h->slot++) {
        run_barriers(h, plan->passes[i].first_barrier, plan->passes[i].barrier_count);
        run_pass(h, i);
    }
    run_barriers(h, plan->first_final_barrier, plan->final_barrier_count);
    end(h);
    swap_partners(h);
}
