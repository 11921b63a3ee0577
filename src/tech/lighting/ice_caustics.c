/*
 * ice_caustics.c: caustics and shadow of the ice in sunlight by photon splatting, and a shadow map
 * of the surroundings.
 *
 * Image-space photon mapping of refractive objects after Wyman and Davis 2006, Interactive
 * Image-Space Techniques for Approximating Caustics, and Shah, Konttinen and Pattanaik 2007,
 * Caustics Mapping. The ice's faces are rasterised from the sun. Each texel of the front faces is a
 * photon, which is traced as in refract_bounce.c to the ground, the depth buffer of the
 * surroundings behind the ice, and splatted into a map. Splatting needs no photon search structure
 * and has a fixed cost. The map is perpendicular to the sunlight, so all texels receive equal light
 * on any slope, and energy is preserved. A photon carries the light transmitted by Fresnel's
 * equations at its entry and exit, less absorption. Two branches are followed beside it: the light
 * that the front face reflects, and the light that its exit reflects, up to the next exit.
 *
 * Limits: light is lost that is partially reflected inside twice or leaves the map. Ground that the
 * sun cannot see behind the ice gets no caustics. Rays end at the first surface in the sun's view,
 * even where they would pass behind it or through a cut-out. The map is blurred by the 3 x 3 texel
 * filter. Cracks, air, bubbles and frost transmit all light.
 *
 * The shadow map is the depth of all surroundings from the sun. Look-ups are offset along the
 * surface normal against shadow acne (Holbert 2011, "Saying Goodbye to Shadow Acne"). It extends to
 * ICE_CAUSTICS_SHADOW_MAP_REACH radii of the ice; shadow edges are one texel soft.
 */
#include "src/tech/lighting/ice_caustics.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/embedded.h"
#include "shaders/globals.h"
#include "shaders/refract/refract.h"
#include "shaders/specialization_constants.h"
#include "shaders/surroundings/surroundings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/lighting/bump.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract_bounce.h"
#include "src/tech/water/caustics.h"

static rg_record_fn record_ground, record_shade, record_photons, record_clear, record_splat;
static rg_record_fn record_layers;

/* Declares an image in the sun's view. If `is_kept`, its content persists for later frames. */
#define SUN_VIEW_IMAGE(title, texel, is_kept) \
    { \
        .name = (title), .format = (texel), .width = ICE_CAUSTICS_PHOTONS, \
        .height = ICE_CAUSTICS_PHOTONS, .persistent = (is_kept) \
    }
#define MAP(title, texel) \
    { \
        .name = (title), .format = (texel), .width = ICE_CAUSTICS_SIZE, \
        .height = ICE_CAUSTICS_SIZE, .persistent = true \
    }

const struct rg_buffer ice_caustics_globals = {
    .name = "ice_caustics.globals",
    .size = sizeof(struct globals),
    .memory = RG_MEMORY_UPLOAD,
};

const struct rg_buffer ice_caustics_light = {
    .name = "ice_caustics.light",
    .size = sizeof(struct ice_caustics_light),
    .memory = RG_MEMORY_UPLOAD,
};

static const struct rg_image back =
    SUN_VIEW_IMAGE("ice_caustics.back", VK_FORMAT_R16G16B16A16_SFLOAT, false);
static const struct rg_image back_depth =
    SUN_VIEW_IMAGE("ice_caustics.back_depth", VK_FORMAT_D32_SFLOAT, false);
static const struct rg_image front =
    SUN_VIEW_IMAGE("ice_caustics.front", VK_FORMAT_R16G16B16A16_SFLOAT, false);
const struct rg_image ice_caustics_front_depth =
    SUN_VIEW_IMAGE("ice_caustics.front_depth", VK_FORMAT_D32_SFLOAT, true);
static const struct rg_image photons_depth =
    SUN_VIEW_IMAGE("ice_caustics.photons_depth", VK_FORMAT_D32_SFLOAT, false);
static const struct rg_image landing_red =
    SUN_VIEW_IMAGE("ice_caustics.landed_red", VK_FORMAT_R32G32B32A32_SFLOAT, false);
static const struct rg_image landing_green =
    SUN_VIEW_IMAGE("ice_caustics.landed_green", VK_FORMAT_R32G32B32A32_SFLOAT, false);
static const struct rg_image landing_blue =
    SUN_VIEW_IMAGE("ice_caustics.landed_blue", VK_FORMAT_R32G32B32A32_SFLOAT, false);
static const struct rg_image landing_reflected =
    SUN_VIEW_IMAGE("ice_caustics.landed_reflected", VK_FORMAT_R32G32B32A32_SFLOAT, false);
static const struct rg_image landing_later =
    SUN_VIEW_IMAGE("ice_caustics.landed_later", VK_FORMAT_R32G32B32A32_SFLOAT, false);

const struct rg_image ice_caustics_ground = MAP("ice_caustics.ground", VK_FORMAT_D32_SFLOAT);
const struct rg_image ice_caustics_shadow_map = {
    .name = "ice_caustics.shadow_map",
    .format = VK_FORMAT_D32_SFLOAT,
    .width = ICE_CAUSTICS_SHADOW_MAP_SIZE,
    .height = ICE_CAUSTICS_SHADOW_MAP_SIZE,
    .persistent = true,
};
const struct rg_image ice_caustics_map = MAP("ice_caustics.map", VK_FORMAT_R16G16B16A16_SFLOAT);

static const struct rg_image counts = {
    .name = "ice_caustics.counts",
    .format = VK_FORMAT_R32_UINT,
    .width = 3 * ICE_CAUSTICS_SIZE,
    .height = ICE_CAUSTICS_SIZE,
};

#define USE_GLOBALS \
    { \
        .buffer = &ice_caustics_globals, .access = RG_UNIFORM, .binding = GLOBALS_BINDING \
    }
#define USE_LIGHT \
    { \
        .buffer = &ice_caustics_light, .access = RG_UNIFORM, .binding = ICE_CAUSTICS_LIGHT \
    }

const struct rg_use ice_caustics_uses[] = {
    USE_LIGHT,
    FRAME_SAMPLE(ice_caustics_map, ICE_CAUSTICS_MAP, .sampler = &frame_linear),
    FRAME_READ(ice_caustics_ground, ICE_CAUSTICS_GROUND),
    FRAME_READ(ice_caustics_front_depth, ICE_CAUSTICS_FRONT),
    FRAME_READ(ice_caustics_shadow_map, ICE_CAUSTICS_SHADOW_MAP),
    { 0 },
};

static const struct rg_use face_uses[] = { USE_GLOBALS, { 0 } };

static const struct rg_use photon_uses[] = {
    USE_GLOBALS,
    USE_LIGHT,
    FRAME_SAMPLE(back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_caustics_front_depth, REFRACT_DEPTH_FRONT),
    FRAME_READ(ice_caustics_ground, ICE_CAUSTICS_GROUND),
    { 0 },
};

/* Resources added to the photon pass of the refraction model `trace`. */
static const struct rg_use traced_uses[] = {
    USE_LIGHT,
    FRAME_READ(ice_caustics_ground, ICE_CAUSTICS_GROUND),
    { 0 },
};

static const struct rg_use bump_uses[] = { BUMP_USE_MAP, { 0 } };

enum {
    PHOTONS_PASS = 4 /* index in `passes` */
};

static bool is_due(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame->due.light;
}

static const struct rg_pass passes[] = {
    /* Faces of the ice from the sun's view, drawn as in ice_gbuffer.c. */
    {
        .name = "ice_caustics.back",
        .color = RG_TARGETS({ &back, RG_LOAD_CLEAR }),
        .depth = { &back_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = face_uses,
        .vert = &ice_normal_vert,
        .frag = &ice_normal_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_FRONT_BIT,
        .record = frame_draw_object,
        .when = is_due,
    },
    {
        .name = "ice_caustics.front",
        .color = RG_TARGETS({ &front, RG_LOAD_CLEAR }),
        .depth = { &ice_caustics_front_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = face_uses,
        .vert = &ice_normal_vert,
        .frag = &ice_normal_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .record = frame_draw_object,
        .when = is_due,
    },
    {
        .name = "ice_caustics.ground",
        .depth = { &ice_caustics_ground, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(FRAME_USE_GLOBALS, USE_LIGHT,
                        FRAME_READ(ice_caustics_front_depth, ICE_CAUSTICS_FRONT)),
        .vert = &ice_caustics_ground_depth_vert,
        .frag = &ice_caustics_ground_depth_frag,
        .vertices = &frame_mesh_layout,
        .record = record_ground,
        .when = is_due,
    },
    {
        .name = "ice_caustics.shadow_map",
        .depth = { &ice_caustics_shadow_map, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(
            FRAME_USE_GLOBALS, USE_LIGHT,
            FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &frame_texture_sampler),
            FRAME_SAMPLE(frame_materials, SURROUNDINGS_MATERIALS, .sampler = NULL)),
        .vert = &sun_shadow_map_vert,
        .frag = &sun_shadow_map_frag,
        .vertices = &frame_mesh_layout,
        .record = record_shade,
        .when = is_due,
    },
    {
        .name = "ice_caustics.photons",
        .color = RG_TARGETS({ &landing_red, RG_LOAD_CLEAR }, { &landing_green, RG_LOAD_CLEAR },
                            { &landing_blue, RG_LOAD_CLEAR }, { &landing_reflected, RG_LOAD_CLEAR },
                            { &landing_later, RG_LOAD_CLEAR }),
        .uses = photon_uses,
        .vert = &ice_caustics_photons_vert,
        .frag = &ice_caustics_photons_frag,
        .push_size = sizeof(struct ice_caustics_push),
        .record = record_photons,
        .when = is_due,
    },
    {
        .name = "ice_caustics.clear",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            { .image = &counts, .access = RG_STORAGE_WRITE, .binding = ICE_CAUSTICS_COUNTS }),
        .comp = &ice_caustics_clear_comp,
        .record = record_clear,
        .when = is_due,
    },
    {
        .name = "ice_caustics.splat",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            FRAME_READ(landing_red, ICE_CAUSTICS_LANDED),
            FRAME_READ(landing_green, ICE_CAUSTICS_LANDED + 1),
            FRAME_READ(landing_blue, ICE_CAUSTICS_LANDED + 2),
            FRAME_READ(landing_reflected, ICE_CAUSTICS_REFLECTED),
            FRAME_READ(landing_later, ICE_CAUSTICS_LATER),
            { .image = &counts, .access = RG_STORAGE_READ_WRITE, .binding = ICE_CAUSTICS_COUNTS }),
        .comp = &ice_caustics_splat_comp,
        .record = record_splat,
        .when = is_due,
    },
    {
        .name = "ice_caustics.map",
        .color = RG_TARGETS({ &ice_caustics_map, RG_LOAD_DISCARD }),
        .uses = RG_USES(USE_LIGHT, FRAME_READ(counts, ICE_CAUSTICS_COUNTS),
                        FRAME_SAMPLE(front, ICE_CAUSTICS_NORMAL, .sampler = &frame_linear)),
        .vert = &fullscreen_vert,
        .frag = &ice_caustics_map_frag,
        .record = frame_draw_screen,
        .when = is_due,
    },
};

static const struct rg_use globals_use[] = { FRAME_USE_GLOBALS, { 0 } };

static const struct rg_pass layer_pass = {
    .name = "ice_caustics.layers",
    .color = RG_TARGETS({ &caustics_layer, RG_LOAD_CLEAR }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_read_only = true,
    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
    .vert = &surroundings_vert,
    .frag = &ice_caustics_aov_frag,
    .vertices = &frame_mesh_layout,
    .push_size = sizeof(struct surroundings_push),
    .record = record_layers,
};

static void record_ground(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static void record_shade(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct ice_caustics_params *params = settings_of(frame->settings, &ice_caustics_settings);
    if (params->ground)
        rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static void push_photons(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct refract_bounce_params *bounce =
        settings_of(frame->settings, &refract_bounce_settings);
    const struct caustics_params *pool = settings_of(frame->settings, &caustics_settings);
    const struct ice_caustics_push push = {
        .march = bounce->march,
        .sun_x = frame->light_jitter.x,
        .sun_y = frame->light_jitter.y,
        .sun = pool->sun,
    };
    rg_cmd_push(cmd, &push, sizeof(push));
}

static void record_photons(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_photons(cmd, frame);
    rg_cmd_draw(cmd, 3);
}

static void record_bumps(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_photons(cmd, frame);
    rg_cmd_draw_mesh(cmd, &frame->object);
}

/* Makes the photon pass rasterise the front faces, with bump-mapped normals. */
static void draw_bumps(struct rg_pass *pass)
{
    pass->depth = (struct rg_target){ &photons_depth, RG_LOAD_CLEAR };
    pass->depth_compare = VK_COMPARE_OP_GREATER;
    pass->vert = &refract_bump_vert;
    pass->frag = &ice_caustics_photons_bump_frag;
    pass->vertices = &frame_mesh_layout;
    pass->cull = VK_CULL_MODE_BACK_BIT;
    pass->record = record_bumps;
}

static void record_clear(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const uint32_t groups = ICE_CAUSTICS_SIZE / ICE_CAUSTICS_GROUP;
    (void)frame;
    rg_cmd_dispatch(cmd, 3 * groups, groups, 1);
}

static void record_splat(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const uint32_t groups = ICE_CAUSTICS_PHOTONS / ICE_CAUSTICS_GROUP;
    (void)frame;
    rg_cmd_dispatch(cmd, groups, groups, 1);
}

static void record_layers(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->view, sizeof(frame->view));
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static const char *const lights[] = {
    [ICE_CAUSTICS_NONE] = "none",
    [ICE_CAUSTICS_SUN] = "sun",
    NULL,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("ice_caustics.light", CHOICE, struct ice_caustics_params, light),
        .label = "Caustics and shadows",
        .max = ICE_CAUSTICS_SUN,
        .choices = lights,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "light source of the ice's caustics and shadow; none turns both off (scene files "
                "lit by the sun select sun)",
    },
    {
        SETTING_FIELD("ice_caustics.radius", FLOAT, struct ice_caustics_params, reach),
        .renamed_from = "ice_caustics.reach",
        .label = "Caustics radius",
        .initial = 3,
        .min = 1,
        .max = 100,
        .unit = "radii",
        .help = "half width of the caustic map around the shadow's centre; larger maps are coarser",
    },
    {
        SETTING_FIELD("ice_caustics.shadow", SWITCH, struct ice_caustics_params, shadow),
        .label = "Shadow of the ice",
        .initial = 1,
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "let the ice block direct sunlight (off: caustics are added to unblocked sunlight)",
    },
    {
        SETTING_FIELD("ice_caustics.surroundings_shadow", SWITCH, struct ice_caustics_params,
                      ground),
        .renamed_from = "ice_caustics.ground",
        .label = "Shadows of the surroundings",
        .initial = 1,
        .max = 1,
        .help = "shadows that surroundings cast on each other in sunlight, up to 6 radii from the "
                "ice; ground.light=traced always draws them",
    },
};

SETTING_GROUP(ice_caustics, rows, struct ice_caustics_params);

static bool is_on(const struct settings *settings)
{
    const struct ice_caustics_params *params = settings_of(settings, &ice_caustics_settings);
    return params->light != ICE_CAUSTICS_NONE;
}

static struct rg_technique make_maps(const struct technique_config *config,
                                     struct pass_arena *builder)
{
    const size_t count = sizeof(passes) / sizeof(passes[0]);
    const struct rg_use *const uses[] = { photon_uses, bump_uses };
    struct rg_pass *made =
        is_on(config->settings) ? pass_arena_copy_passes(builder, passes, count) : NULL;
    if (!made)
        return (struct rg_technique){ 0 };
    const struct refraction_model *refraction =
        config->refraction ? &config->refraction->refraction : NULL;
    const bool is_traced =
        refraction && refraction->trace_photons &&
        refraction->trace_photons(&made[PHOTONS_PASS], config, builder, traced_uses);
    if (!is_traced && bump.is_on(config->settings)) {
        made[PHOTONS_PASS].uses = pass_arena_join_uses(builder, uses, 2);
        draw_bumps(&made[PHOTONS_PASS]);
    }
    return (struct rg_technique){ "ice_caustics", made, count };
}

/* Makes the pass of the AOV layer that shows sunlight on the visible surroundings. */
static struct rg_technique make_layer(const struct technique_config *config,
                                      struct pass_arena *builder)
{
    const struct rg_use *const uses[] = { globals_use, ice_caustics_uses };
    struct rg_pass *pass = pass_arena_copy_passes(builder, &layer_pass, 1);
    if (!pass || !is_on(config->settings))
        return (struct rg_technique){ 0 };
    pass->uses = pass_arena_join_uses(builder, uses, 2);
    return (struct rg_technique){ "ice_caustics", pass, 1 };
}

/* Returns a camera in the sun's direction, so distant that its rays are nearly parallel. */
static struct camera sun_camera(const struct globals *globals)
{
    const float radius = fmaxf(globals->radius, 1e-6f);
    const float distance = ICE_CAUSTICS_DISTANCE * radius;
    return (struct camera){
        .eye = glms_vec3_add(globals->center, glms_vec3_scale(globals->sun_dir, distance)),
        .target = globals->center,
        .fov_deg = 2.0f * atanf(ICE_CAUSTICS_MARGIN / ICE_CAUSTICS_DISTANCE) / 0.01745329252f,
    };
}

void ice_caustics_write_globals(void *memory, const struct frame_view *view,
                                const struct globals *globals)
{
    struct globals *sun = memory;
    const struct camera camera = sun_camera(globals);
    *sun = *globals;
    sun->lod_bias = 0.0f; /* the shadow map is never tiled */
    sun->eye = camera.eye;
    sun->forward = glms_vec3_negate(globals->sun_dir);
    sun->clip_from_world =
        camera_clip_from_world(&camera, ICE_CAUSTICS_PHOTONS, ICE_CAUSTICS_PHOTONS,
                               scene_near_plane(view->scene), view->light_jitter);
}

/* Writes the view of the caustic map: the sun's view of the ice, widened by the factor `reach`. */
void ice_caustics_write_light(void *memory, const struct frame_view *view,
                              const struct globals *globals)
{
    const struct ice_caustics_params *params = settings_of(view->settings, &ice_caustics_settings);
    const struct camera camera = sun_camera(globals);
    const float radius = fmaxf(globals->radius, 1e-6f);
    struct ice_caustics_light *map = memory;
    *map = (struct ice_caustics_light){
        .clip_from_world =
            camera_clip_from_world(&camera, ICE_CAUSTICS_PHOTONS, ICE_CAUSTICS_PHOTONS,
                                   scene_near_plane(view->scene), (vec2s){ { 0.0f, 0.0f } }),
        .reach = params->reach,
        .front = ICE_CAUSTICS_DISTANCE * radius - radius,
        .shadow_bias = 1.5f * 2.0f * ICE_CAUSTICS_MARGIN * ICE_CAUSTICS_SHADOW_MAP_REACH * radius /
                       ICE_CAUSTICS_SHADOW_MAP_SIZE,
    };
    for (int column = 0; column < 4; column++) {
        map->clip_from_world.raw[column][0] /= params->reach;
        map->clip_from_world.raw[column][1] /= params->reach;
    }
}

static bool affects_light(const struct scene *scene)
{
    (void)scene;
    return true;
}

static const struct technique_upload uploads[] = {
    { &ice_caustics_globals, ice_caustics_write_globals },
    { &ice_caustics_light, ice_caustics_write_light },
    { 0 },
};

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    const struct ice_caustics_params *params =
        settings_of(config->settings, &ice_caustics_settings);
    values[CONSTANT_ICE_SHADOW] = params->shadow;
}

const struct technique ice_caustics = {
    .name = "ice_caustics",
    .help = "caustics and shadow of the ice in sunlight, by photon splatting",
    .settings = &ice_caustics_settings,
    .is_on = is_on,
    .is_traced = true,
    .affects_light = affects_light,
    .title = "caustics of the ice",
    .pass_groups = { { PHASE_LIGHT, .make_passes = make_maps },
                     { PHASE_FINISH, .make_passes = make_layer } },
    .uploads = uploads,
    .write_constants = write_constants,
};
