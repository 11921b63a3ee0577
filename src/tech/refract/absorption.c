/* absorption.c: Beer-Lambert absorption of light in the object: settings and uniforms. */
#include "src/tech/refract/absorption.h"
#include "src/tech/frame_resources.h"

static const struct setting rows[] = {
    {
        SETTING_FIELD("absorb.red", FLOAT, struct absorb_params, red),
        .label = "Absorption, red",
        .max = 1e4,
        .unit = "1/metre",
        .help = "absorption coefficient of the object for red light",
    },
    {
        SETTING_FIELD("absorb.green", FLOAT, struct absorb_params, green),
        .label = "Absorption, green",
        .max = 1e4,
        .unit = "1/metre",
        .help = "absorption coefficient of the object for green light",
    },
    {
        SETTING_FIELD("absorb.blue", FLOAT, struct absorb_params, blue),
        .label = "Absorption, blue",
        .max = 1e4,
        .unit = "1/metre",
        .help = "absorption coefficient of the object for blue light",
    },
};

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
