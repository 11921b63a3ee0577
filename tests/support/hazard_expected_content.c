/* hazard_expected_content.c: computes which content resources should have in each scenario. */
#include <string.h>

#include "tests/support/hazard_private.h"

bool hazard_runs(const struct hazard *h, const struct hazard_pass *pass, uint32_t frame)
{
    if (!pass->condition)
        return true;
    uint32_t bit = frame * h->condition_count + pass->condition - 1;
    if (h->every_scenario)
        return h->scenario >> bit & 1;
    if (h->scenario < 2) /* the first two sampled scenarios: all conditions false, then all true */
        return h->scenario == 1;
    uint32_t mixed = (h->scenario * 64 + bit) * UINT32_C(0x9e3779b1);
    mixed = (mixed ^ mixed >> 15) * UINT32_C(0x85ebca77);
    return mixed >> 16 & 1;
}

struct hazard_expected *hazard_expected(const struct hazard *h, const struct hazard_use *use,
                                        uint32_t frame)
{
    return &h->expected[(size_t)frame * h->expected_count + use->first_expected];
}

static uint32_t first_content(const struct hazard_resource *resource)
{
    if (resource->import && resource->import->access != RG_ACCESS_NONE)
        return HAZARD_IMPORTED;
    if (resource->buffer && resource->buffer->memory == RG_MEMORY_UPLOAD)
        return HAZARD_UPLOADED;
    return HAZARD_UNDEFINED;
}

/* Returns true if the content of the last frame is lost at the start of a frame. */
static bool is_replaced(const struct hazard *h, uint32_t cell)
{
    return hazard_partner(h, cell) != cell && !hazard_is_history(h, cell);
}

static void begin(struct hazard *h, uint32_t frame)
{
    for (uint32_t i = 0; i < h->cell_count; i++) {
        const struct hazard_resource *resource = &h->resources[h->cells[i].resource];
        if (!resource->persistent || is_replaced(h, i))
            h->cells[i].declared = first_content(resource);
        else if (frame == 0)
            h->cells[i].declared = HAZARD_ZERO;
        else if (hazard_is_history(h, i))
            h->cells[i].declared = h->ends[(frame - 1) * h->cell_count + hazard_partner(h, i)];
    }
}

static void expect(struct hazard *h, const struct hazard_use *use, uint32_t frame)
{
    struct hazard_expected *expected = hazard_expected(h, use, frame);
    uint32_t cell;
    for (uint32_t i = 0; (cell = hazard_next_subresource(&h->resources[use->resource], &use->range,
                                                         &i)) != RG_NONE;)
        *expected++ = (struct hazard_expected){ h->cells[cell].declared, use->needs_content };
}

static void set_content(struct hazard *h, const struct hazard_use *use, uint32_t content)
{
    uint32_t cell;
    for (uint32_t i = 0; (cell = hazard_next_subresource(&h->resources[use->resource], &use->range,
                                                         &i)) != RG_NONE;)
        h->cells[cell].declared = content;
}

static void read_forward(struct hazard *h, uint32_t frame)
{
    begin(h, frame);
    for (uint32_t p = 0; p < h->pass_count; p++) {
        const struct hazard_pass *pass = &h->passes[p];
        if (!hazard_runs(h, pass, frame))
            continue;
        const struct hazard_use *uses = h->uses + pass->first_use;
        for (uint32_t u = 0; u < pass->use_count; u++)
            expect(h, &uses[u], frame);
        for (uint32_t u = 0; u < pass->use_count; u++)
            if (uses[u].gives_content)
                set_content(h, &uses[u], HAZARD_WRITTEN + frame * h->pass_count + p);
    }
    for (uint32_t i = 0; i < h->cell_count; i++)
        h->ends[frame * h->cell_count + i] = h->cells[i].declared;
}

static bool is_use_wanted(const struct hazard *h, const struct hazard_use *use)
{
    uint32_t cell;
    for (uint32_t i = 0;
         use->gives_content && (cell = hazard_next_subresource(&h->resources[use->resource],
                                                               &use->range, &i)) != RG_NONE;)
        if (h->cells[cell].wanted)
            return true;
    return false;
}

static bool is_wanted(const struct hazard *h, const struct hazard_pass *pass)
{
    for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++) {
        if (is_use_wanted(h, &h->uses[u]))
            return true;
    }
    return false;
}

static bool is_color(const struct hazard_pass *pass, const struct hazard_use *use)
{
    return use->target && use->target != &pass->pass->depth;
}

/* Marks the colour targets after the last one that is needed. The first is always kept, and rows
 * without a fragment shader keep all. */
static void mark_dropped(struct hazard *h, const struct hazard_pass *pass)
{
    if (!pass->pass->frag || !pass->pass->color)
        return;
    const struct rg_target *end = pass->pass->color + 1;
    for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++) {
        const struct hazard_use *use = &h->uses[u];
        if (is_color(pass, use) && use->target >= end && is_use_wanted(h, use))
            end = use->target + 1;
    }
    for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++)
        h->uses[u].dropped = is_color(pass, &h->uses[u]) && h->uses[u].target >= end;
}

/* Updates, in a backward analysis, which content is needed before a use. `surely` is true if the
 * pass always runs, so that the content it overwrites is not needed before it. */
static void want(struct hazard *h, const struct hazard_use *use, bool surely,
                 struct hazard_expected *expected)
{
    uint32_t cell;
    for (uint32_t i = 0;
         !use->dropped && (cell = hazard_next_subresource(&h->resources[use->resource], &use->range,
                                                          &i)) != RG_NONE;) {
        struct hazard_subresource *c = &h->cells[cell];
        if (expected && use->keeps_content) /* a partial write may come first */
            expected->wanted = c->wanted && expected->content != HAZARD_UNDEFINED;
        if (use->needs_content)
            c->wanted = true;
        else if (use->gives_content && !use->keeps_content && surely)
            c->wanted = false;
        if (expected)
            expected++;
    }
}

/* Marks the content needed after a frame: outputs, and persistent content for the next frame. */
static void end_backward(struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++) {
        if (!hazard_is_history(h, i))
            continue;
        h->cells[hazard_partner(h, i)].wanted = h->cells[i].wanted;
        h->cells[i].wanted = false;
    }
    for (uint32_t i = 0; i < h->cell_count; i++) {
        struct hazard_subresource *cell = &h->cells[i];
        const struct hazard_resource *resource = &h->resources[cell->resource];
        cell->carried = resource->persistent && cell->wanted;
        cell->wanted = cell->carried || resource->output;
    }
}

static void read_backward(struct hazard *h, uint32_t frame)
{
    end_backward(h);
    for (uint32_t p = h->pass_count; p-- > 0;) {
        struct hazard_pass *pass = &h->passes[p];
        if (!hazard_runs(h, pass, frame) || !is_wanted(h, pass))
            continue;
        pass->needed = true;
        for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++)
            want(h, &h->uses[u], true, hazard_expected(h, &h->uses[u], frame));
    }
}

void hazard_expect(struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++)
        h->cells[i].wanted = false;
    for (uint32_t p = 0; p < h->pass_count; p++)
        h->passes[p].needed = false;
    for (uint32_t frame = 0; frame < h->frame_count; frame++)
        read_forward(h, frame);
    for (uint32_t frame = h->frame_count; frame-- > 0;)
        read_backward(h, frame);
    for (uint32_t p = 0; p < h->pass_count; p++)
        if (h->passes[p].needed && !h->passes[p].lives)
            hazard_report(h, "'%s'[%u] is needed, but culled", h->passes[p].pass->name,
                          h->passes[p].repetition);
}

static bool history_changed(const struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++)
        if (h->resources[h->cells[i].resource].persistent && !is_replaced(h, i) &&
            h->cells[i].wanted != h->cells[hazard_partner(h, i)].carried)
            return true;
    return false;
}

void hazard_expect_useful(struct hazard *h)
{
    for (uint32_t i = 0; i < h->cell_count; i++)
        h->cells[i].wanted = false;
    for (bool more = true; more; more = history_changed(h)) {
        end_backward(h);
        for (uint32_t p = h->pass_count; p-- > 0;) {
            struct hazard_pass *pass = &h->passes[p];
            pass->useful |= is_wanted(h, pass);
            mark_dropped(h, pass);
            for (uint32_t u = 0; pass->useful && u < pass->use_count; u++)
                want(h, &h->uses[pass->first_use + u], !pass->condition, NULL);
        }
    }
}
