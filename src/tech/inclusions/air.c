/*
 * air.c: milky air enclosed in the ice, drawn as textured planes (impostors).
 *
 * Seipel and Nivfors 2006, section 3.1: randomly oriented polygons in the ice whose transparent
 * textures show bubbles of certain sizes and frequencies, drawn in a pass of their own and
 * composited by alpha blending; section 4 draws 19. They are clipped to the ice like the cracks of
 * section 3.3. The pass has the resolution of the view; the paper's target is 512 x 512.
 *
 * All planes scatter the same light, the mean over all directions. Layers of equal colour blend to
 * colour x (1 - product of (1 - alpha)) in any order, so the planes need no depth sorting.
 *
 * Limits: planes are seen along the unrefracted primary ray. Their light is not absorbed by the
 * ice. Convex objects only, as for ice_depth. A plane seen edge on would be a line, so planes fade
 * out near that angle.
 */
#include "src/tech/inclusions/air.h"
#include "shaders/embedded.h"
#include "shaders/ice/ice_depth.h"
#include "shaders/inclusions/air_planes.h"
#include "shaders/inclusions/medium_density.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_depth.h"

static rg_record_fn record_planes;

/* Imported textures of air planes (struct air_layers). The size is that of the fallback image. */
static const struct rg_image air_layers = FRAME_IMPORTED("frame.air", VK_FORMAT_R8G8_UNORM, true);

const struct rg_image air_media = FRAME_IMPORTED("air.media", VK_FORMAT_R8G8_UNORM, true);

const struct rg_sampler air_media_sampler = { .linear = true };

const struct rg_image air_cover = {
    .name = "air.cover",
    .format = VK_FORMAT_R16_SFLOAT,
};

const struct rg_image air_color = {
    .name = "air.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

static const struct rg_sampler layers_sampler = {
    .linear = true,
    .mips = true,
    .anisotropy = FRAME_ANISOTROPY,
};

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(ice_depth_front, ICE_DEPTH_FRONT, .sampler = &frame_same_texel),
    FRAME_SAMPLE(air_layers, AIR_LAYERS, .sampler = &layers_sampler),
    { 0 },
};

static const struct rg_use layer_uses[] = {
    FRAME_USE_GLOBALS,
    AIR_USE_ENVIRONMENT,
    FRAME_SAMPLE(air_cover, COMPOSITE_AIR, .sampler = &frame_same_texel),
    { 0 },
};

static const struct rg_pass passes[] = {
    {
        .name = "air.planes",
        .color = RG_TARGETS({ &air_cover, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
        ICE_DEPTH_BEFORE_BACK,
        .uses = uses,
        .vert = &air_planes_vert,
        .frag = &air_planes_frag,
        .vertices = &frame_mesh_layout,
        .push_size = sizeof(struct air_push),
        .record = record_planes,
    },
    {
        .name = "air.layer",
        .color = RG_TARGETS({ &air_color, RG_LOAD_DISCARD }),
        .uses = layer_uses,
        .vert = &composite_vert,
        .frag = &milky_air_aov_frag,
        .record = frame_draw_screen,
    },
};

static void record_planes(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct air_params *params = settings_of(frame->settings, &air_settings);
    const struct air_push push = { params->strength, params->haze };
    rg_cmd_push(cmd, &push, sizeof(push));
    frame_draw_mesh(cmd, frame, &air);
}

static const char *const models[] = {
    [AIR_PLANES] = "planes",
    [AIR_MEDIUM] = "medium",
    [AIR_EVEN] = "even",
    NULL,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("air.count", COUNT, struct air_params, count),
        .label = "Planes of fine bubbles",
        .initial = 19,
        .max = 64,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "number of textured planes of air bubbles in the ice (0 for none)",
    },
    {
        SETTING_FIELD("air.seed", COUNT, struct air_params, seed),
        .label = "Random seed of the planes",
        .initial = 1,
        .max = 999999,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "random seed of the bubble planes and their textures",
    },
    {
        SETTING_FIELD("air.size", FLOAT, struct air_params, size),
        .label = "Fine bubble size",
        .initial = 0.01,
        .min = 0.002,
        .max = 0.1,
        .affects = SETTING_AFFECTS_SCENE,
        .help =
            "diameter of the largest bubbles on bubble planes, relative to the object's diagonal",
    },
    {
        SETTING_FIELD("air.frequency", FLOAT, struct air_params, frequency),
        .label = "Fine bubble frequency",
        .initial = 24,
        .min = 1,
        .max = 128,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "bubbles of the largest size that fit side by side on a bubble plane, along the "
                "object's diagonal",
    },
    {
        SETTING_FIELD("air.strength", FLOAT, struct air_params, strength),
        .label = "Density",
        .initial = 0.35,
        .max = 1,
        .help = "opacity of the bubbles on a bubble plane",
    },
    {
        SETTING_FIELD("air.haze", FLOAT, struct air_params, haze),
        .label = "Haze",
        .initial = 0.04,
        .max = 1,
        .help = "maximum opacity of the haze on a bubble plane",
    },
    {
        SETTING_FIELD("air.model", CHOICE, struct air_params, model),
        .label = "Model of the air",
        .max = AIR_EVEN,
        .choices = models,
        .affects = SETTING_AFFECTS_SCENE,
        .help =
            "model of enclosed air: textured planes, a scattering medium that is densest in the "
            "core, or one of even density such as milk (media: refraction models bounce, "
            "one-sided, trace and reference)",
    },
    {
        SETTING_FIELD("air.density", FLOAT, struct air_params, density),
        .label = "Optical depth of the air",
        .initial = 4,
        .max = 1000,
        .help = "optical depth across the object's width at the maximum density, with "
                "air.model=medium or even",
    },
    {
        SETTING_FIELD("air.media", FLOAT, struct air_params, scattering_media),
        .renamed_from = "air.clouds",
        .label = "Density of scattering media",
        .initial = 1,
        .max = 100,
        .help = "factor on the density of files' scattering media, extras.cloud (0 for none)",
    },
    {
        SETTING_FIELD("air.anisotropy", FLOAT, struct air_params, anisotropy),
        .label = "Scattering anisotropy (g)",
        .initial = 0.71,
        .min = -0.95,
        .max = 0.95,
        .help = "Henyey-Greenstein g of scattering media, the mean cosine of the scattering angle",
    },
    {
        SETTING_FIELD("air.steps", COUNT, struct air_params, steps),
        .label = "Scattering steps",
        .initial = 6,
        .max = 64,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "ray march steps per path segment in scattering media, for refraction models "
                "bounce and one-sided (0: clear ice)",
    },
};

SETTING_GROUP(air, rows, struct air_params);

static bool is_on(const struct settings *settings)
{
    const struct air_params *params = settings_of(settings, &air_settings);
    return params->count > 0;
}

bool air_is_medium(const struct settings *settings)
{
    const struct air_params *params = settings_of(settings, &air_settings);
    return is_on(settings) && params->model != AIR_PLANES;
}

static const struct mesh *find_planes(const struct scene *scene)
{
    return &scene->inclusions.air;
}

static struct technique_texels find_layers(const struct scene *scene)
{
    const struct air_layers *found = &scene->inclusions.air_layers;
    return (struct technique_texels){
        .texels = found->texels,
        .width = found->size,
        .height = found->size,
        .layers = found->count,
        .all_mips = true,
    };
}

static const uint8_t clear[2] = { 0 };

static struct technique_texels find_density_fields(const struct scene *scene)
{
    const struct scattering_media *found = &scene->inclusions.media;
    if (!found->count)
        return (struct technique_texels){ 0 };
    return (struct technique_texels){
        .texels = found->texels,
        .width = MEDIUM_SIZE,
        .height = MEDIUM_SIZE,
        .layers = MEDIUM_SIZE * found->count,
        .no_mips = true,
    };
}

static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct air_params *params = settings_of(view->settings, &air_settings);
    g->medium_g = params->anisotropy;
    g->medium_steps = params->steps;
}

static const struct technique_import imports[] = {
    { &air_layers, find_layers, clear },
    { &air_media, find_density_fields, clear },
    { 0 },
};

static const struct frame_layer layers[] = {
    {
        .name = "air",
        .image = &air_color,
        .planes = { "air.R", "air.G", "air.B", "air.A" },
        .mean = true,
        .help = "radiance of the textured planes of air bubbles in the ice, premultiplied",
    },
    { 0 },
};

const struct technique air = {
    .name = "air",
    .help = "textured planes of air bubbles in the ice (Seipel and Nivfors 2006)",
    .settings = &air_settings,
    .is_on = is_on,
    .is_traced = true,
    .is_ice_only = true,
    .layers = layers,
    .imports = imports,
    .write_globals = write_globals,
    .mesh = find_planes,
    .pass_groups = { { PHASE_INCLUSIONS, .graph = RG_TECHNIQUE("air", passes) } },
};
