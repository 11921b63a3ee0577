/* draft_renderer.c: draft renderers for interaction, and the choice of their quality level. */
#include "src/view/draft_renderer.h"
#include <math.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/settings/quality.h"
#include "src/settings/scene_settings.h"
#include "src/tech/refract/refract_bounce.h"

/* Upper limits of settings in drafts. A limit applies from draft level `level` upwards. */
static const struct {
    const char *setting;
    double value;
    enum draft_renderer_level level;
} rows[] = {
    { "ice_interval.count", 1.0, DRAFT_RENDERER_FULL }, /* one ray interval for crack clipping */
    { "refract_bounce.margin", 0.0, DRAFT_RENDERER_FULL },
    { "refract_bounce.nested", 0.0, DRAFT_RENDERER_FULL },
    { "refract_bounce.reflections", 2.0, DRAFT_RENDERER_FULL },
    { "refract_bounce.steps", 4.0, DRAFT_RENDERER_FULL },
    { "refract_bounce.bisections", 4.0, DRAFT_RENDERER_FULL },
    { "ground.shading", GROUND_VERTICES, DRAFT_RENDERER_COARSE_MESH },
};

static const VkExtent2D small = { 32, 24 }; /* just for compiling the shaders */
static const double budget_seconds = 0.016; /* at half size, for 30 fps */
static const double ample_seconds =
    0.008; /* time of the coarsest level, below which finer ones are tried */
static const double hopeless_seconds = 0.2; /* estimate above which half the size is not tried */

struct settings draft_renderer_settings(const struct settings *settings,
                                        enum draft_renderer_level level)
{
    struct settings draft = *settings;
    for (const struct quality_row *row = quality_rows; row->setting; row++) {
        if (quality_is_of_level(settings, row))
            settings_set_value(&draft, settings_find(row->setting), quality_value(row, 0));
    }
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct setting *row = settings_find(rows[i].setting);
        if (level >= rows[i].level)
            settings_set_value(&draft, row, fmin(settings_get(&draft, row), rows[i].value));
    }
    return draft;
}

void draft_renderer_finish(struct draft_renderer *q)
{
    renderer_destroy(q->left);
    renderer_destroy(q->right);
    *q = (struct draft_renderer){ .is_off = q->is_off };
}

static enum status fit(struct renderer **renderer, struct renderer_params params)
{
    params.keep = params.scales = params.measured = true;
    if (*renderer)
        return renderer_change(*renderer, &params);
    const enum status status = renderer_create(renderer, &params);
    if (status == STATUS_OK)
        renderer_measure(*renderer, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
    return status;
}

static const struct technique *faster_model(const struct technique *refraction)
{
    return refraction && refraction->refraction.traces_bvh ? &refract_bounce : refraction;
}

static bool has_faster_model(const struct draft_renderer_params *p)
{
    return faster_model(p->left.refraction) != p->left.refraction ||
           (p->is_split && faster_model(p->right.refraction) != p->right.refraction);
}

static enum status fit_all(struct draft_renderer *q, const struct draft_renderer_params *p)
{
    struct renderer_params left = p->left;
    struct renderer_params right = p->right;
    left.is_coarse = right.is_coarse = q->level >= DRAFT_RENDERER_COARSE_MESH;
    left.settings = &q->settings;
    right.settings = &q->right_settings;
    if (q->level == DRAFT_RENDERER_BOUNCE) {
        left.refraction = faster_model(left.refraction);
        right.refraction = faster_model(right.refraction);
    }
    q->version = p->version;
    enum status status = fit(&q->left, left);
    if (status == STATUS_OK && p->is_split)
        status = fit(&q->right, right);
    return status;
}

/* Recomputes the draft settings. Returns true if they require recompiled render-graph plans. */
static bool take_settings(struct draft_renderer *q, const struct draft_renderer_params *p)
{
    const struct settings left = q->settings;
    const struct settings right = q->right_settings;
    q->settings = draft_renderer_settings(p->left.settings, q->level);
    q->right_settings = draft_renderer_settings(p->right.settings, q->level);
    return settings_changed(&left, &q->settings) >= SETTING_AFFECTS_PLAN ||
           (p->is_split && settings_changed(&right, &q->right_settings) >= SETTING_AFFECTS_PLAN);
}

/* Disables draft renderers. Hides STATUS_TRY_AGAIN (out of memory), since drafts are optional. */
static enum status give_up(struct draft_renderer *q, enum status status)
{
    draft_renderer_finish(q);
    q->failed = true;
    return status == STATUS_TRY_AGAIN ? STATUS_OK : status;
}

/* Draws a frame that is not displayed and stores the seconds it took in q->seconds. */
static enum status draw_timed(struct draft_renderer *q, const struct renderer_shot *shot,
                              VkExtent2D view)
{
    const double start = clock_seconds();
    enum status status = draft_renderer_draw(q, shot, view);
    if (status == STATUS_OK)
        status = renderer_wait(q->left);
    if (status == STATUS_OK && q->right)
        status = renderer_wait(q->right);
    q->seconds = clock_seconds() - start;
    return status;
}

static enum draft_renderer_level last_level(const struct draft_renderer_params *p)
{
    return has_faster_model(p) ? DRAFT_RENDERER_BOUNCE : DRAFT_RENDERER_COARSE_MESH;
}

static enum status make(struct draft_renderer *q, const struct draft_renderer_params *p,
                        const struct renderer_shot *shot, enum draft_renderer_level level)
{
    const VkExtent2D half = { p->left.width / 2 + 1, p->left.height / 2 + 1 };
    const VkExtent2D quarter = { half.width / 2 + 1, half.height / 2 + 1 };
    const VkExtent2D min_extent = { half.width < small.width ? half.width : small.width,
                                    half.height < small.height ? half.height : small.height };
    q->level = level;
    (void)take_settings(q, p);
    enum status status = fit_all(q, p);
    if (status == STATUS_OK)
        status = draw_timed(q, shot, min_extent); /* compiles the shaders */
    if (status == STATUS_OK)
        status = draw_timed(q, shot, quarter);
    q->seconds *= 4.0;
    if (status == STATUS_OK && (q->seconds < hopeless_seconds || level == last_level(p)))
        status = draw_timed(q, shot, half);
    return status;
}

enum status draft_renderer_create(struct draft_renderer *q, const struct draft_renderer_params *p,
                                  const struct renderer_shot *shot)
{
    const enum draft_renderer_level last = last_level(p);
    enum status status = make(q, p, shot, last);
    if (status == STATUS_OK && q->seconds < ample_seconds)
        status = make(q, p, shot, DRAFT_RENDERER_FULL);
    while (status == STATUS_OK && q->seconds > budget_seconds && q->level < last)
        status = make(q, p, shot, q->seconds > hopeless_seconds ? last : q->level + 1);
    return status == STATUS_OK ? status : give_up(q, status);
}

enum status draft_renderer_update(struct draft_renderer *q, const struct draft_renderer_params *p)
{
    if (!q->left || (!take_settings(q, p) && q->version == p->version))
        return STATUS_OK;
    const enum status status = fit_all(q, p);
    return status == STATUS_OK ? status : give_up(q, status);
}

enum status draft_renderer_draw(struct draft_renderer *q, const struct renderer_shot *shot,
                                VkExtent2D view)
{
    enum status status = renderer_set_view(q->left, view);
    if (status == STATUS_OK && q->right)
        status = renderer_set_view(q->right, view);
    if (status == STATUS_OK)
        status = renderer_draw(q->left, shot);
    if (status == STATUS_OK && q->right)
        status = renderer_draw(q->right, shot);
    return status;
}
