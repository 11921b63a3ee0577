/* cpu_reference_settings.c: settings of the CPU reference, a refraction model without passes.
 */
#include "src/tech/refract/cpu_reference_settings.h"

static const char *const normals[] = {
    [REFERENCE_NORMALS_INTERPOLATED] = "interpolated",
    [REFERENCE_NORMALS_FLAT] = "flat",
    NULL,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("reference.cutoff", FLOAT, struct reference_params, cutoff),
        .label = "Reference: minimum throughput",
        .initial = 0.008,
        .min = 1e-6, /* branches multiply in concave objects */
        .max = 1,
        .help =
            "throughput below which Russian roulette decides whether a path is followed; without "
            "it, the path is terminated, and the lost throughput is in layer remaining",
    },
    {
        SETTING_FIELD("reference.bounces", COUNT, struct reference_params, bounces),
        .label = "Reference: maximum bounces",
        .initial = 64,
        .min = 1,
        .max = REFERENCE_BOUNCES_MAX,
        .help = "maximum number of object surfaces on a path",
    },
    {
        SETTING_FIELD("reference.russian_roulette", SWITCH, struct reference_params, roulette),
        .renamed_from = "reference.roulette",
        .label = "Reference: Russian roulette",
        .initial = 1,
        .max = 1,
        .help = "Russian roulette instead of termination at reference.cutoff: unbiased, "
                "with a little noise",
    },
    {
        SETTING_FIELD("reference.photons", COUNT, struct reference_params, photons),
        .label = "Reference: caustic photons",
        .initial = 1000000,
        .max = 100000000,
        .help = "number of photons from the sun with ice_caustics.light=sun (0: no caustics, no "
                "shadow)",
    },
    {
        SETTING_FIELD("reference.normals", CHOICE, struct reference_params, normals),
        .label = "Reference: normals",
        .max = REFERENCE_NORMALS_FLAT,
        .choices = normals,
        .help = "normals of the object: interpolated from vertices, as in rasterisation, or flat",
    },
};

SETTING_GROUP(reference, rows, struct reference_params);

static const struct frame_layer layers[] = {
    {
        .name = "remaining",
        .planes = { "remaining.R", "remaining.G", "remaining.B" },
        .mean = true,
        .help = "throughput of terminated paths",
    },
    {
        .name = "inclusions",
        .planes = { "inclusions.Z" },
        .help = "inclusions that the path of layer exit hits, as a sum of 1 (bubbles), 2 (cracks) "
                "and 4 (air)",
    },
    {
        .name = "error",
        .planes = { "error.Z" },
        .mean = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "standard error of the mean of red, green and blue, each clamped to 0..1",
    },
    { 0 },
};

const struct technique cpu_reference_settings = {
    .name = "refract_reference",
    .help = "reference for all refraction models, ray traced on the CPU",
    .settings = &reference_settings,
    .refraction = { .name = "reference" },
    .layers = layers,
};
