/* bump.c: settings and bump map of the ice's uneven surface. */
#include "src/tech/lighting/bump.h"
#include <math.h>
#include "shaders/specialization_constants.h"
#include "src/tech/frame_resources.h"

const struct rg_image bump_map = FRAME_IMPORTED("bump.map", VK_FORMAT_R16G16B16A16_SFLOAT, false);

static const char *const mappings[] = {
    [BUMP_TRIPLANAR] = "triplanar",
    [BUMP_UV] = "uv",
    NULL,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("bump.strength", FLOAT, struct bump_params, strength),
        .label = "Surface bumps",
        .initial = 0.25,
        .max = 4,
        .switches = SETTING_AFFECTS_SCENE,
        .help = "steepness of the bumps of the ice's surface (0 for none)",
    },
    {
        SETTING_FIELD("bump.scale", FLOAT, struct bump_params, scale),
        .label = "Bump frequency",
        .initial = 1.6,
        .min = 0.01,
        .max = 100,
        .help = "repetitions of the bumps across the ice, or per unit of the mesh's uv",
    },
    {
        SETTING_FIELD("bump.mask", FLOAT, struct bump_params, mask),
        .label = "Smooth area",
        .initial = 0.4,
        .max = 1,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "fraction of the ice's surface that is smooth",
    },
    {
        SETTING_FIELD("bump.mapping", CHOICE, struct bump_params, mapping),
        .label = "Bump mapping",
        .initial = BUMP_TRIPLANAR,
        .max = BUMP_UV,
        .choices = mappings,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "texture coordinates of the bumps: triplanar, or the mesh's uv",
    },
    {
        SETTING_FIELD("bump.seed", COUNT, struct bump_params, seed),
        .label = "Random seed of the bumps",
        .max = 1e6,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "random seed of the bumps",
    },
};

SETTING_GROUP(bump, rows, struct bump_params);

static bool is_on(const struct settings *settings)
{
    const struct bump_params *params = settings_of(settings, &bump_settings);
    return params->strength > 0.0f;
}

static struct technique_texels find_map(const struct scene *scene)
{
    return (struct technique_texels){
        .texels = scene->bump.texels,
        .width = scene->bump.size,
        .height = scene->bump.size,
        .all_mips = true,
    };
}

static const uint16_t even[4] = { 0 };

static const struct technique_import imports[] = {
    { &bump_map, find_map, even },
    { 0 },
};

static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct bump_params *params = settings_of(view->settings, &bump_settings);
    const struct melted *melted = &view->scene->melted;
    const float diagonal = melted->lost_fraction > 0.0f ? box_diagonal(melted->box)
                                                        : 2.0f * g->radius; /* before melting */
    const float width = fmaxf(diagonal, 1e-6f);
    g->bump_strength = params->strength * melted_hollow_factor(melted);
    g->bump_scale = params->mapping == BUMP_UV ? params->scale : params->scale / width;
}

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    const struct bump_params *params = settings_of(config->settings, &bump_settings);
    values[CONSTANT_BUMP_UV] = params->mapping == BUMP_UV;
}

const struct technique bump = {
    .name = "bump",
    .help = "bumps of the ice's surface",
    .settings = &bump_settings,
    .is_on = is_on,
    .is_traced = true,
    .is_ice_only = true,
    .title = "bumps",
    .imports = imports,
    .write_globals = write_globals,
    .write_constants = write_constants,
};
