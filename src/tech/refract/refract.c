/* refract.c: passes, layers and settings shared by all raster refraction models. */
#include "src/tech/refract/refract.h"
#include "shaders/embedded.h"
#include "shaders/specialization_constants.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/medium_density_fields.h"
#include "src/tech/lighting/bump.h"
#include "src/tech/lighting/highlight.h"
#include "src/tech/output/gbuffer.h"
#include "src/tech/pass_arena.h"

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

const struct rg_image refract_media = {
    .name = "refract.media",
    .format = VK_FORMAT_R32_SFLOAT,
};

const struct rg_image refract_last_object = {
    .name = "refract.last",
    .format = VK_FORMAT_R32_SFLOAT,
};

const struct rg_image refract_path = {
    .name = "refract.path",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

#define PACKED(title) \
    { \
        .name = (title), .format = VK_FORMAT_R32G32B32A32_UINT \
    }
const struct rg_image refract_packed_path = PACKED("refract.packed_path");
const struct rg_image refract_packed_light = PACKED("refract.packed_light");
const struct rg_image refract_packed_counts = PACKED("refract.packed_counts");

static const struct rg_target color_targets[] = { REFRACT_COLOR_TARGETS };

static const struct rg_target packed_targets[] = {
    REFRACT_COLOR_TARGETS,
    REFRACT_PACKED_TARGETS(REFRACT_OUT_PACKED),
};

static const struct rg_target layer_targets[] = { REFRACT_LAYER_TARGETS };

static const struct rg_use face_uses[] = { FRAME_USE_GLOBALS, { 0 } };

static const struct rg_use pixel_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT),
    FRAME_SAMPLE(ice_normal_shading, REFRACT_SHADING, .sampler = &frame_same_texel),
    { 0 },
};

#define UNPACK_USES \
    FRAME_SAMPLE(refract_packed_path, REFRACT_PACKED_PATH, .sampler = &frame_same_texel), \
        FRAME_SAMPLE(frame_depth, REFRACT_DEPTH_SCENE, .sampler = &frame_same_texel)

static const struct rg_use bump_uses[] = { BUMP_USE_MAP, { 0 } };

/* Passes that shade the object. color_pass and layer_pass draw its front faces with a depth test.
 * pixel_color_pass draws a full-screen triangle and reads ice_normal.front. */
static const struct rg_pass color_pass = {
    .color = color_targets,
    .color_count = sizeof(color_targets) / sizeof(color_targets[0]),
    .depth = { &frame_depth, RG_LOAD_CLEAR }, /* cleared to 0: infinity */
    .depth_compare = VK_COMPARE_OP_GREATER,
};

static const struct rg_pass pixel_color_pass = {
    .color = color_targets,
    .color_count = sizeof(color_targets) / sizeof(color_targets[0]),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_read_only = true,
    .depth_compare = VK_COMPARE_OP_LESS,
};

static const struct rg_pass layer_pass = {
    .color = layer_targets,
    .color_count = sizeof(layer_targets) / sizeof(layer_targets[0]),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_read_only = true,
    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
};

/* Unpack groups of layers; the last pass is for ray-traced models. */
static const struct rg_pass unpack_passes[] = {
    {
        .name = "refract.unpack_exit",
        .color = RG_TARGETS({ &refract_exit, RG_LOAD_DISCARD }),
        .uses = RG_USES(UNPACK_USES),
        .vert = &fullscreen_vert,
        .frag = &refract_unpack_layers_frag,
        .record = frame_draw_screen,
    },
    {
        .name = "refract.unpack_light",
        .color = RG_TARGETS({ &refract_refraction, RG_LOAD_DISCARD },
                            { &refract_reflection, RG_LOAD_DISCARD },
                            { &refract_fresnel, RG_LOAD_DISCARD }),
        .uses = RG_USES(UNPACK_USES, FRAME_SAMPLE(refract_packed_light, REFRACT_PACKED_MORE,
                                                  .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &refract_unpack_light_frag,
        .record = frame_draw_screen,
    },
    {
        .name = "refract.unpack_counts",
        .color = RG_TARGETS({ &refract_path, RG_LOAD_DISCARD }),
        .uses = RG_USES(UNPACK_USES, FRAME_SAMPLE(refract_packed_counts, REFRACT_PACKED_MORE,
                                                  .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &refract_unpack_counts_frag,
        .record = frame_draw_screen,
    },
    {
        .name = "refract.unpack_traced",
        .color = RG_TARGETS({ &refract_media, RG_LOAD_DISCARD },
                            { &refract_last_object, RG_LOAD_DISCARD }),
        .uses = RG_USES(
            UNPACK_USES,
            FRAME_SAMPLE(refract_packed_counts, REFRACT_PACKED_MORE, .sampler = &frame_same_texel),
            FRAME_SAMPLE(gbuffer_object, REFRACT_FIRST_OBJECT, .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &refract_unpack_traced_frag,
        .record = frame_draw_screen,
    },
};

const struct rg_use refract_material_uses[] = {
    FRAME_SAMPLE(ice_normal_front_material, REFRACT_MATERIAL_FRONT, .sampler = &frame_linear),
    FRAME_SAMPLE(ice_normal_back_material, REFRACT_MATERIAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_front_base, REFRACT_MATERIAL_BASE),
    { 0 },
};

const struct rg_use refract_medium_uses[] = {
    AIR_USE_MEDIA,
    FRAME_SAMPLE(frame_surface_light, MEDIUM_AROUND, .sampler = &frame_environment_sampler),
    { 0 },
};

static bool has_bumps(const struct technique_config *config)
{
    return config->refraction->refraction.shaders->bump_frag && bump.is_on(config->settings);
}

bool refract_has_medium(const struct technique_config *config)
{
    const struct technique *refraction = config->refraction;
    const struct air_params *air_of = settings_of(config->settings, &air_settings);
    return refraction && refraction->refraction.shaders &&
           refraction->refraction.shaders->medium_shaders && air_of->steps > 0 &&
           medium_field_exists(config->scene, config->settings);
}

const struct refract_shaders *refract_shaders_of(const struct technique_config *config)
{
    const struct refract_shaders *refraction = config->refraction->refraction.shaders;
    return refract_has_medium(config) ? refraction->medium_shaders : refraction;
}

/* Makes a pass draw front faces. */
static void draw_faces(struct rg_pass *pass, const struct refract_shaders *refraction, bool bumped)
{
    pass->vert = refraction->vert ? refraction->vert : bumped ? &refract_bump_vert : &refract_vert;
    pass->vertices = &frame_mesh_layout;
    pass->cull = VK_CULL_MODE_BACK_BIT;
}

/* Returns the fragment shader of the image or of the AOV layers. */
static const struct rg_shader *frag_of(const struct technique_config *config, bool bumped,
                                       bool is_layers)
{
    const struct refract_shaders *refraction = refract_shaders_of(config);
    if (config->is_nested)
        return is_layers ? refraction->nested_layers_frag : refraction->nested_frag;
    if (ice_gbuffer_has_materials(config))
        return is_layers ? refraction->material_layers_frag : refraction->material_frag;
    if (bumped)
        return is_layers ? refraction->bump_layers_frag : refraction->bump_frag;
    return is_layers ? refraction->layers_frag : refraction->frag;
}

static struct rg_technique make_pass(const struct technique_config *config,
                                     struct pass_arena *builder, const struct rg_pass *base,
                                     bool is_layers)
{
    const struct technique *technique = config->refraction;
    const struct refract_shaders *refraction = technique->refraction.shaders;
    const bool bumped = has_bumps(config);
    const bool packs =
        !is_layers && technique->refraction.packs_layers && refract_wants_layers(config);
    const struct rg_use *const uses[] = {
        technique->refraction.shades_fullscreen ? pixel_uses : face_uses,
        config->is_nested && config->is_wide ? refraction->nested_wide_uses
        : config->is_nested                  ? refraction->nested_uses
        : config->is_wide                    ? refraction->wide_uses
                                             : refraction->uses,
        bumped ? bump_uses : NULL,
        ice_gbuffer_has_materials(config) ? refract_material_uses : NULL,
        refract_has_medium(config) ? refract_medium_uses : NULL,
    };
    struct rg_pass *pass = pass_arena_copy_passes(builder, base, 1);
    if (!pass)
        return (struct rg_technique){ 0 };
    pass->name = pass_arena_name(builder, technique->name, is_layers ? "layers" : "color");
    pass->uses = pass_arena_join_uses(builder, uses, sizeof(uses) / sizeof(uses[0]));
    if (technique->refraction.shades_fullscreen)
        pass->vert = refraction->vert ? refraction->vert : &refract_fullscreen_vert;
    else
        draw_faces(pass, refraction, bumped);
    pass->frag = frag_of(config, bumped, is_layers || packs);
    if (packs) {
        pass->color = packed_targets;
        pass->color_count = sizeof(packed_targets) / sizeof(packed_targets[0]);
    }
    pass->push_size = refraction->push_size;
    pass->record = refraction->record ? refraction->record : frame_draw_object;
    return (struct rg_technique){ technique->name, pass, 1 };
}

struct rg_technique refract_image_passes(const struct technique_config *config,
                                         struct pass_arena *builder)
{
    const bool shades_fullscreen = config->refraction->refraction.shades_fullscreen;
    return make_pass(config, builder, shades_fullscreen ? &pixel_color_pass : &color_pass, false);
}

struct rg_technique refract_layer_passes(const struct technique_config *config,
                                         struct pass_arena *builder)
{
    return make_pass(config, builder, &layer_pass, true);
}

bool refract_wants_layers(const struct technique_config *config)
{
    bool wants = false;
    for (size_t p = 0; p < sizeof(unpack_passes) / sizeof(unpack_passes[0]); p++) {
        const struct rg_pass *pass = &unpack_passes[p];
        for (uint32_t i = 0; i < pass->color_count; i++)
            wants = wants || technique_wants(config, pass->color[i].image);
    }
    return wants;
}

struct rg_technique refract_unpack_passes(const struct technique_config *config,
                                          struct pass_arena *builder)
{
    const bool traces = config->refraction->refraction.traces_bvh;
    (void)builder;
    if (!refract_wants_layers(config))
        return (struct rg_technique){ 0 };
    const size_t count = sizeof(unpack_passes) / sizeof(unpack_passes[0]);
    return (struct rg_technique){ "refract", unpack_passes, traces ? count : count - 1 };
}

static const char *const fresnels[] = {
    [REFRACT_FRESNEL_PAPER] = "paper",
    [REFRACT_FRESNEL_EXACT] = "exact",
    [REFRACT_FRESNEL_CROSSFADE] = "crossfade",
    [REFRACT_FRESNEL_AUTO] = "auto",
    NULL,
};

static const char *const lookups[] = {
    [REFRACT_LOOKUP_INFINITE] = "infinite",
    [REFRACT_LOOKUP_DISTANCE] = "distance",
    [REFRACT_LOOKUP_BOX] = "box",
    [REFRACT_LOOKUP_AUTO] = "auto",
    NULL,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("refract.ior", FLOAT, struct refract_params, ior),
        .label = "Refractive index",
        .initial = 1.3091,
        .min = 1.0,
        .max = 4.0,
        .help = "refractive index of the object; also set by --material",
    },
    {
        SETTING_FIELD("refract.ior_outside", FLOAT, struct refract_params, outside),
        .renamed_from = "refract.outside",
        .label = "Refractive index outside",
        .initial = 1.0003,
        .min = 1.0,
        .max = 4.0,
        .help =
            "refractive index of the medium around the objects, such as 1.333 for water; bubbles "
            "and cracks always contain air; for files with materials, the default 1.0003 selects a "
            "vacuum (1)",
    },
    {
        SETTING_FIELD("refract.dispersion", FLOAT, struct refract_params, dispersion),
        .label = "Dispersion",
        .max = 10,
        .switches = SETTING_AFFECTS_PLAN,
        .help = "dispersion of the object as 20 / Abbe number; ice has 0.376",
    },
    {
        SETTING_FIELD("refract.roughness", FLOAT, struct refract_params, roughness),
        .label = "Roughness",
        .max = 1,
        .switches = SETTING_AFFECTS_PLAN,
        .help = "roughness of the object's surface (0: smooth, or that of the file's material); "
                "--material NAME:rough sets 0.2, NAME:frosted 0.5 (refraction models trace and "
                "reference)",
    },
    {
        SETTING_FIELD("refract.fresnel", CHOICE, struct refract_params, fresnel),
        .label = "Reflectance model",
        .initial = REFRACT_FRESNEL_AUTO,
        .max = REFRACT_FRESNEL_AUTO,
        .choices = fresnels,
        .affects = SETTING_AFFECTS_PLAN,
        .help =
            "reflectance: eq. 4 of Seipel and Nivfors 2006, the exact Fresnel equations, or the "
            "constant refract.crossfade (auto: exact, except for the refraction model paper)",
    },
    {
        SETTING_FIELD("refract.crossfade", FLOAT, struct refract_params, crossfade),
        .label = "Refracted fraction",
        .initial = 0.8,
        .max = 1,
        .help = "transmitted fraction of light with refract.fresnel=crossfade",
    },
    {
        SETTING_FIELD("refract.lookup", CHOICE, struct refract_params, lookup),
        .label = "Environment lookup",
        .initial = REFRACT_LOOKUP_AUTO,
        .max = REFRACT_LOOKUP_AUTO,
        .choices = lookups,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "environment lookup: infinitely far away, ray marched to stored distances, or box "
                "projection (auto: distance, except for refraction model paper: infinite)",
    },
    {
        SETTING_FIELD("refract.steps", COUNT, struct refract_params, steps),
        .label = "Distance search steps",
        .initial = 8,
        .min = 1,
        .max = 64,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "ray marching steps with refract.lookup=distance",
    },
};

SETTING_GROUP(refract, rows, struct refract_params);

float refract_outside(const struct scene *scene, const struct settings *settings)
{
    const struct refract_params *params = settings_of(settings, &refract_settings);
    return scene->has_pool ? REFRACT_IOR_AIR : params->outside;
}

/* Writes relative refractive indices for red, green and blue by KHR_materials_dispersion. */
static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct refract_params *params = settings_of(view->settings, &refract_settings);
    float half = (params->ior - 1.0f) * 0.025f * params->dispersion;
    const float outside = refract_outside(view->scene, view->settings);
    g->eta = outside / params->ior;
    g->etas = (vec3s){ { outside / (params->ior - half), g->eta, outside / (params->ior + half) } };
    g->outside_in_air = outside / REFRACT_IOR_AIR;
    g->refract_crossfade = params->crossfade;
}

static void resolve_auto_row(struct settings *settings, size_t offset, uint32_t automatic,
                             uint32_t value)
{
    const struct setting *row = settings_row(&refract_settings, offset);
    if (settings_get(settings, row) >= automatic)
        settings_set_value(settings, row, value);
}

static void resolve_auto(struct settings *settings, const struct technique *refraction)
{
    const bool is_printed = refraction == &refract_paper;
    resolve_auto_row(settings, offsetof(struct refract_params, fresnel), REFRACT_FRESNEL_AUTO,
                     is_printed ? REFRACT_FRESNEL_PAPER : REFRACT_FRESNEL_EXACT);
    resolve_auto_row(settings, offsetof(struct refract_params, lookup), REFRACT_LOOKUP_AUTO,
                     is_printed ? REFRACT_LOOKUP_INFINITE : REFRACT_LOOKUP_DISTANCE);
}

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    const struct refract_params *params = settings_of(config->settings, &refract_settings);
    values[CONSTANT_REFRACT_FRESNEL] = params->fresnel;
    values[CONSTANT_REFRACT_LOOKUP] = params->lookup;
    values[CONSTANT_REFRACT_STEPS] = params->steps;
}

static const struct frame_layer layers[] = {
    {
        .name = "exit",
        .image = &refract_exit,
        .planes = { "exit.X", "exit.Y", "exit.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "exit direction of the refracted path, used for the environment lookup",
    },
    {
        .name = "refraction",
        .image = &refract_refraction,
        .planes = { "refraction.R", "refraction.G", "refraction.B" },
        .mean = true,
        .help = "refracted radiance",
    },
    {
        .name = "reflection",
        .image = &refract_reflection,
        .planes = { "reflection.R", "reflection.G", "reflection.B" },
        .mean = true,
        .help = "reflected radiance",
    },
    {
        .name = "fresnel",
        .image = &refract_fresnel,
        .planes = { "fresnel.Z" },
        .mean = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "Fresnel reflectance",
    },
    {
        .name = "path",
        .image = &refract_path,
        .planes = { "path.Z" },
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "length of the refracted path inside the object, metres; 0 without ice",
    },
    {
        .name = "bounces",
        .image = &refract_path,
        .planes = { "bounces.Z" },
        .first_channel = 1,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "number of total internal reflections on the refracted path",
    },
    {
        .name = "tir",
        .image = &refract_path,
        .planes = { "tir.Z" },
        .first_channel = 2,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "1 if the first inner surface on the refracted path reflects totally, else 0",
    },
    {
        .name = "media",
        .image = &refract_media,
        .planes = { "media.Z" },
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "number of segments of the refracted path inside objects; 0 without object",
    },
    {
        .name = "object.last",
        .image = &refract_last_object,
        .planes = { "object.last.Z" },
        .needs_bvh = true,
        .integer = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "number of the object that the refracted path hits last (models trace, reference); "
                "0 if there is none",
    },
    { 0 },
};

const struct technique refract = {
    .name = "refract",
    .help = "settings and layers shared by all refraction models",
    .settings = &refract_settings,
    .layers = layers,
    .resolve_auto = resolve_auto,
    .write_globals = write_globals,
    .write_constants = write_constants,
};
