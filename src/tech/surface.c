/*
 * surface.c: highlights of the lights on the ice's front.
 *
 * Seipel and Nivfors 2006, sections 3.1 b and 5: specular highlights on the outer surface, of light
 * sources that move. The paper does not say which; this is Blinn's (1977): a power of the cosine
 * between the normal and the direction halfway between light and eye. The rungs work them out, who
 * know the bumpy normal; over.c adds them to the picture.
 *
 * Wrong: a highlight keeps its radiance and its size wherever its light stands, where Fresnel's
 * equations make a grazing one up to 56 times as bright; the lights themselves are not seen, and
 * light nothing else.
 */
#include "src/tech/surface.h"
#include "shaders/surface.h"

const struct rg_image surface_highlight = {
    .name = "surface.highlight",
    .format = VK_FORMAT_R32_SFLOAT,
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
