/*
 * over.c: composites the inclusions (air, bubbles, cracks, premultiplied, in this order) on top of
 * the ice and adds the highlights of the light sources.
 *
 * The shader has a fixed set of bindings; those of techniques that are off are bound to the
 * highlights and not read.
 */
#include "shaders/over.h"
#include <string.h>
#include "shaders/constants.h"
#include "shaders/embedded.h"
#include "src/settings/scene_settings.h"
#include "src/tech/air.h"
#include "src/tech/bubbles.h"
#include "src/tech/cracks.h"
#include "src/tech/frame.h"
#include "src/tech/ice_normal.h"
#include "src/tech/refract.h"
#include "src/tech/row_builder.h"
#include "src/tech/surface.h"

static rg_record_fn record_area;

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    AIR_USE_ENVIRONMENT,
    FRAME_SAMPLE(surface_highlight, OVER_HIGHLIGHT, .same_texel = true),
    FRAME_SAMPLE(air_cover, OVER_AIR, .same_texel = true),
    FRAME_SAMPLE(bubbles_color, OVER_BUBBLES, .same_texel = true),
    FRAME_SAMPLE(cracks_color, OVER_CRACKS, .same_texel = true),
    { 0 },
};

static const struct rg_use bent_uses[] = {
    FRAME_SAMPLE(ice_normal_front_depth, OVER_FRONT_DEPTH, .same_texel = true),
    FRAME_SAMPLE(ice_normal_shading, OVER_SHADING, .same_texel = true),
    FRAME_READ(bubbles_depth, OVER_BUBBLE_DEPTH),
    { 0 },
};

static const struct rg_pass passes[] = {
    {
        .name = "over.ice",
        .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }),
        .vert = &over_vert,
        .frag = &over_frag,
        .record = record_area,
    },
};

/* Returns CONSTANT_OVER: the layers to composite, which the refraction model does not draw. */
static uint32_t layers_of(const struct settings *settings, const struct technique *rung,
                          bool is_cloudy)
{
    const bool uses_bvh = rung && rung->rung.meets_tree;
    const struct target_params *target = settings_of(settings, &target_settings);
    const struct light_params *light = settings_of(settings, &light_settings);
    /* The refraction model has drawn cracks except for their highlights. */
    const bool is_without_cracks = cracks_are_met(settings, rung) && !light->count;
    return (surface.is_on(settings) ? OVER_HAS_HIGHLIGHT : 0u) |
           (air.is_on(settings) && !((uses_bvh || is_cloudy) && air_is_medium(settings))
                ? OVER_HAS_AIR
                : 0u) |
           (bubbles.is_on(settings) && !uses_bvh ? OVER_HAS_BUBBLES : 0u) |
           (cracks_are_in_ice(settings) && !uses_bvh && !is_without_cracks ? OVER_HAS_CRACKS : 0u) |
           (target->scale < 1.0f ? OVER_IS_SMALL : 0u);
}

static struct rg_technique make_rows(const struct technique_choice *choice,
                                     struct row_builder *builder)
{
    const uint32_t bits = layers_of(choice->settings, choice->rung, choice->is_cloudy);
    struct rg_use changed[sizeof(uses) / sizeof(uses[0])];
    struct rg_pass *rows = row_builder_rows(builder, passes, 1);
    if (!(bits & ~OVER_IS_SMALL) || !rows)
        return (struct rg_technique){ 0 };
    memcpy(changed, uses, sizeof(uses));
    for (struct rg_use *use = changed; use->access; use++) {
        const bool is_layer =
            use->binding == OVER_AIR || use->binding == OVER_BUBBLES || use->binding == OVER_CRACKS;
        if (use->image && is_layer && !(bits & 1u << use->binding))
            use->image = &surface_highlight;
        if (use->image == &bubbles_color && bubbles_are_bent(choice))
            use->same_texel = false;
    }
    const bool shows_refracted = (bits & OVER_HAS_BUBBLES) && bubbles_are_bent(choice);
    rows->uses = row_builder_uses(
        builder, (const struct rg_use *const[]){ changed, shows_refracted ? bent_uses : NULL }, 2);
    rows->vert = shows_refracted ? &over_bent_vert : &over_vert;
    rows->frag = shows_refracted ? &over_bent_frag : &over_frag;
    return (struct rg_technique){ "over", rows, 1 };
}

static void record_area(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, frame->object_area);
    rg_cmd_draw(cmd, 3);
}

static void write_constants(const struct technique_subject *subject, uint32_t *values)
{
    const bool is_cloudy = refract_is_cloudy(subject->rung, subject->scene, subject->settings);
    values[CONSTANT_OVER] = layers_of(subject->settings, subject->rung, is_cloudy);
}

const struct technique over = {
    .name = "over",
    .help = "compositing of air, bubbles, cracks and highlights over the ice",
    .parts = { { PHASE_COMPOSITE, .rows = make_rows } },
    .write_constants = write_constants,
};
