/* absorption.c: Beer-Lambert absorption of light in the object: settings and uniforms. */
#include "src/tech/refract/absorption.h"
#include "src/tech/frame_resources.h"

#define ABSORPTION(channel) \
    { \
        SETTING_FIELD("absorb." #channel, FLOAT, struct absorb_params, channel), \
            .label = "Absorption, " #channel, .max = 1e4, .unit = "1/metre", \
            .help = "absorption coefficient of the object for " #channel " light" \
    }

static const struct setting rows[] = { ABSORPTION(red), ABSORPTION(green), ABSORPTION(blue) };

SETTING_GROUP(absorb, rows, struct absorb_params);

static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct absorb_params *params = settings_of(view->settings, &absorb_settings);
    g->absorb = (vec3s){ { params->red, params->green, params->blue } };
}

const struct technique absorption = {
    .name = "absorb",
    .help = "absorption of light in the object",
    .settings = &absorb_settings,
    .write_globals = write_globals,
};
