/* bump.c: the map of the ice's uneven surface. */
#include "src/tech/bump.h"

const struct rg_image bump_map = {
    .name = "bump.map",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .width = 1,
    .height = 1,
};

static const char *const mappings[] = {
    [BUMP_TRIPLANAR] = "triplanar",
    [BUMP_UV] = "uv",
    NULL,
};

static const struct setting rows[] = {
    {
        .name = "bump.strength",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct bump_params, strength),
        .initial = 0.25,
        .max = 4,
        .help = "how steep the bumps of the ice's surface are (0: none)",
    },
    {
        .name = "bump.scale",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct bump_params, scale),
        .initial = 1.6,
        .min = 0.01,
        .max = 100,
        .help = "how often the bumps repeat across the ice, or a unit of its uv",
    },
    {
        .name = "bump.mask",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct bump_params, mask),
        .initial = 0.4,
        .max = 1,
        .help = "share of the surface that is smooth",
    },
    {
        .name = "bump.mapping",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct bump_params, mapping),
        .initial = BUMP_TRIPLANAR,
        .max = BUMP_UV,
        .choices = mappings,
        .help = "whether they lie along three planes or by the mesh's uv",
    },
    {
        .name = "bump.seed",
        .type = SETTING_COUNT,
        .offset = offsetof(struct bump_params, seed),
        .max = 1e6,
        .help = "another number makes other bumps",
    },
};

const struct setting_group bump_settings = SETTING_GROUP("bump", rows, struct bump_params);
