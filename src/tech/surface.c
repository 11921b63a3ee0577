/*
 * surface.c: highlights of the lights on the ice's front.
 *
 * Seipel and Nivfors 2006, sections 3.1 b and 5: specular highlights on the outer surface, of light
 * sources that move. The paper does not say which; this is Blinn's (1977): a power of the cosine
 * between the normal and the direction halfway between light and eye. The rungs work them out, who
 * know the bumpy normal; added to the picture once all is drawn that lies inside.
 *
 * Wrong: a highlight keeps its radiance and its size wherever its light stands, where Fresnel's
 * equations make a grazing one up to 56 times as bright; the lights themselves are not seen, and
 * light nothing else.
 */
#include "src/tech/surface.h"
#include "shaders/embedded.h"
#include "shaders/surface.h"
#include "src/frame.h"
#include "src/tech/refract.h"

const struct rg_image surface_highlight = {
    .name = "surface.highlight",
    .format = VK_FORMAT_R32_SFLOAT,
};

static const struct rg_pass passes[] = {
    {
        .name = "surface.over",
        REFRACT_OVER_TARGETS,
        .uses = RG_USES(FRAME_USE_GLOBALS, { .image = &surface_highlight,
                                             .access = RG_SAMPLED,
                                             .binding = SURFACE_HIGHLIGHTS,
                                             .here = true }),
        REFRACT_FRONT_FACES,
        .frag = &surface_frag,
        .record = frame_draw_object,
    },
};

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
