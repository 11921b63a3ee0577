/*
 * env_cube.c: cube map of the environment around the ice.
 *
 * Seipel and Nivfors 2006, section 3.2: the scene without the ice, rendered six times with a field
 * of view of 90 degrees from the centre of the object, 512 x 512 texels a face. Alpha is 1 /
 * distance from the centre, or 0 for the sky; refraction models use it to intersect rays with near
 * surroundings. Faces have Vulkan's order and orientation, which is left-handed, so nothing is
 * culled by winding order. The cube map is cached, and redrawn only when it is due
 * (src/render/frame/env_cube_updates.h).
 *
 * Limits: with refract.lookup=infinite, near surroundings appear as seen from the object's centre,
 * not from the point where the ray leaves. Surroundings that are occluded from the centre are
 * missing in any case.
 */
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/lighting/ice_caustics.h"
#include "src/tech/surroundings/surroundings.h"

static rg_record_fn record_surroundings, record_sky;
static rg_when_fn is_due;

static bool is_due(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame->due.cube;
}

static void push_face(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->faces[rg_cmd_repetition(cmd)], sizeof(struct surroundings_push));
}

static void record_sky(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_face(cmd, frame);
    rg_cmd_draw(cmd, 3);
}

static void record_surroundings(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_face(cmd, frame);
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const struct env_cube_params *params = settings_of(config->settings, &env_cube_settings);
    const bool is_image = config->purpose == TECHNIQUE_IMAGE;
    const struct surroundings_pass_params pass_params = {
        .name = "env_cube",
        .color = &frame_env_cube,
        .depth = &frame_env_cube_depth,
        .caustics = is_image && ice_caustics.is_on(config->settings),
        .scene = config->scene,
        .repeat = RG_PER_LAYER,
        .record_surroundings = record_surroundings,
        .record_sky = record_sky,
        .when = is_due,
    };
    if (is_image && (!params->dynamic || config->scene->background.cube.texels))
        return (struct rg_technique){ 0 };
    return surroundings_make(builder, &pass_params);
}

static struct technique_texels find_cube(const struct scene *scene)
{
    return (struct technique_texels){
        .texels = scene->background.cube.texels,
        .width = scene->background.cube.width,
        .height = scene->background.cube.width,
        .layers = 6,
        .no_mips = true,
    };
}

static const struct technique_import imports[] = {
    { &frame_env_cube, find_cube, NULL },
    { 0 },
};

const struct technique env_cube = {
    .name = "env_cube",
    .help = "cube map of the scene without the ice, from the ice's centre",
    .pass_groups = { { PHASE_ENVIRONMENT,
                       .purposes = 1u << TECHNIQUE_IMAGE | 1u << TECHNIQUE_CAPTURE,
                       .make_passes = make_passes } },
    .imports = imports,
};
