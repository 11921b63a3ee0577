/*
 * composite.c: composites inclusions over the ice (premultiplied, in the order air, bubbles,
 * cracks) and adds the highlights of the light sources.
 *
 * The shader's bindings are fixed. If a technique is disabled, its binding refers to the highlight
 * image and is not read.
 */
#include "shaders/output/composite.h"
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/specialization_constants.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/bubbles.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/lighting/highlight.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract.h"

static rg_record_fn record_area;

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    AIR_USE_ENVIRONMENT,
    FRAME_SAMPLE(highlight_radiance, COMPOSITE_HIGHLIGHT, .sampler = &frame_same_texel),
    FRAME_SAMPLE(air_cover, COMPOSITE_AIR, .sampler = &frame_same_texel),
    FRAME_SAMPLE(bubbles_color, COMPOSITE_BUBBLES, .sampler = &frame_same_texel),
    FRAME_SAMPLE(cracks_color, COMPOSITE_CRACKS, .sampler = &frame_same_texel),
    { 0 },
};

static const struct rg_pass passes[] = {
    {
        .name = "composite.ice",
        .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }),
        .vert = &composite_vert,
        .frag = &composite_frag,
        .record = record_area,
    },
};

/* Returns COMPOSITE_* flags of the layers that the refraction model has not drawn itself. */
static uint32_t layers_of(const struct technique_config *config)
{
    const struct settings *settings = config->settings;
    const struct technique *refraction = config->refraction;
    const bool uses_bvh = refraction && refraction->refraction.traces_bvh;
    const struct inclusion_target_params *target = settings_of(settings, &inclusions_settings);
    const struct light_params *light = settings_of(settings, &light_settings);
    /* Traced cracks are already in the image, except for their highlights of light sources. */
    const bool is_without_cracks = cracks_are_traced(settings, refraction) && !light->count;
    return (highlight.is_on(settings) ? COMPOSITE_HAS_HIGHLIGHT : 0u) |
           (air.is_on(settings) &&
                    !((uses_bvh || refract_has_medium(config)) && air_is_medium(settings))
                ? COMPOSITE_HAS_AIR
                : 0u) |
           (bubbles.is_on(settings) && !uses_bvh && !bubbles_are_traced(config)
                ? COMPOSITE_HAS_BUBBLES
                : 0u) |
           (cracks_are_in_ice(settings) && !uses_bvh && !is_without_cracks ? COMPOSITE_HAS_CRACKS
                                                                           : 0u) |
           (target->scale < 1.0f ? COMPOSITE_IS_LOW_RES : 0u);
}

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const uint32_t bits = layers_of(config);
    struct rg_use changed[sizeof(uses) / sizeof(uses[0])];
    struct rg_pass *copies = pass_arena_copy_passes(builder, passes, 1);
    if (!(bits & ~COMPOSITE_IS_LOW_RES) || !copies)
        return (struct rg_technique){ 0 };
    memcpy(changed, uses, sizeof(uses));
    for (struct rg_use *use = changed; use->access; use++) {
        const bool is_layer = use->binding == COMPOSITE_AIR || use->binding == COMPOSITE_BUBBLES ||
                              use->binding == COMPOSITE_CRACKS;
        if (use->image && is_layer && !(bits & 1u << use->binding))
            use->image = &highlight_radiance;
    }
    copies->uses = pass_arena_join_uses(builder, (const struct rg_use *const[]){ changed }, 1);
    return (struct rg_technique){ "over", copies, 1 };
}

static void record_area(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, frame->object_area);
    rg_cmd_draw(cmd, 3);
}

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    values[CONSTANT_COMPOSITE] = layers_of(config);
}

const struct technique composite = {
    .name = "composite",
    .help = "compositing of air, bubbles, cracks and highlights over the ice",
    .pass_groups = { { PHASE_COMPOSITE, .make_passes = make_passes } },
    .write_constants = write_constants,
};
