/* reference_settings.c: the rows of reference.*. */
#include "src/reference/reference_settings.h"

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
        .min = 1e-6, /* in concave objects branches multiply */
        .max = 1,
        .help = "share of a ray's light below which it is followed no further (layer remaining)",
    },
    {
        .name = "reference.bounces",
        .type = SETTING_COUNT,
        .offset = offsetof(struct reference_params, bounces),
        .initial = 64,
        .min = 1,
        .max = REFERENCE_BOUNCES_MAX,
        .help = "surfaces of the object that light meets, one after another, at most",
    },
    {
        .name = "reference.normals",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct reference_params, normals),
        .max = REFERENCE_NORMALS_FLAT,
        .choices = normals,
        .help = "normals of the object: those of its vertices, as rasterised, or its triangles'",
    },
};

const struct setting_group reference_settings =
    SETTING_GROUP("reference", rows, struct reference_params);
