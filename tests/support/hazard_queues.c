/* hazard_queues.c: submissions to several queues, and which of them semaphores order. */
#include "tests/support/hazard_private.h"

/* Returns the queue that the tables state for a pass of the plan. */
static enum rg_queue declared_queue(const struct hazard *h, const struct rg_pass *pass)
{
    return h->params->queues >> pass->queue & 1 ? pass->queue : RG_QUEUE_MAIN;
}

bool hazard_has_queues(const struct hazard *h, const struct hazard_resource *resource)
{
    for (uint32_t p = 0; p < h->plan->pass_count; p++) {
        const struct hazard_pass *pass = &h->passes[h->plan_passes[p]];
        for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++) {
            const struct hazard_resource *used = &h->resources[h->uses[u].resource];
            bool same = used == resource ||
                        (used->partner != RG_NONE && &h->resources[used->partner] == resource);
            if (same && declared_queue(h, pass->pass) != RG_QUEUE_MAIN)
                return true;
        }
    }
    return false;
}

/* Returns the submission of a slot; of slots outside of passes, the last one. */
static uint32_t submission_of(const struct hazard *h, uint32_t slot)
{
    const struct rg_plan *plan = h->plan;
    uint32_t pass = (slot - HAZARD_FIRST_SLOT) % (plan->pass_count + 1);
    for (uint32_t s = 0; s < plan->submission_count && slot >= HAZARD_FIRST_SLOT; s++) {
        if (pass - plan->submissions[s].first_pass < plan->submissions[s].pass_count)
            return s;
    }
    return plan->submission_count - 1;
}

enum rg_queue hazard_queue_of(const struct hazard *h, uint32_t slot)
{
    return h->plan->submission_count ? h->plan->submissions[submission_of(h, slot)].queue
                                     : RG_QUEUE_MAIN;
}

/* A submission waits for another one, for those before that on its queue, and for what they wait
 * for; later submissions of a queue wait for what earlier ones wait for. */
static void find_order(struct hazard *h, uint32_t s)
{
    const struct rg_plan *plan = h->plan;
    const uint32_t count = plan->submission_count;
    bool *after = &h->happens_after[s * count];
    for (uint32_t other = 0; other < s; other++) {
        const enum rg_queue queue = plan->submissions[other].queue;
        const bool is_earlier = queue == plan->submissions[s].queue;
        const bool is_awaited = other < plan->submissions[s].waits[queue] && !is_earlier;
        after[other] = after[other] || is_awaited;
        for (uint32_t i = 0; i < other && (is_awaited || is_earlier); i++)
            after[i] = after[i] || h->happens_after[other * count + i];
    }
}

bool hazard_check_queues(struct hazard *h)
{
    const struct rg_plan *plan = h->plan;
    const uint32_t count = plan->submission_count;
    uint32_t next = 0;
    h->happens_after = hazard_grow(NULL, &(uint32_t){ 0 }, count * count + 1, sizeof(bool));
    for (uint32_t s = 0; s < count; s++) {
        const struct rg_submission *submission = &plan->submissions[s];
        bool is_right = submission->first_pass == next && submission->queue < RG_QUEUE_COUNT &&
                        submission->pass_count <= plan->pass_count - next &&
                        !submission->pass_count == (!s || s + 1 == count) &&
                        (submission->pass_count || submission->queue == RG_QUEUE_MAIN);
        for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++) {
            const uint32_t wait = submission->waits[i];
            is_right = is_right && wait <= s && (!wait || plan->submissions[wait - 1].queue == i);
        }
        if (!is_right) {
            hazard_report(h, "submission %u is broken", s);
            return false;
        }
        for (uint32_t p = next; p < next + submission->pass_count; p++) {
            if (declared_queue(h, plan->passes[p].pass) != submission->queue)
                hazard_report(h, "'%s' is on the wrong queue", plan->passes[p].pass->name);
        }
        next += submission->pass_count;
        find_order(h, s);
        if (submission->queue != RG_QUEUE_MAIN && !h->happens_after[s * count])
            hazard_report(h, "submission %u does not wait for the start of the frame", s);
        for (uint32_t i = 0; i < s && s + 1 == count; i++) {
            if (plan->submissions[i].queue != RG_QUEUE_MAIN && !h->happens_after[s * count + i])
                hazard_report(h, "the frame ends before submission %u", i);
        }
    }
    for (uint32_t p = 0; p < plan->pass_count && !count; p++) {
        if (declared_queue(h, plan->passes[p].pass) != RG_QUEUE_MAIN)
            hazard_report(h, "'%s' is on no other queue", plan->passes[p].pass->name);
    }
    return true;
}

bool hazard_waits(const struct hazard *h, uint32_t from, uint32_t to)
{
    const uint32_t count = h->plan->submission_count;
    const uint32_t passes = h->plan->pass_count + 1;
    if (!count)
        return false;
    const uint32_t a = submission_of(h, from), b = submission_of(h, to);
    const bool same_frame = from >= HAZARD_FIRST_SLOT && (from - HAZARD_FIRST_SLOT) / passes ==
                                                             (to - HAZARD_FIRST_SLOT) / passes;
    if (same_frame)
        return h->happens_after[b * count + a];
    /* The first submission follows the previous frame and the accesses of the application. Other
     * queues wait for it, and so do submissions that wait for them. The last submission of a frame
     * waits for all queues. */
    return h->happens_after[b * count] ||
           (from >= HAZARD_FIRST_SLOT && h->happens_after[(count - 1) * count + a]);
}
