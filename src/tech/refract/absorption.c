/* absorption.c: Beer-Lambert absorption of light in the object: settings and uniforms. */
#include "src/tech/refract/absorption.h"
#include "src/tech/frame_resources.h"

static const struct setting rows[] = {
    {
        .name = "absorb.red",
        .label = "Absorption, red",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct absorb_params, red),
        .max = 1e4,
        .unit = "1/metre",
        .help = "absorption coefficient of the object for red light",
    },
    {
        .name = "absorb.green",
        .label = "Absorption, green",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct absorb_params, green),
        .max = 1e4,
        .unit = "1/metre",
        .help = "absorption coefficient of the object for green light",
    },
    {
        .name = "absorb.blue",
        .label = "Absorption, blue",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct absorb_params, blue),
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
