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
 * If bubbles_are_traced(), the refraction model intersects its rays with the BVH of the bubbles
 * (shaders/refract/refract_bubbles.glsl), and the billboards are just the layer `bubbles`.
 *
 * Limits of billboards: the ice's surface does not refract the rays to and from a bubble, which
 * reflects and transmits the environment cube map. Scattering media are ignored. Because the image
 * behind is already refracted, transmitted light is weighted by the squared sine of its angle
 * inside (bubble_opacity): the middle of a bubble shows the image behind it, which a real bubble
 * would show reduced in size. Light that is internally reflected in a bubble is treated as
 * transmitted. A bubble around the camera is invisible, as is a non-spherical one whose bounding
 * sphere contains the camera. Convex objects only, as for ice_depth.
 */
#include "src/tech/inclusions/bubbles.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "shaders/embedded.h"
#include "shaders/ice/ice_depth.h"
#include "shaders/inclusions/bubbles.h"
#include "shaders/specialization_constants.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_depth.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract.h"
#include "src/tech/refract/refract_bounce.h"

static rg_record_fn record_bubbles;

const struct rg_image bubbles_color = {
    .name = "bubbles.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_buffer bubbles_all = {
    .name = "bubbles.all",
    .size = BUBBLES_COUNT_MAX * sizeof(struct bubbles_drawn),
    .memory = RG_MEMORY_UPLOAD,
};

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(ice_depth_front, ICE_DEPTH_FRONT, .sampler = &frame_same_texel),
    FRAME_SAMPLE(ice_depth_back, ICE_DEPTH_BACK, .sampler = &frame_same_texel),
    FRAME_SAMPLE(frame_env_cube, BUBBLES_ENV_CUBE, .sampler = &frame_linear),
    {
        .buffer = &bubbles_all,
        .access = RG_STORAGE_READ,
        .binding = BUBBLES_DRAWN,
        .stages = VK_SHADER_STAGE_VERTEX_BIT,
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

static void record_bubbles(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (frame->scene->inclusions.bubbles.count)
        rg_cmd_draw(cmd, 6 * frame->scene->inclusions.bubbles.count);
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

bool bubbles_are_traced(const struct technique_config *config)
{
    const struct refract_bounce_params *bounce =
        settings_of(config->settings, &refract_bounce_settings);
    return is_on(config->settings) && config->refraction == &refract_bounce &&
           bounce->inclusions == REFRACT_BOUNCE_INCLUSIONS_ALL;
}

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    values[CONSTANT_BUBBLES_TRACED] = bubbles_are_traced(config);
}

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    (void)builder;
    const struct bubbles_params *params = settings_of(config->settings, &bubbles_settings);
    const bool are_spheres = params->shape == GENERATE_BUBBLES_SPHERE;
    return params->count
               ? (struct rg_technique){ "bubbles", are_spheres ? &spheres_pass : &shapes_pass, 1 }
               : (struct rg_technique){ 0 };
}

static struct bubbles_drawn to_world(const struct bubble *bubble, const struct globals *globals)
{
    return (struct bubbles_drawn){
        .center = glms_mat4_mulv3(globals->world_from_object, bubble->center, 1.0f),
        .radius = bubble->radius,
        .axis = glms_mat4_mulv3(globals->world_from_object, bubble->axis, 0.0f),
        .stretch = bubble->stretch,
        .is_capsule = bubble->is_capsule,
    };
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
        const struct bubbles_drawn drawn = to_world(&all->all[i], globals);
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

/* Maximum number of bubbles in a box of the BVH that holds no other boxes. */
#define LEAF_COUNT 4u

static struct box box_of(const struct bubbles_drawn *bubble)
{
    const float stretch = fmaxf(bubble->stretch, 0.0f);
    const vec3s along = glms_vec3_scale(glms_vec3_abs(bubble->axis), stretch);
    const vec3s half = glms_vec3_adds(along, bubble->radius);
    return (struct box){ glms_vec3_sub(bubble->center, half), glms_vec3_add(bubble->center, half) };
}

#define COMPARE_ALONG(axis) \
    static int compare_##axis(const void *a, const void *b) \
    { \
        const float x = ((const struct bubbles_drawn *)a)->center.axis; \
        const float y = ((const struct bubbles_drawn *)b)->center.axis; \
        return (x > y) - (x < y); \
    }
COMPARE_ALONG(x)
COMPARE_ALONG(y)
COMPARE_ALONG(z)

/* Appends the nodes of a BVH by median splits along the longest side. Reorders the bubbles. Returns
 * the number of nodes, which include the `used` ones before. */
static uint32_t append_nodes(struct bubbles_node *nodes, uint32_t used, struct bubbles_drawn *all,
                             uint32_t count)
{
    static int (*const compare[3])(const void *, const void *) = { compare_x, compare_y,
                                                                   compare_z };
    struct box box = box_of(&all[0]);
    for (uint32_t i = 1; i < count; i++) {
        const struct box other = box_of(&all[i]);
        box =
            (struct box){ glms_vec3_minv(box.min, other.min), glms_vec3_maxv(box.max, other.max) };
    }
    const vec3s half = glms_vec3_scale(glms_vec3_sub(box.max, box.min), 0.5f);
    struct bubbles_node *node = &nodes[used++];
    *node = (struct bubbles_node){ .center = box_center(box), .axis = half };
    if (count > LEAF_COUNT) {
        const int longest = half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
        qsort(all, count, sizeof(all[0]), compare[longest]);
        used = append_nodes(nodes, used, all, count / 2);
        used = append_nodes(nodes, used, all + count / 2, count - count / 2);
    }
    for (uint32_t i = 0; i < count && count <= LEAF_COUNT; i++, used++) {
        const bool has_axis = glms_vec3_norm2(all[i].axis) > 0.0f;
        nodes[used] = (struct bubbles_node){
            all[i].center,
            (used + 1) << BUBBLES_NODE_SHIFT |
                (all[i].is_capsule ? BUBBLES_NODE_CAPSULE : BUBBLES_NODE_ELLIPSOID),
            has_axis ? glms_vec3_scale(all[i].axis, all[i].radius)
                     : (vec3s){ { 0.0f, all[i].radius, 0.0f } },
            all[i].stretch,
        };
    }
    node->link = used << BUBBLES_NODE_SHIFT;
    return used;
}

void bubbles_write_bvh(void *memory, const struct frame_view *view, const struct globals *globals)
{
    const struct bubbles *all = &view->scene->inclusions.bubbles;
    struct bubbles_node *nodes = memory;
    struct bubbles_drawn in_world[BUBBLES_COUNT_MAX];
    for (uint32_t i = 0; i < all->count; i++)
        in_world[i] = to_world(&all->all[i], globals);
    if (all->count)
        append_nodes(nodes, 0, in_world, all->count);
    else
        nodes[0] = (struct bubbles_node){ .link = 0 };
}

static const struct technique_upload uploads[] = {
    { &bubbles_all, bubbles_write },
    { &bubbles_bvh, bubbles_write_bvh },
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
    .write_constants = write_constants,
    .pass_groups = { { PHASE_INCLUSIONS, .make_passes = make_passes } },
};
