/*
 * refract_reference.c: the truth, traced on the CPU (src/reference), as a rung of --refraction.
 *
 * It has no rows, because nothing of it is drawn by the device.
 */
#include "src/tech/refract_reference.h"

static const char *const normals[] = {
    [REFERENCE_NORMALS_INTERPOLATED] = "interpolated",
    [REFERENCE_NORMALS_FLAT] = "flat",
    NULL,
};

static const struct setting rows[] = {
    {
        .name = "reference.cutoff",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct reference_params, cutoff),
        .initial = 1e-3,
        .min = 1e-6, /* the number of branches grows fast in concave objects */
        .max = 1,
        .help = "share of a ray's light below which the ray is terminated (see layer remaining)",
    },
    {
        .name = "reference.bounces",
        .type = SETTING_COUNT,
        .offset = offsetof(struct reference_params, bounces),
        .initial = 64,
        .min = 1,
        .max = REFERENCE_BOUNCES_MAX,
        .help = "maximum number of the object's surfaces on a light path",
    },
    {
        .name = "reference.roulette",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct reference_params, roulette),
        .max = 1,
        .help = "Russian roulette instead of termination at reference.cutoff: no light is missing, "
                "but there is noise",
    },
    {
        .name = "reference.photons",
        .type = SETTING_COUNT,
        .offset = offsetof(struct reference_params, photons),
        .initial = 1000000,
        .max = 100000000,
        .help = "photons of the sun with ice_caustics.light=sun (0: neither caustics nor shadow)",
    },
    {
        .name = "reference.normals",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct reference_params, normals),
        .max = REFERENCE_NORMALS_FLAT,
        .choices = normals,
        .help = "normals of the object: interpolated from its vertices, as rasterised, or flat",
    },
};

const struct setting_group reference_settings =
    SETTING_GROUP("reference", rows, struct reference_params);

static const struct frame_layer layers[] = {
    {
        .name = "remaining",
        .planes = { "remaining.R", "remaining.G", "remaining.B" },
        .mean = true,
        .help = "share of the light on paths that were terminated",
    },
    {
        .name = "met",
        .planes = { "met.Z" },
        .help = "inclusions on the path of exit, added: 1 bubbles, 2 cracks, 4 air",
    },
    {
        .name = "error",
        .planes = { "error.Z" },
        .mean = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "standard error of the mean of red, green and blue, each clipped to 0..1",
    },
    { 0 },
};

const struct technique refract_reference = {
    .name = "refract_reference",
    .help = "reference for all rungs, ray traced on the CPU",
    .settings = { &reference_settings },
    .rung = { .name = "reference" },
    .layers = layers,
};
