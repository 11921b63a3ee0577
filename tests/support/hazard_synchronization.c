/*
 * hazard_synchronization.c: execution order of accesses (dependency chains) and visibility of
 * writes.
 *
 * An access is ordered after an earlier one if a chain of barriers connects their stages. A write
 * is visible to it if a barrier also made the write available and a later one of the chain, or the
 * same one, made it visible to the access's stage.
 */
#include "tests/support/hazard_private.h"

#include <stdlib.h>

static const struct rg_barrier *batch_of(const struct rg_plan *plan, uint32_t slot, uint32_t *count)
{
    if (slot < HAZARD_FIRST_SLOT) {
        *count = slot ? plan->initial_barrier_count : 0;
        return plan->barriers + plan->first_initial_barrier;
    }
    uint32_t pass = (slot - HAZARD_FIRST_SLOT) % (plan->pass_count + 1);
    if (pass == plan->pass_count) {
        *count = plan->final_barrier_count;
        return plan->barriers + plan->first_final_barrier;
    }
    *count = plan->passes[pass].barrier_count;
    return plan->barriers + plan->passes[pass].first_barrier;
}

/* Returns the stages in slot `to` that are ordered after stage number `stage` in slot `from`,
 * through a dependency chain of barriers. Results are cached per slot and stage. */
static uint32_t reach(struct hazard *h, uint32_t from, uint32_t stage, uint32_t to)
{
    struct hazard_reach *row = &h->reach[from * HAZARD_STAGE_COUNT + stage];
    if (!row->after) {
        row->after = hazard_grow(NULL, &(uint32_t){ 0 }, h->slot_count, sizeof(*row->after));
        row->last = from;
    }
    uint32_t after = row->after[row->last];
    while (row->last < to) {
        uint32_t count = 0, more = 0;
        const struct rg_barrier *batch = batch_of(h->plan, ++row->last, &count);
        if (hazard_queue_of(h, row->last) != hazard_queue_of(h, from))
            count = 0; /* barriers order commands of their own queue */
        for (uint32_t i = 0; i < count; i++) {
            const struct hazard_barrier *b = &h->barriers[batch + i - h->plan->barriers];
            if (b->earlier & (after | 1U << stage))
                more |= b->later;
        }
        after |= more;
        row->after[row->last] = (uint16_t)after;
    }
    return row->after[to];
}

static bool is_ordered(struct hazard *h, const struct hazard_record *record,
                       const struct hazard_event *event)
{
    if (event->returned && !(record->stages & ~event->stages))
        return true;
    if (hazard_waits(h, record->slot, event->slot))
        return true;
    if (hazard_queue_of(h, record->slot) != hazard_queue_of(h, event->slot))
        return false;
    for (uint32_t stage = 0; stage < HAZARD_STAGE_COUNT; stage++) {
        if (!(record->stages & 1U << stage))
            continue;
        if (event->transition) {
            uint32_t after = reach(h, record->slot, stage, event->slot - 1);
            if (!((after | 1U << stage) & event->transition->earlier))
                return false;
        } else if (event->stages & ~reach(h, record->slot, stage, event->slot)) {
            return false;
        }
    }
    return true;
}

/* A write whose availability and visibility are propagated through barriers. */
struct trail {
    uint32_t slot;    /* slot after whose barriers `after` is valid */
    uint32_t after;   /* stages ordered after the write became available, or 0 */
    uint32_t batch;   /* slot of the batch that added `pending` */
    uint32_t pending; /* stages to add to `after` when that batch is complete */
    VkAccessFlags2 visible[HAZARD_STAGE_COUNT];
};

static void advance(struct hazard *h, struct trail *trail, uint32_t slot)
{
    uint32_t after = trail->after;
    for (uint32_t stage = 0; slot > trail->slot && stage < HAZARD_STAGE_COUNT; stage++)
        if (trail->after & 1U << stage)
            after |= reach(h, trail->slot, stage, slot);
    trail->after = after;
    trail->slot = slot;
}

/* Advances the trail to just before the barriers of a slot. */
static void advance_before(struct hazard *h, struct trail *trail, uint32_t slot)
{
    if (trail->batch && trail->batch < slot) {
        advance(h, trail, trail->batch);
        trail->after |= trail->pending;
        trail->pending = 0;
        trail->batch = 0;
    }
    if (slot > trail->slot + 1)
        advance(h, trail, slot - 1);
}

static bool makes_available(const struct hazard_barrier *barrier, const struct hazard_record *write)
{
    return !write->available && !(write->stages & ~barrier->src) &&
           !(write->access & ~barrier->src_access);
}

static void make_visible(struct trail *trail, uint32_t stages, VkAccessFlags2 access)
{
    for (uint32_t stage = 0; stage < HAZARD_STAGE_COUNT; stage++)
        if (stages & 1U << stage)
            trail->visible[stage] |= access;
}

static void pass_barrier(struct hazard *h, struct trail *trail, const struct hazard_record *write,
                         const struct hazard_node *node)
{
    uint32_t slot = node->record.slot;
    const struct hazard_barrier *barrier = &h->barriers[node->barrier];
    if (slot <= write->slot)
        return; /* the barrier precedes the write, or shares its batch */
    if (hazard_waits(h, write->slot, slot)) { /* the write is visible to the barrier's queue */
        trail->batch = slot;
        trail->pending |= barrier->later;
        make_visible(trail, barrier->dst, barrier->dst_access);
        return;
    }
    if (hazard_queue_of(h, write->slot) != hazard_queue_of(h, slot))
        return;
    advance_before(h, trail, slot);
    if (!makes_available(barrier, write) && !(trail->after & barrier->earlier))
        return;
    trail->batch = slot;
    trail->pending |= barrier->later;
    make_visible(trail, barrier->dst, barrier->dst_access);
}

static uint32_t slot_of(const struct hazard *h, uint32_t node)
{
    return h->nodes[node].record.slot;
}

/* Returns true if the write is available and visible to the event. Considers the barriers on the
 * subresource written and those on the event's subresource, which may alias it. */
static bool is_visible(struct hazard *h, const struct hazard_record *write,
                       const struct hazard_event *event, uint32_t barriers, uint32_t others)
{
    /* An import may return as it arrived: after a write of its access, or after a layout transition
     * to a conditional pass that did not run. Whoever uses it next waits for these stages. */
    if (event->returned && write->stages && !(write->stages & ~event->stages) &&
        !(write->access & ~event->writes))
        return true;
    /* a semaphore makes the write visible to all commands after its wait, but not to the host */
    if (hazard_waits(h, write->slot, event->slot) && !(event->stages & HAZARD_HOST))
        return !event->transition || event->transition->src;
    if (hazard_queue_of(h, write->slot) != hazard_queue_of(h, event->slot) &&
        !(event->stages & HAZARD_HOST))
        return false;
    struct trail trail = { .slot = write->slot };
    if (write->available) {
        trail.after = hazard_later(write->stages);
        make_visible(&trail, write->stages, write->access);
    }
    uint32_t end = event->transition ? event->slot : event->slot + 1;
    while (barriers != RG_NONE || others != RG_NONE) {
        bool first = others == RG_NONE ||
                     (barriers != RG_NONE && slot_of(h, barriers) <= slot_of(h, others));
        uint32_t *list = first ? &barriers : &others;
        if (slot_of(h, *list) >= end)
            break;
        pass_barrier(h, &trail, write, &h->nodes[*list]);
        *list = h->nodes[*list].next;
    }
    if (event->transition) {
        advance_before(h, &trail, event->slot);
        return makes_available(event->transition, write) ||
               (trail.after & event->transition->earlier);
    }
    VkAccessFlags2 wanted = event->reads | event->writes;
    for (uint32_t stage = 0; stage < HAZARD_STAGE_COUNT; stage++)
        if ((event->stages & 1U << stage) && (wanted & ~trail.visible[stage]) &&
            (wanted & hazard_accesses_of(1U << stage) & ~trail.visible[stage]))
            return false;
    return true;
}

static bool changes(const struct hazard_event *event)
{
    return event->writes || event->transition;
}

static const char *kind_of(const struct hazard_event *event, bool after_write)
{
    if (event->transition)
        return after_write ? "transition after write" : "transition after read";
    if (event->writes)
        return after_write ? "write after write" : "write after read";
    return "read after write";
}

static void check_cell(struct hazard *h, uint32_t past, uint32_t cell,
                       const struct hazard_event *event)
{
    const struct hazard_subresource *c = &h->cells[past];
    const char *other = past == cell ? "" : " of an alias";
    uint32_t others = past == cell ? RG_NONE : h->cells[cell].barriers;
    if (c->written && !is_visible(h, &c->write, event, c->barriers, others))
        hazard_report_subresource(h, cell, "%s%s in slot %u, without memory dependency",
                                  kind_of(event, true), other, c->write.slot);
    for (uint32_t i = c->reads; changes(event) && i != RG_NONE; i = h->nodes[i].next)
        if (!is_ordered(h, &h->nodes[i].record, event))
            hazard_report_subresource(h, cell, "%s%s in slot %u, without execution dependency",
                                      kind_of(event, false), other, h->nodes[i].record.slot);
}

static void check_aliases(struct hazard *h, uint32_t cell, const struct hazard_event *event)
{
    const struct hazard_subresource *c = &h->cells[cell];
    const struct hazard_resource *resource = &h->resources[c->resource];
    for (uint32_t a = 0; a < resource->alias_count; a++) {
        struct hazard_resource *alias = &h->resources[h->aliases[resource->first_alias + a]];
        for (uint32_t i = 0; alias->touched > c->touched && i < alias->cell_count; i++)
            if (h->cells[alias->first_cell + i].touched > c->touched)
                check_cell(h, alias->first_cell + i, cell, event);
        if (changes(event))
            alias->overwritten = h->time;
    }
}

static uint32_t add_node(struct hazard *h, struct hazard_record record, uint32_t next)
{
    h->nodes = hazard_grow(h->nodes, &h->node_capacity, h->node_count + 1, sizeof(*h->nodes));
    h->nodes[h->node_count] = (struct hazard_node){ .record = record, .next = next };
    return h->node_count++;
}

static void set_write(struct hazard_subresource *cell, struct hazard_record write)
{
    cell->written = true;
    cell->write = write;
    cell->reads = cell->barriers = cell->last_barrier = RG_NONE;
}

void hazard_sync_event(struct hazard *h, uint32_t cell, const struct hazard_event *event)
{
    struct hazard_subresource *c = &h->cells[cell];
    check_cell(h, cell, cell, event);
    h->time++;
    check_aliases(h, cell, event);
    struct hazard_record record = { .slot = event->slot, .stages = event->stages };
    if (event->transition) {
        record.stages = event->transition->dst;
        record.access = event->transition->dst_access;
        record.available = true;
    } else {
        record.access = event->writes;
    }
    if (changes(event)) {
        set_write(c, record);
        c->changed = h->time;
    } else {
        c->reads = add_node(h, record, c->reads);
    }
    c->touched = h->resources[c->resource].touched = h->time;
}

bool hazard_sync_overwritten(const struct hazard *h, uint32_t cell)
{
    return h->resources[h->cells[cell].resource].overwritten > h->cells[cell].changed;
}

static void check_old_layout(struct hazard *h, uint32_t cell, const struct rg_barrier *barrier)
{
    struct hazard_subresource *c = &h->cells[cell];
    VkImageLayout real = hazard_sync_overwritten(h, cell) ? VK_IMAGE_LAYOUT_UNDEFINED : c->layout;
    if (barrier->old_layout == VK_IMAGE_LAYOUT_UNDEFINED)
        c->content = HAZARD_UNDEFINED;
    else if (barrier->old_layout != real)
        hazard_report_subresource(h, cell, "barrier from layout %d, but it is in %d",
                                  (int)barrier->old_layout, (int)real);
    c->layout = barrier->new_layout;
}

void hazard_sync_barrier(struct hazard *h, uint32_t cell, uint32_t barrier)
{
    struct hazard_subresource *c = &h->cells[cell];
    if (c->batch == h->slot)
        hazard_report_subresource(h, cell, "two barriers in one batch");
    c->batch = h->slot;
    if (h->resources[c->resource].image)
        check_old_layout(h, cell, &h->plan->barriers[barrier]);
    if (h->barriers[barrier].transition) {
        hazard_sync_event(
            h, cell,
            &(struct hazard_event){ .slot = h->slot, .transition = &h->barriers[barrier] });
        return;
    }
    uint32_t node = add_node(h, (struct hazard_record){ .slot = h->slot }, RG_NONE);
    h->nodes[node].barrier = barrier;
    if (c->last_barrier == RG_NONE)
        c->barriers = node;
    else
        h->nodes[c->last_barrier].next = node;
    c->last_barrier = node;
}

void hazard_sync_import(struct hazard *h, uint32_t cell, uint32_t slot, enum rg_access access)
{
    const struct hazard_rule *rule = hazard_rule(access);
    struct hazard_record write = {
        .slot = slot,
        .stages = rule->stages ? rule->stages : (uint32_t)HAZARD_SHADERS,
        .access = rule->writes ? rule->writes : rule->reads,
        .available = !rule->writes,
    };
    set_write(&h->cells[cell], write);
    if (rule->reads && !rule->writes)
        h->cells[cell].reads = add_node(h, write, RG_NONE);
    h->cells[cell].layout = rule->layout;
    h->cells[cell].content = HAZARD_IMPORTED;
}

void hazard_sync_reset(struct hazard *h, uint32_t cell)
{
    struct hazard_subresource *c = &h->cells[cell];
    struct hazard_resource *resource = &h->resources[c->resource];
    resource->touched = resource->overwritten = 0;
    *c = (struct hazard_subresource){
        .resource = c->resource,
        .reads = RG_NONE,
        .barriers = RG_NONE,
        .last_barrier = RG_NONE,
    };
    if (!resource->persistent)
        return;
    /* persistent resources start cleared or filled; a fill may run in the clear or copy stage */
    struct hazard_record write = {
        .stages = resource->image ? HAZARD_CLEAR : HAZARD_CLEAR | HAZARD_COPY,
        .access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
    };
    set_write(c, write);
    c->layout = resource->image ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_UNDEFINED;
    c->content = HAZARD_ZERO;
}
