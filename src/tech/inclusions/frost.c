/*
 * frost.c: frost on the ice's surface: white crystals that blur what is behind them.
 *
 * Seipel and Nivfors 2006, section 3.1: in the cold the surface is covered with thousands of
 * microscopic crystals and reflects diffusely; the paper does not draw them. Here frost grows where
 * the bump mask marks a rough surface, and is blended over the shaded pixel. Thin frost transmits
 * light and scatters it by its slopes, which are GGX-distributed (Walter et al. 2007); thick frost
 * is a white diffuse surface.
 *
 * A slope of angle d tilts refracted light by (n - 1) d, and would tilt a reflection by 2 d, so the
 * lobe is (n - 1) / 2 times as wide, 0.155 for ice. That holds for small angles, perpendicular
 * incidence and one rough side. The environment is prefiltered with this lobe into a small cube
 * map, which is sampled in the direction found by the refraction model. So the lobe is isotropic,
 * and light is scattered at the exit instead of the entry. Air and cracks behind the frost are
 * covered, not blurred, and there is no rough reflection. White frost is lit by the sky and the
 * unshadowed sun, or by a panorama or colour sampled from the same cube map along the normal.
 */
#include "src/tech/inclusions/frost.h"
#include "shaders/embedded.h"
#include "shaders/inclusions/frost.h"
#include "src/tech/frame_resources.h"
#include "src/tech/lighting/bump.h"
#include "src/tech/refract/refract.h"

static rg_record_fn record_cube, record_object;

static const struct rg_image frost_blurred = {
    .name = "frost.blurred",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .width = FROST_CUBE_SIZE,
    .height = FROST_CUBE_SIZE,
    .cube = true,
};

static const struct rg_pass passes[] = {
    {
        .name = "frost.cube",
        .repeat = RG_PER_LAYER,
        .color = RG_TARGETS({ &frost_blurred, RG_LOAD_DISCARD }),
        .uses = RG_USES(FRAME_USE_GLOBALS,
                        FRAME_SAMPLE(frame_env_cube, FROST_ENV_CUBE, .sampler = &frame_linear)),
        .vert = &fullscreen_vert,
        .frag = &frost_env_cube_prefilter_frag,
        .push_size = sizeof(struct frost_cube_push),
        .record = record_cube,
    },
    {
        .name = "frost.over",
        .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }),
        .depth = { &frame_depth, RG_LOAD_KEEP },
        .depth_read_only = true,
        .depth_compare = VK_COMPARE_OP_EQUAL, /* only visible front faces */
        .uses = RG_USES(FRAME_USE_GLOBALS, BUMP_USE_MAP,
                        FRAME_SAMPLE(frost_blurred, FROST_CUBE, .sampler = &frame_linear),
                        FRAME_SAMPLE(refract_exit, FROST_EXIT, .sampler = &frame_same_texel)),
        .vert = &refract_bump_vert,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .frag = &frost_frag,
        .push_size = sizeof(struct frost_push),
        .record = record_object,
    },
};

static void record_cube(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct frost_params *params = settings_of(frame->settings, &frost_settings);
    const struct surroundings_push *face = &frame->faces[rg_cmd_repetition(cmd)];
    const struct frost_cube_push push = {
        .right = face->right,
        .spread = params->roughness * params->roughness,
        .up = face->up,
        .forward = face->forward,
    };
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
}

static void record_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct frost_params *params = settings_of(frame->settings, &frost_settings);
    const struct frost_push push = { params->amount * melted_frost_factor(&frame->scene->melted) };
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw_mesh(cmd, &frame->object);
}

static const struct setting rows[] = {
    {
        SETTING_FIELD("frost.amount", FLOAT, struct frost_params, amount),
        .label = "Frost",
        .max = 1,
        .switches = SETTING_AFFECTS_SCENE,
        .help = "thickness of the frost where the ice is not smooth (0 for none)",
    },
    {
        SETTING_FIELD("frost.roughness", FLOAT, struct frost_params, roughness),
        .label = "Frost roughness",
        .initial = 0.6,
        .max = 1,
        .help = "roughness of the frost, which blurs the view through it",
    },
};

SETTING_GROUP(frost, rows, struct frost_params);

static bool is_on(const struct settings *settings)
{
    const struct frost_params *params = settings_of(settings, &frost_settings);
    return params->amount > 0.0f;
}

const struct technique frost = {
    .name = "frost",
    .help = "frost on the ice's surface",
    .settings = &frost_settings,
    .is_on = is_on,
    .reads_layer = &refract_exit,
    .is_traced = true,
    .is_ice_only = true,
    .pass_groups = { { PHASE_FINISH, .graph = RG_TECHNIQUE("frost", passes) } },
};
