/*
 * bubbles.c: bubbles of air in the ice, each drawn as a rectangle whose fragments trace a ray.
 *
 * Closed forms of geometrical optics: with b the sine of the angle of incidence, light beyond
 * b = 1.0003 / 1.3091 is totally reflected, 41.6 % of the disc; other light leaves turned outward
 * by 2 (theta_t - theta_i). Reflectances are those of Fresnel's equations. Through ellipsoids and
 * capsules rays are followed. Spheres do not overlap and are drawn farthest first, sorted by the
 * centre's squared distance less the squared radius, which is exact for them, and for other shapes
 * where the spheres around them do not overlap.
 *
 * Limits: unless bubbles_are_bent(), bubbles show the environment cube: the ice's surface bends
 * neither the ray from the bubble nor that from the eye, and clouds are left out. Of hollow objects
 * the latter alone is bent. Because the picture behind is already bent, transmitted light counts
 * only by the squared sine of its angle inside (bubble_cover), so that the middle of a bubble shows
 * the picture behind it, where a true bubble shows it smaller.
 * Light that is reflected inside the bubble is treated as transmitted. A bubble around the eye is
 * invisible, and so is what is no sphere if the eye is in the sphere around it. Convex objects
 * only, as for ice_depth.
 */
#include "src/tech/bubbles.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "shaders/bubbles.h"
#include "shaders/embedded.h"
#include "shaders/ice_depth.h"
#include "shaders/refract.h"
#include "src/settings/scene_settings.h"
#include "src/tech/cracks.h"
#include "src/tech/frame.h"
#include "src/tech/ice_depth.h"
#include "src/tech/ice_normal.h"
#include "src/tech/refract.h"
#include "src/tech/refract_bounce.h"
#include "src/tech/row_builder.h"

static rg_record_fn record_bubbles, record_followed;

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
    { .image = &ice_depth_front,
      .access = RG_SAMPLED,
      .binding = ICE_DEPTH_FRONT,
      .same_texel = true },
    { .image = &ice_depth_back,
      .access = RG_SAMPLED,
      .binding = ICE_DEPTH_BACK,
      .same_texel = true },
    {
        .image = &frame_env_cube,
        .access = RG_SAMPLED,
        .binding = BUBBLES_ENV_CUBE,
        .sampler = &frame_linear,
    },
    {
        .buffer = &bubbles_all,
        .access = RG_STORAGE_READ,
        .binding = BUBBLES_DRAWN,
        .stages = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
    },
    { 0 },
};

/* Without other shapes than spheres. */
static const struct rg_pass spheres_row = {
    .name = "bubbles.spheres",
    .color = RG_TARGETS({ &bubbles_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
    .uses = uses,
    .vert = &bubbles_vert,
    .frag = &bubbles_frag,
    .record = record_bubbles,
};

static const struct rg_pass shapes_row = {
    .name = "bubbles.shapes",
    .color = RG_TARGETS({ &bubbles_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
    .uses = uses,
    .vert = &bubbles_shapes_vert,
    .frag = &bubbles_shapes_frag,
    .record = record_bubbles,
};

static const struct rg_fallback no_cracks = { { 0 } };

static const struct rg_use bent_uses[] = {
    FRAME_SAMPLE(cracks_met, BUBBLES_CRACKS, .same_texel = true, .fallback = &no_cracks),
    { 0 },
};

/* The rung's maps, for the light of bubbles. */
static const struct rg_use followed_uses[] = {
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT),
    { 0 },
};

static const struct rg_use followed_wide_uses[] = {
    FRAME_SAMPLE(ice_normal_wide_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_wide_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_wide_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_wide_front_depth, REFRACT_DEPTH_FRONT),
    { 0 },
};

static const struct rg_target bent_targets[] = {
    { &bubbles_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER },
    { &bubbles_depth, RG_LOAD_CLEAR },
};

static void record_bubbles(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (frame->scene->bubbles.count)
        rg_cmd_draw(cmd, 6 * frame->scene->bubbles.count);
}

/* Of bubbles on bent rays: as they are, with their light followed, and that in cloudy ice. */
static const struct rg_shader *const bent_frags[3][2] = {
    { &bubbles_bent_frag, &bubbles_shapes_bent_frag },
    { &bubbles_followed_frag, &bubbles_shapes_followed_frag },
    { &bubbles_followed_cloud_frag, &bubbles_shapes_followed_cloud_frag },
};

static void record_followed(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_bounce_settings),
                sizeof(struct refract_bounce_params));
    record_bubbles(cmd, frame);
}

static const char *const shape_names[] = { "sphere", "prolate", "oblate", "capsule",
                                           "mixed",  "grown",   NULL };

static const struct setting rows[] = {
    {
        .name = "bubbles.count",
        .type = SETTING_COUNT,
        .offset = offsetof(struct bubbles_params, count),
        .initial = 40,
        .max = BUBBLES_COUNT_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "maximum number of bubbles that are placed in the ice (0: none)",
    },
    {
        .name = "bubbles.seed",
        .type = SETTING_COUNT,
        .offset = offsetof(struct bubbles_params, seed),
        .initial = 1,
        .max = 999999,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "random seed of the bubbles' positions and sizes",
    },
    {
        .name = "bubbles.size",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct bubbles_params, size),
        .initial = 0.03,
        .min = 0.001,
        .max = 0.5,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "diameter of the largest bubbles, relative to the object's diagonal",
    },
    {
        .name = "bubbles.shape",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct bubbles_params, shape),
        .initial = GENERATE_BUBBLES_SPHERE,
        .max = GENERATE_BUBBLES_SHAPE_COUNT - 1,
        .choices = shape_names,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "shape of the bubbles: spheres, long or flat ellipsoids, capsules, a mixture, or "
                "grown: worms and eggs, in rows along which ice grows",
    },
    {
        .name = "bubbles.stretch",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct bubbles_params, stretch),
        .initial = 3,
        .min = 1,
        .max = 20,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "ratio of the longest to the shortest diameter of bubbles other than spheres",
    },
};

const struct setting_group bubbles_settings = SETTING_GROUP("bubbles", rows, struct bubbles_params);

static bool is_on(const struct settings *settings)
{
    const struct bubbles_params *params = settings_of(settings, &bubbles_settings);
    return params->count > 0;
}

/* With several objects, the faces' maps have only those of the nearest. */
bool bubbles_are_bent(const struct technique_choice *choice)
{
    const struct target_params *target = settings_of(choice->settings, &target_settings);
    return is_on(choice->settings) && choice->rung && choice->rung->rung.bends_bubbles &&
           choice->rung->rung.bends_bubbles(choice->settings) && choice->object_count <= 1 &&
           target->scale >= 1.0f;
}

static struct rg_technique make_rows(const struct technique_choice *choice,
                                     struct row_builder *builder)
{
    const struct bubbles_params *params = settings_of(choice->settings, &bubbles_settings);
    const bool are_spheres = params->shape == GENERATE_BUBBLES_SPHERE;
    if (!params->count)
        return (struct rg_technique){ 0 };
    const struct rg_pass *row = are_spheres ? &spheres_row : &shapes_row;
    if (!bubbles_are_bent(choice))
        return (struct rg_technique){ "bubbles", row, 1 };
    struct rg_pass *bent = row_builder_rows(builder, row, 1);
    if (!bent)
        return (struct rg_technique){ 0 };
    bent->color = bent_targets;
    bent->color_count = sizeof(bent_targets) / sizeof(bent_targets[0]);
    const bool is_followed = !choice->is_nested, is_cloudy = is_followed && choice->is_cloudy;
    const struct rg_use *const all_uses[] = {
        uses,
        bent_uses,
        !is_followed      ? NULL
        : choice->is_wide ? followed_wide_uses
                          : followed_uses,
        is_cloudy ? refract_cloud_uses : NULL,
    };
    bent->uses = row_builder_uses(builder, all_uses, sizeof(all_uses) / sizeof(all_uses[0]));
    bent->frag = bent_frags[is_followed + is_cloudy][!are_spheres];
    if (is_followed) {
        bent->push_size = sizeof(struct refract_bounce_params);
        bent->record = record_followed;
    }
    return (struct rg_technique){ "bubbles", bent, 1 };
}

/* ---- the bubbles of a frame ---- */

struct far_bubble {
    struct bubbles_drawn drawn;
    float power; /* of the eye: squared length of its tangents to the sphere around the bubble; of
                    an orthographic camera: distance along its axis */
};

static int compare_far(const void *a, const void *b)
{
    const struct far_bubble *x = a;
    const struct far_bubble *y = b;
    return (x->power < y->power) - (x->power > y->power);
}

/* The points of equal power of two spheres that do not overlap form a plane between them, so the
 * one with more power is on the far side. */
void bubbles_write(void *memory, const struct frame_view *view, const struct globals *globals)
{
    const struct bubbles *all = &view->scene->bubbles;
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
    .settings = { &bubbles_settings },
    .is_on = is_on,
    .is_traced = true,
    .is_of_ice = true,
    .is_met = true,
    .layers = layers,
    .uploads = uploads,
    .parts = { { PHASE_INCLUSIONS, .rows = make_rows } },
};
