/*
 * surface.c: highlights of the lights on the ice's front.
 *
 * Seipel and Nivfors 2006, sections 3.1 b and 5: specular highlights on the outer surface, of light
 * sources that move. The paper does not say which; this is Blinn's (1977): a power of the cosine
 * between the normal and the direction halfway between light and eye. Added to the picture.
 *
 * Wrong: a highlight keeps its radiance and its size wherever its light stands, where Fresnel's
 * equations make a grazing one up to 56 times as bright; the lights themselves are not seen, and
 * light nothing else.
 */
#include "src/tech/surface.h"
#include "shaders/embedded.h"
#include "shaders/surface.h"
#include "src/frame.h"
#include "src/tech/bump.h"
#include "src/tech/refract.h"

static rg_record_fn record_object;

static const struct rg_pass passes[] = {
    {
        .name = "surface.over",
        REFRACT_OVER_TARGETS,
        .uses = RG_USES(FRAME_USE_GLOBALS),
        REFRACT_FRONT_FACES,
        .frag = &surface_frag,
        .push_size = sizeof(struct surface_params),
        .record = record_object,
    },
};

static const struct rg_pass bumped_passes[] = {
    {
        .name = "surface.over",
        REFRACT_OVER_TARGETS,
        .uses = RG_USES(FRAME_USE_GLOBALS, BUMP_USE_MAPS),
        REFRACT_BUMPED_FACES,
        .frag = &surface_bump_frag,
        .push_size = sizeof(struct surface_params),
        .record = record_object,
    },
};

static void record_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &surface_settings),
                sizeof(struct surface_params));
    rg_cmd_draw_mesh(cmd, &frame->object);
}

static const struct setting rows[] = {
    {
        .name = "surface.strength",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct surface_params, strength),
        .initial = 6,
        .max = 100,
        .help = "brightness of the lights' highlights on the ice (0: none)",
    },
    {
        .name = "surface.shininess",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct surface_params, shininess),
        .initial = 900,
        .min = 1,
        .max = 1e5,
        .help = "how small and sharp they are",
    },
};

const struct setting_group surface_settings = SETTING_GROUP("surface", rows, struct surface_params);

const struct technique surface = {
    .graph = RG_TECHNIQUE("surface", passes),
    .settings = &surface_settings,
    .help = "highlights of the lights on the ice",
};

const struct technique surface_bumped = {
    .graph = RG_TECHNIQUE("surface", bumped_passes),
    .settings = &surface_settings,
    .help = "the same on its bumps",
};
