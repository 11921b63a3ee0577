/*
 * ao.c: ambient occlusion of the refractive objects on their surroundings, from box occluders.
 *
 * Each object is approximated by a box (src/scene/ao_occluders.h). The sky light that it blocks at
 * a diffuse surface is the form factor of the box, a sum over its silhouette edges (Lambert 1760),
 * times the environment's radiance in that direction. In return the object adds sky and ground
 * light that it transmits or reflects, less absorption (src/scene/ao_occluder_transmission.h), so
 * clear objects occlude little, and not at all in a uniform environment. The result is stored in a
 * map from above for the plane of the objects' base; surroundings look it up and fade it with their
 * distance from that plane. Unlike screen-space ambient occlusion, boxes give analytic, noise-free
 * and view-independent results. The map also holds the occlusion of the sky by surroundings that
 * stand on the plane (height field, horizon search); they are taken to be light grey.
 *
 * Limits: an object transmits equal fractions to all points around it; the light is that of the
 * whole sky, of the environment behind it or of the surface itself. Walls are not shaded. Hollow
 * objects count as thinner solid ones. Bubbles, cracks and frost are ignored; scattering media are
 * averaged. At most AO_OCCLUDERS_MAX objects; water layers and puddles have none. Surroundings
 * occlude each other only inside the map, and not where the free space below them is higher than
 * they are. Specular light of surfaces with screen-space reflections is not occluded.
 */
#include "src/tech/lighting/ao.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/embedded.h"
#include "shaders/lighting/ao.h"
#include "shaders/specialization_constants.h"
#include "src/scene/ao_occluder_transmission.h"
#include "src/tech/frame_media.h"
#include "src/tech/frame_resources.h"
#include "src/tech/inclusions/medium_density_fields.h"

static const struct rg_buffer bodies = {
    .name = "ao.occluders",
    .size = sizeof(struct ao_occluders),
    .memory = RG_MEMORY_UPLOAD,
};

static const struct rg_image map = {
    .name = "ao.map",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .width = AO_MAP_SIZE,
    .height = AO_MAP_SIZE,
    .persistent = true, /* read between updates, too */
};

/* Depth buffer of the highest upward-facing surfaces of the surroundings, seen from above. */
static const struct rg_image heights = {
    .name = "ao.heights",
    .format = VK_FORMAT_D32_SFLOAT,
    .width = AO_HEIGHTS_SIZE,
    .height = AO_HEIGHTS_SIZE,
};

/* Depth buffer of the lowest downward-facing surfaces of the surroundings, seen from above. */
static const struct rg_image undersides = {
    .name = "ao.undersides",
    .format = VK_FORMAT_D32_SFLOAT,
    .width = AO_HEIGHTS_SIZE,
    .height = AO_HEIGHTS_SIZE,
};

static const struct rg_fallback no_change = { { 0 } };

#define USE_BODIES \
    { \
        .buffer = &bodies, .access = RG_UNIFORM, .binding = AO_BINDING \
    }

const struct rg_use ao_uses[] = {
    USE_BODIES,
    FRAME_SAMPLE(map, AO_MAP, .sampler = &frame_linear, .fallback = &no_change),
    { 0 },
};

static bool is_due(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame->due.light || !frame->scene->ao.count;
}

static void record_heights(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (frame->scene->ao.count) /* else the heights are not read */
        rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static const struct rg_pass passes[] = {
    {
        .name = "ao.heights",
        .depth = { &heights, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(FRAME_USE_GLOBALS, USE_BODIES),
        .vert = &ao_heights_vert,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT, /* drops ceilings */
        .record = record_heights,
        .when = is_due,
    },
    {
        .name = "ao.undersides",
        .depth = { &undersides, RG_LOAD_CLEAR, { .depthStencil.depth = 1.0f } },
        .depth_compare = VK_COMPARE_OP_LESS,
        .uses = RG_USES(FRAME_USE_GLOBALS, USE_BODIES),
        .vert = &ao_heights_vert,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_FRONT_BIT,
        .record = record_heights,
        .when = is_due,
    },
    {
        .name = "ao.map",
        .color = RG_TARGETS({ &map, RG_LOAD_DISCARD }),
        .uses = RG_USES(FRAME_USE_GLOBALS, USE_BODIES, FRAME_READ(heights, AO_HEIGHTS),
                        FRAME_READ(undersides, AO_UNDERSIDES),
                        FRAME_SAMPLE(frame_surface_light, SURROUNDINGS_ENVIRONMENT_LIGHT,
                                     .sampler = &frame_environment_sampler)),
        .vert = &fullscreen_vert,
        .frag = &ao_box_occluders_frag,
        .record = frame_draw_screen,
        .when = is_due,
    },
};

/* half the width of the square ambient occlusion map, in radii of the bounding sphere */
static const float reach = 4.0f;

static const struct setting rows[] = {
    {
        SETTING_FIELD("ao.strength", FLOAT, struct ao_params, strength),
        .renamed_from = "contact.strength",
        .label = "Ambient occlusion",
        .initial = 1,
        .max = 1,
        .switches = SETTING_AFFECTS_PLAN,
        .help = "strength of the ambient occlusion of objects on the surroundings (0: off); "
                "reference, and trace unless trace.surroundings=cube, use ground.light instead",
    },
};

SETTING_GROUP(ao, rows, struct ao_params);

static float strength_of(const struct settings *settings)
{
    const struct ao_params *params = settings_of(settings, &ao_settings);
    return params->strength;
}

static bool is_on(const struct settings *settings)
{
    return strength_of(settings) > 0.0f;
}

/* Returns medium_relative_density() averaged over a ball. A cube has the same mean. */
static float medium_mean_density(void)
{
    const int steps = 32;
    float sum = 0.0f;
    for (int i = 0; i < steps; i++) {
        const float depth = ((float)i + 0.5f) / (float)steps;
        sum += 3.0f * (1.0f - depth) * (1.0f - depth) * medium_relative_density(depth);
    }
    return sum / (float)steps;
}

/* Returns the medium of an occluder, averaged by volume over its objects. */
static struct ao_medium medium_of(const struct frame_view *view, const struct globals *globals,
                                  const struct ao_shape *shape)
{
    const uint32_t outside = frame_media_count(view->scene) - 1;
    const float around = frame_medium_at(view->scene, view->settings, outside).ior[1];
    const float reduced = (1.0f - globals->medium_g) * medium_mean_density();
    struct ao_medium medium = { .ior = 1.0f };
    for (uint32_t i = 0; i < shape->member_count; i++) {
        const struct ao_member *member = &shape->members[i];
        const struct frame_medium object_medium =
            frame_medium_at(view->scene, view->settings, member->object);
        const struct medium_field field =
            medium_field_of(view->scene, view->settings, member->object);
        const float weight = fmaxf(member->volume_fraction, 0.0f);
        medium.ior += weight * (object_medium.ior[1] / around - 1.0f);
        medium.absorption = glms_vec3_muladds(object_medium.absorption, weight, medium.absorption);
        medium.scattering += weight * reduced * field.extinction;
        if (i == 0) {
            medium.tint = object_medium.tint;
            medium.diffuse_fraction = object_medium.opacity;
        }
    }
    medium.ior = fmaxf(medium.ior, 1.0f);
    return medium;
}

/* Moves a box corner towards the vertical axis until the box has the occluder's volume. */
static vec3s slimmed_corner(const struct ao_shape *shape, vec3s corner)
{
    const vec3s middle = box_center(shape->box);
    corner.x = glm_lerp(middle.x, corner.x, shape->relative_width);
    corner.z = glm_lerp(middle.z, corner.z, shape->relative_width);
    return corner;
}

/* Returns the world-space height of the lowest corner of a box in object space. */
static float lowest_corner_height(struct box box, mat4s world)
{
    float least = INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        const vec3s at = { { corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                             corner & 4 ? box.max.z : box.min.z } };
        least = fminf(least, glms_mat4_mulv3(world, at, 1.0f).y);
    }
    return least;
}

static void write_bodies(void *memory, const struct frame_view *view, const struct globals *globals)
{
    struct ao_occluders *all = memory;
    const struct ao *found = &view->scene->ao;
    const mat4s world = globals->world_from_object;
    const vec3s up = { { world.m01, world.m11, world.m21 } }; /* world up in object space */
    const struct box box = view->scene->box;
    all->strength = strength_of(view->settings);
    all->count = is_on(view->settings) ? found->count : 0;
    all->center = globals->center;
    all->center.y = lowest_corner_height(box, world);
    all->half_side = reach * fmaxf(globals->radius, 1e-6f);
    all->height = fmaxf(globals->center.y - all->center.y, 1e-6f);
    for (uint32_t i = 0; i < all->count; i++) {
        const struct ao_shape *shape = &found->shapes[i];
        const struct ao_medium medium = medium_of(view, globals, shape);
        const struct ao_light light = ao_light_of(shape, &medium, up);
        all->all[i] = (struct ao_occluder){
            .min = slimmed_corner(shape, shape->box.min),
            .max = slimmed_corner(shape, shape->box.max),
            .sky = light.sky,
            .ground = light.ground,
            .undeviated = light.undeviated,
        };
    }
}

static bool has_materials(const struct technique_config *config)
{
    return config->scene->tables.materials;
}

static bool affects_light(const struct scene *scene)
{
    return scene->ao.count > 0;
}

static const struct technique_upload uploads[] = {
    { &bodies, write_bodies },
    { 0 },
};

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    values[CONSTANT_AO] = is_on(config->settings) && !technique_hits_surroundings(config);
}

const struct technique ao = {
    .name = "ao",
    .help = "ambient occlusion of the objects on the surroundings",
    .settings = &ao_settings,
    .is_on = is_on,
    .is_traced = true,
    .is_hit = true,
    .affects_light = affects_light,
    .title = "ambient occlusion",
    .pass_groups = { { PHASE_LIGHT, SCENE_OF_OBJECT, .graph = RG_TECHNIQUE("ao", passes),
                       .is_drawn = has_materials } },
    .uploads = uploads,
    .write_constants = write_constants,
};
