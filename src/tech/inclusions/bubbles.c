/*
 * bubbles.c: air bubbles in the ice, drawn as billboards whose fragments are ray traced.
 *
 * Geometrical optics in closed form: with b the sine of the angle of incidence, light beyond b =
 * 1.0003 / 1.3091 is totally reflected, 41.6 % of the disc; other light leaves deflected outward by
 * 2 (theta_t - theta_i). Reflectances follow Fresnel's equations. Rays through ellipsoids and
 * capsules are intersected twice. Spheres do not overlap and are drawn back to front, sorted by the
 * squared distance of the centre less the squared radius. This order is exact for spheres, and for
 * other shapes whose bounding spheres do not overlap.
 *
 * Limits: unless bubbles_are_refracted(), bubbles reflect and transmit the environment cube: the
 * ice's surface refracts neither the ray from the bubble nor the primary ray, and scattering media
 * are left out. In hollow objects only the primary ray is refracted. Because the image behind is
 * already refracted, transmitted light is weighted by the squared sine of its angle inside
 * (bubble_opacity): the middle of a bubble shows the image behind it, which a real bubble would
 * show reduced. Light that is internally reflected in a bubble is treated as transmitted. A bubble
 * around the camera is invisible, as is a non-spherical one whose bounding sphere contains the
 * camera. Convex objects only, as for ice_depth.
 */
#include "src/tech/inclusions/bubbles.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "shaders/embedded.h"
#include "shaders/ice/ice_depth.h"
#include "shaders/inclusions/bubbles.h"
#include "shaders/refract/refract.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_depth.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract.h"
#include "src/tech/refract/refract_bounce.h"

static rg_record_fn record_bubbles, record_traced;

const struct rg_image bubbles_color = {
    .name = "bubbles.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image bubbles_depth = {
    .name = "bubbles.depth",
    .format = VK_FORMAT_R32_SFLOAT,
};

const struct rg_buffer bubbles_all = {
    .name = "bubbles.all",
    .size = BUBBLES_COUNT_MAX * sizeof(struct bubbles_drawn),
    .memory = RG_MEMORY_UPLOAD,
};

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(ice_depth_front, ICE_DEPTH_FRONT, .same_texel = true),
    FRAME_SAMPLE(ice_depth_back, ICE_DEPTH_BACK, .same_texel = true),
    FRAME_SAMPLE(frame_env_cube, BUBBLES_ENV_CUBE, .sampler = &frame_linear),
    {
        .buffer = &bubbles_all,
        .access = RG_STORAGE_READ,
        .binding = BUBBLES_DRAWN,
        .stages = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
    },
    { 0 },
};

/* Pass for scenes whose bubbles are all spheres. */
static const struct rg_pass spheres_pass = {
    .name = "bubbles.spheres",
    .color = RG_TARGETS({ &bubbles_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
    .uses = uses,
    .vert = &bubbles_vert,
    .frag = &bubbles_frag,
    .record = record_bubbles,
};

static const struct rg_pass shapes_pass = {
    .name = "bubbles.shapes",
    .color = RG_TARGETS({ &bubbles_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
    .uses = uses,
    .vert = &bubbles_shapes_vert,
    .frag = &bubbles_shapes_frag,
    .record = record_bubbles,
};

static const struct rg_fallback no_cracks = { { 0 } };

static const struct rg_use refracted_uses[] = {
    FRAME_SAMPLE(cracks_hits, BUBBLES_CRACKS, .same_texel = true, .fallback = &no_cracks),
    { 0 },
};

/* Depth and normal maps of the ice, for ray marching from bubbles to the surface. */
static const struct rg_use traced_uses[] = {
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT),
    { 0 },
};

static const struct rg_use traced_wide_uses[] = {
    FRAME_SAMPLE(ice_normal_wide_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_wide_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_wide_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_wide_front_depth, REFRACT_DEPTH_FRONT),
    { 0 },
};

static const struct rg_target refracted_targets[] = {
    { &bubbles_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER },
    { &bubbles_depth, RG_LOAD_CLEAR },
};

static void record_bubbles(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (frame->scene->inclusions.bubbles.count)
        rg_cmd_draw(cmd, 6 * frame->scene->inclusions.bubbles.count);
}

/* Fragment shaders for bubbles that refracted rays hit. First index: path of light to a bubble
 * (straight, traced in ice, traced in a medium). Second index: 1 if any bubble is not a sphere. */
static const struct rg_shader *const refracted_frags[3][2] = {
    { &bubbles_refracted_frag, &bubbles_shapes_refracted_frag },
    { &bubbles_traced_frag, &bubbles_shapes_traced_frag },
    { &bubbles_traced_medium_frag, &bubbles_shapes_traced_medium_frag },
};

static void record_traced(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_bounce_settings),
                sizeof(struct refract_bounce_params));
    record_bubbles(cmd, frame);
}

static const char *const shape_names[] = { "sphere", "prolate", "oblate", "capsule",
                                           "mixed",  "grown",   NULL };

static const struct setting rows[] = {
    {
        SETTING_FIELD("bubbles.count", COUNT, struct bubbles_params, count),
        .label = "Bubbles",
        .initial = 40,
        .max = BUBBLES_COUNT_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "maximum number of bubbles that are placed in the ice (0 for none)",
    },
    {
        SETTING_FIELD("bubbles.seed", COUNT, struct bubbles_params, seed),
        .label = "Random seed of the bubbles",
        .initial = 1,
        .max = 999999,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "random seed of the bubbles' positions and sizes",
    },
    {
        SETTING_FIELD("bubbles.size", FLOAT, struct bubbles_params, size),
        .label = "Bubble size",
        .initial = 0.03,
        .min = 0.001,
        .max = 0.5,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "diameter of the largest bubbles, relative to the object's diagonal",
    },
    {
        SETTING_FIELD("bubbles.shape", CHOICE, struct bubbles_params, shape),
        .label = "Bubble shape",
        .initial = GENERATE_BUBBLES_SPHERE,
        .max = GENERATE_BUBBLES_SHAPE_COUNT - 1,
        .choices = shape_names,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "shape of the bubbles: spheres, long or flat ellipsoids, capsules, a mixture, or "
                "grown: elongated and egg-shaped, in rows along the growth of the ice",
    },
    {
        SETTING_FIELD("bubbles.aspect", FLOAT, struct bubbles_params, stretch),
        .renamed_from = "bubbles.stretch",
        .label = "Bubble length",
        .initial = 3,
        .min = 1,
        .max = 20,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "ratio of the longest to the shortest diameter of bubbles other than spheres",
    },
};

SETTING_GROUP(bubbles, rows, struct bubbles_params);

static bool is_on(const struct settings *settings)
{
    const struct bubbles_params *params = settings_of(settings, &bubbles_settings);
    return params->count > 0;
}

/* Returns true if refracted rays can hit bubbles. With several objects, they cannot, because the
 * depth and normal maps contain only the nearest faces. */
bool bubbles_are_refracted(const struct technique_config *config)
{
    const struct inclusion_target_params *target =
        settings_of(config->settings, &inclusions_settings);
    const struct refract_bounce_params *bounce =
        settings_of(config->settings, &refract_bounce_settings);
    return is_on(config->settings) && config->refraction == &refract_bounce &&
           bounce->inclusions == REFRACT_BOUNCE_INCLUSIONS_ALL && config->object_count <= 1 &&
           target->scale >= 1.0f;
}

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const struct bubbles_params *params = settings_of(config->settings, &bubbles_settings);
    const bool are_spheres = params->shape == GENERATE_BUBBLES_SPHERE;
    if (!params->count)
        return (struct rg_technique){ 0 };
    const struct rg_pass *pass = are_spheres ? &spheres_pass : &shapes_pass;
    if (!bubbles_are_refracted(config))
        return (struct rg_technique){ "bubbles", pass, 1 };
    struct rg_pass *refracted_pass = pass_arena_copy_passes(builder, pass, 1);
    if (!refracted_pass)
        return (struct rg_technique){ 0 };
    refracted_pass->color = refracted_targets;
    refracted_pass->color_count = sizeof(refracted_targets) / sizeof(refracted_targets[0]);
    const bool traces_light = !config->is_nested,
               renders_media = traces_light && refract_has_medium(config);
    const struct rg_use *const all_uses[] = {
        uses,
        refracted_uses,
        !traces_light     ? NULL
        : config->is_wide ? traced_wide_uses
                          : traced_uses,
        renders_media ? refract_medium_uses : NULL,
    };
    refracted_pass->uses =
        pass_arena_join_uses(builder, all_uses, sizeof(all_uses) / sizeof(all_uses[0]));
    refracted_pass->frag = refracted_frags[traces_light + renders_media][!are_spheres];
    if (traces_light) {
        refracted_pass->push_size = sizeof(struct refract_bounce_params);
        refracted_pass->record = record_traced;
    }
    return (struct rg_technique){ "bubbles", refracted_pass, 1 };
}

struct far_bubble {
    struct bubbles_drawn drawn;
    /* Sort key. Perspective camera: squared distance to the bounding sphere's centre minus its
     * squared radius. Orthographic camera: distance of the centre along the camera axis. */
    float power;
};

static int compare_far(const void *a, const void *b)
{
    const struct far_bubble *x = a;
    const struct far_bubble *y = b;
    return (x->power < y->power) - (x->power > y->power);
}

/* Writes the bubbles back to front by decreasing `power`. If two spheres are disjoint, the sphere
 * with the larger power lies behind the plane that separates them (radical plane). */
void bubbles_write(void *memory, const struct frame_view *view, const struct globals *globals)
{
    const struct bubbles *all = &view->scene->inclusions.bubbles;
    struct bubbles_drawn *sorted = memory;
    struct far_bubble order[BUBBLES_COUNT_MAX];
    for (uint32_t i = 0; i < all->count; i++) {
        const struct bubble *bubble = &all->all[i];
        const struct bubbles_drawn drawn = {
            .center = glms_mat4_mulv3(globals->world_from_object, bubble->center, 1.0f),
            .radius = bubble->radius,
            .axis = glms_mat4_mulv3(globals->world_from_object, bubble->axis, 0.0f),
            .stretch = bubble->stretch,
            .is_capsule = bubble->is_capsule,
        };
        const vec3s to = glms_vec3_sub(drawn.center, globals->eye);
        const float reach = drawn.radius + fmaxf(drawn.stretch, 0.0f);
        const float power = view->camera.height > 0.0f ? glms_vec3_dot(to, globals->forward)
                                                       : glms_vec3_norm2(to) - reach * reach;
        order[i] = (struct far_bubble){ drawn, power };
    }
    qsort(order, all->count, sizeof(order[0]), compare_far);
    for (uint32_t i = 0; i < all->count; i++)
        sorted[i] = order[i].drawn;
}

static const struct technique_upload uploads[] = {
    { &bubbles_all, bubbles_write },
    { 0 },
};

static const struct frame_layer layers[] = {
    {
        .name = "bubbles",
        .image = &bubbles_color,
        .planes = { "bubbles.R", "bubbles.G", "bubbles.B", "bubbles.A" },
        .mean = true,
        .help = "radiance of the bubbles in the ice, premultiplied",
    },
    { 0 },
};

const struct technique bubbles = {
    .name = "bubbles",
    .help = "air bubbles in the ice, with total reflection at their rims",
    .settings = &bubbles_settings,
    .is_on = is_on,
    .is_traced = true,
    .is_ice_only = true,
    .is_hit = true,
    .layers = layers,
    .uploads = uploads,
    .pass_groups = { { PHASE_INCLUSIONS, .make_passes = make_passes } },
};
