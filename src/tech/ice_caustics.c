/*
 * ice_caustics.c: the sun's light that comes through the ice, and the ice's shadow.
 *
 * Photon maps of refractive objects in the light's view, after Wyman and Davis 2006, Interactive
 * Image-Space Techniques for Approximating Caustics, and Shah, Konttinen and Pattanaik 2007,
 * Caustics Mapping: the ice's faces are drawn as the sun sees them, each texel of the front is a
 * photon that goes the way of refract_bounce.c, meets the depth of what the sun sees behind the
 * ice, and is counted there. The map lies square to the light, so that a texel of it stands for as
 * much light as another, however steep the ground is: none is lost or made. A photon brings what
 * Fresnel's equations let through where it enters and where it leaves, less what the ice absorbs.
 *
 * Limits: light reflected inside though not totally is gone, as is what leaves the map, and light
 * that the ice mirrors. Ground that the sun cannot see behind the ice gets none. Beams end at the
 * nearest thing on their way in that view, even where they would pass behind it or through holes
 * that are only in its texture. The map's texels blur: a photon fills three by three of them.
 * Cracks, air, bubbles and frost let all light pass; what lies around casts no shadows of its own.
 */
#include "src/tech/ice_caustics.h"
#include "shaders/background.h"
#include "shaders/embedded.h"
#include "shaders/globals.h"
#include "shaders/refract.h"
#include "src/tech/background.h"
#include "src/tech/bump.h"
#include "src/tech/caustics.h"
#include "src/tech/frame.h"
#include "src/tech/refract_bounce.h"

static rg_record_fn record_ground, record_photons, record_clear, record_splat, record_map,
    record_layers;

#define PICTURE(title, texel) \
    { \
        .name = (title), .format = (texel), .width = ICE_CAUSTICS_PHOTONS, \
        .height = ICE_CAUSTICS_PHOTONS \
    }
#define MAP(title, texel) \
    { \
        .name = (title), .format = (texel), .width = ICE_CAUSTICS_SIZE, \
        .height = ICE_CAUSTICS_SIZE \
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

static const struct rg_image back = PICTURE("ice_caustics.back", VK_FORMAT_R16G16B16A16_SFLOAT);
static const struct rg_image back_depth = PICTURE("ice_caustics.back_depth", VK_FORMAT_D32_SFLOAT);
static const struct rg_image front = PICTURE("ice_caustics.front", VK_FORMAT_R16G16B16A16_SFLOAT);
const struct rg_image ice_caustics_front_depth =
    PICTURE("ice_caustics.front_depth", VK_FORMAT_D32_SFLOAT);
static const struct rg_image photons_depth =
    PICTURE("ice_caustics.photons_depth", VK_FORMAT_D32_SFLOAT);
static const struct rg_image landed_red =
    PICTURE("ice_caustics.landed_red", VK_FORMAT_R32G32B32A32_SFLOAT);
static const struct rg_image landed_green =
    PICTURE("ice_caustics.landed_green", VK_FORMAT_R32G32B32A32_SFLOAT);
static const struct rg_image landed_blue =
    PICTURE("ice_caustics.landed_blue", VK_FORMAT_R32G32B32A32_SFLOAT);

const struct rg_image ice_caustics_ground = MAP("ice_caustics.ground", VK_FORMAT_D32_SFLOAT);
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
#define USE_IMAGE(target, at) \
    { \
        .image = (target), .access = RG_SAMPLED, .binding = (at) \
    }
#define USE_LINEAR(target, at) \
    { \
        .image = (target), .access = RG_SAMPLED, .binding = (at), .sampler = &frame_linear \
    }

/* What the sun sees of the ice, as ice_normal.c. */
#define FACES(title, normals, depths, hidden) \
    { \
        .name = (title), .color = RG_TARGETS({ (normals), RG_LOAD_CLEAR }), \
        .depth = { (depths), RG_LOAD_CLEAR }, .depth_compare = VK_COMPARE_OP_GREATER, \
        .uses = RG_USES(USE_GLOBALS), .vert = &ice_normal_vert, .frag = &ice_normal_frag, \
        .vertices = &frame_mesh_layout, .cull = (hidden), .record = frame_draw_object \
    }

#define GROUND \
    { \
        .name = "ice_caustics.ground", .depth = { &ice_caustics_ground, RG_LOAD_CLEAR }, \
        .depth_compare = VK_COMPARE_OP_GREATER, \
        .uses = RG_USES(FRAME_USE_GLOBALS, USE_LIGHT, \
                        USE_IMAGE(&ice_caustics_front_depth, ICE_CAUSTICS_FRONT)), \
        .vert = &ice_caustics_ground_vert, .frag = &ice_caustics_ground_frag, \
        .vertices = &frame_mesh_layout, .record = record_ground \
    }

#define PHOTON_USES \
    USE_GLOBALS, USE_LIGHT, USE_LINEAR(&back, REFRACT_NORMAL_BACK), \
        USE_IMAGE(&back_depth, REFRACT_DEPTH_BACK), USE_LINEAR(&front, REFRACT_NORMAL_FRONT), \
        USE_IMAGE(&ice_caustics_front_depth, REFRACT_DEPTH_FRONT), \
        USE_IMAGE(&ice_caustics_ground, ICE_CAUSTICS_GROUND)

#define PHOTONS(...) \
    { \
        .name = "ice_caustics.photons", \
        .color = RG_TARGETS({ &landed_red, RG_LOAD_CLEAR }, { &landed_green, RG_LOAD_CLEAR }, \
                            { &landed_blue, RG_LOAD_CLEAR }), \
        .depth = { &photons_depth, RG_LOAD_CLEAR }, .depth_compare = VK_COMPARE_OP_GREATER, \
        .vertices = &frame_mesh_layout, .cull = VK_CULL_MODE_BACK_BIT, \
        .push_size = sizeof(struct ice_caustics_push), .record = record_photons, __VA_ARGS__ \
    }

#define BEFORE \
    FACES("ice_caustics.back", &back, &back_depth, VK_CULL_MODE_FRONT_BIT), \
        FACES("ice_caustics.front", &front, &ice_caustics_front_depth, VK_CULL_MODE_BACK_BIT), \
        GROUND

#define AFTER \
    { .name = "ice_caustics.clear", \
      .kind = RG_COMPUTE, \
      .uses = RG_USES( \
          { .image = &counts, .access = RG_STORAGE_WRITE, .binding = ICE_CAUSTICS_COUNTS }), \
      .comp = &ice_caustics_clear_comp, \
      .record = record_clear }, \
        { .name = "ice_caustics.splat", \
          .kind = RG_COMPUTE, \
          .uses = RG_USES(USE_IMAGE(&landed_red, ICE_CAUSTICS_LANDED), \
                          USE_IMAGE(&landed_green, ICE_CAUSTICS_LANDED + 1), \
                          USE_IMAGE(&landed_blue, ICE_CAUSTICS_LANDED + 2), \
                          { .image = &counts, \
                            .access = RG_STORAGE_READ_WRITE, \
                            .binding = ICE_CAUSTICS_COUNTS }), \
          .comp = &ice_caustics_splat_comp, \
          .record = record_splat }, \
    { \
        .name = "ice_caustics.map", .color = RG_TARGETS({ &ice_caustics_map, RG_LOAD_DISCARD }), \
        .uses = RG_USES(USE_LIGHT, USE_IMAGE(&counts, ICE_CAUSTICS_COUNTS), \
                        USE_LINEAR(&front, ICE_CAUSTICS_NORMAL)), \
        .vert = &screen_vert, .frag = &ice_caustics_map_frag, .record = record_map, \
    }

static const struct rg_pass passes[] = {
    BEFORE,
    PHOTONS(.uses = RG_USES(PHOTON_USES), .vert = &refract_vert,
            .frag = &ice_caustics_photons_frag),
    AFTER,
};

static const struct rg_pass bumped_passes[] = {
    BEFORE,
    PHOTONS(.uses = RG_USES(PHOTON_USES, BUMP_USE_MAP), .vert = &refract_bump_vert,
            .frag = &ice_caustics_photons_bump_frag),
    AFTER,
};

static const struct rg_pass seen_passes[] = {
    {
        .name = "ice_caustics.layers",
        .color = RG_TARGETS({ &caustics_seen, RG_LOAD_CLEAR }),
        .depth = { &background_depth, RG_LOAD_KEEP },
        .depth_read_only = true,
        .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
        .uses = RG_USES(FRAME_USE_GLOBALS, ICE_CAUSTICS_USES),
        .vert = &background_vert,
        .frag = &ice_caustics_layers_frag,
        .vertices = &frame_mesh_layout,
        .push_size = sizeof(struct background_push),
        .record = record_layers,
    },
};

static void record_ground(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static void record_photons(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct refract_march *march = settings_of(frame->settings, &refract_bounce_settings);
    const struct caustics_params *caustics = settings_of(frame->settings, &caustics_settings);
    const struct ice_caustics_push push = {
        .march = *march,
        .sun_x = frame->jitter.x,
        .sun_y = frame->jitter.y,
        .sun = caustics->sun,
    };
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw_mesh(cmd, &frame->object);
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

static void record_map(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
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
        .name = "ice_caustics.light",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct ice_caustics_params, light),
        .max = ICE_CAUSTICS_SUN,
        .choices = lights,
        .help = "whose light goes through the ice to what lies around it (none: no shadow, too)",
    },
    {
        .name = "ice_caustics.reach",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct ice_caustics_params, reach),
        .initial = 3,
        .min = 1,
        .max = 100,
        .unit = "radii",
        .help = "how far from the ice's shadow's middle this light is kept, and how fine",
    },
    {
        .name = "ice_caustics.shadow",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct ice_caustics_params, shadow),
        .initial = 1,
        .max = 1,
        .help = "what the ice covers gets no sun but through it (off: that light is added)",
    },
};

const struct setting_group ice_caustics_settings =
    SETTING_GROUP("ice_caustics", rows, struct ice_caustics_params);

bool ice_caustics_is_on(const struct settings *settings)
{
    const struct ice_caustics_params *params = settings_of(settings, &ice_caustics_settings);
    return params->light != ICE_CAUSTICS_NONE;
}

const struct technique ice_caustics = {
    .graph = RG_TECHNIQUE("ice_caustics", passes),
    .settings = &ice_caustics_settings,
    .help = "the sun's light through the ice, by photons in its view",
};

const struct technique ice_caustics_bumped = {
    .graph = RG_TECHNIQUE("ice_caustics", bumped_passes),
    .settings = &ice_caustics_settings,
    .help = "the same with bumps",
};

const struct technique ice_caustics_seen = {
    .graph = RG_TECHNIQUE("ice_caustics", seen_passes),
    .settings = &ice_caustics_settings,
    .help = "how much of the sun's light there is on what is seen",
};
