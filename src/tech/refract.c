/* refract.c: the layers that every refraction rung can write, and the settings of them all. */
#include "src/tech/refract.h"

const struct rg_image refract_exit = {
    .name = "refract.exit",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

const struct rg_image refract_refraction = {
    .name = "refract.refraction",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image refract_reflection = {
    .name = "refract.reflection",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image refract_fresnel = {
    .name = "refract.fresnel",
    .format = VK_FORMAT_R32_SFLOAT,
};

const struct rg_image refract_way = {
    .name = "refract.way",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

static const char *const fresnels[] = {
    [REFRACT_FRESNEL_PAPER] = "paper",
    [REFRACT_FRESNEL_EXACT] = "exact",
    [REFRACT_FRESNEL_CROSSFADE] = "crossfade",
    NULL,
};

static const char *const lookups[] = {
    [REFRACT_LOOKUP_INFINITE] = "infinite",
    [REFRACT_LOOKUP_DISTANCE] = "distance",
    [REFRACT_LOOKUP_BOX] = "box",
    NULL,
};

static const struct setting rows[] = {
    {
        .name = "refract.ior",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct refract_params, ior),
        .initial = 1.3091,
        .min = 1.0,
        .max = 4.0,
        .help = "refractive index of the object; --material sets it by name",
    },
    {
        .name = "refract.dispersion",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct refract_params, dispersion),
        .max = 10,
        .help = "20 / Abbe number; ice has 0.376",
    },
    {
        .name = "refract.fresnel",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct refract_params, fresnel),
        .max = REFRACT_FRESNEL_CROSSFADE,
        .choices = fresnels,
        .help = "how much is reflected: by the paper's eq. 4, by Fresnel's equations, or evenly",
    },
    {
        .name = "refract.crossfade",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct refract_params, crossfade),
        .initial = 0.8,
        .max = 1,
        .help = "of refract.fresnel=crossfade: 0 all is reflected, 1 all is refracted",
    },
    {
        .name = "refract.lookup",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct refract_params, lookup),
        .max = REFRACT_LOOKUP_BOX,
        .choices = lookups,
        .help = "where the environment is seen: infinitely far away, at its distance, on a box",
    },
    {
        .name = "refract.steps",
        .type = SETTING_COUNT,
        .offset = offsetof(struct refract_params, steps),
        .initial = 4,
        .min = 1,
        .max = 32,
        .help = "of refract.lookup=distance: how often a ray looks how far it has to go",
    },
};

const struct setting_group refract_settings = SETTING_GROUP("refract", rows, struct refract_params);
