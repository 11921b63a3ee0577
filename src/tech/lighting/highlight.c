/*
 * highlight.c: Blinn-Phong highlights of the light sources on the ice's front faces.
 *
 * Seipel and Nivfors 2006, sections 3.1 b and 5: specular highlights of moving light sources on the
 * outside of the ice. The paper does not name the model; this is Blinn's (1977): a power of the
 * cosine between the normal and the half vector. The refraction models compute the highlights,
 * because they have the bump-mapped normal; composite.c adds them to the image.
 *
 * A highlight stands for the mirror image of a round lamp: its peak radiance is the lamp's times
 * the exact Fresnel reflectance at the half vector (highlight.fresnel), so that the ice reflects no
 * more light than it gets. The default exponent 900 has the width of a lamp 9 degrees across.
 *
 * Error: a highlight has equal size for all directions of its light. The lights are invisible and
 * light nothing else.
 */
#include "src/tech/lighting/highlight.h"
#include "shaders/lighting/highlight.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"

/* Reflectance of ice and water at normal incidence, used without the Fresnel factor. */
static const float normal_reflectance = 0.02f;

const struct rg_image highlight_radiance = {
    .name = "highlight.radiance",
    .format = VK_FORMAT_R32_SFLOAT,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("highlight.strength", FLOAT, struct highlight_params, strength),
        .renamed_from = "surface.strength",
        .label = "Highlight",
        .initial = 300,
        .max = 1e5,
        .switches = SETTING_AFFECTS_PLAN,
        .help = "radiance of the lights that highlights on the ice reflect (0 for none)",
    },
    {
        SETTING_FIELD("highlight.shininess", FLOAT, struct highlight_params, shininess),
        .renamed_from = "surface.shininess",
        .label = "Highlight sharpness",
        .initial = 900,
        .min = 1,
        .max = 1e5,
        .help =
            "Blinn-Phong exponent of the highlights on the ice; a larger one makes them smaller",
    },
    {
        SETTING_FIELD("highlight.fresnel", SWITCH, struct highlight_params, fresnel),
        .label = "Fresnel highlights",
        .initial = 1,
        .max = 1,
        .help = "reflectance of highlights by Fresnel's equations; off: 0.02 at all angles",
    },
};

SETTING_GROUP(highlight, rows, struct highlight_params);

static bool is_on(const struct settings *settings)
{
    const struct light_params *light = settings_of(settings, &light_settings);
    const struct highlight_params *params = settings_of(settings, &highlight_settings);
    return light->count > 0 && light->strength > 0.0f && params->strength > 0.0f;
}

static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct highlight_params *params = settings_of(view->settings, &highlight_settings);
    g->highlight = *params;
    if (!params->fresnel)
        g->highlight.strength *= normal_reflectance;
}

const struct technique highlight = {
    .name = "highlight",
    .help = "highlights of the lights on the ice's front",
    .settings = &highlight_settings,
    .is_on = is_on,
    .title = "highlights",
    .write_globals = write_globals,
};
