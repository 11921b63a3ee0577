/* refract.c: the layers that every refraction rung can write, and the index of refraction. */
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
};

const struct setting_group refract_settings = SETTING_GROUP("refract", rows, struct refract_params);
