/*
 * env_cube.c: the environment cube.
 *
 * Seipel and Nivfors 2006, section 3.2: the entire scene without the ice, rendered six times with
 * a field of view of 90 degrees from the centre of the ice object, 512 x 512 texels a face.
 * Alpha is 1 / distance from there, 0 where only the sky is seen: by it rungs follow a ray to what
 * is near. Faces in Vulkan's order and orientation, which is left-handed: nothing here culls by
 * winding. The cube lives from frame to frame: a face is drawn when it is due (src/frame/cube.h).
 *
 * Limits: what lies near the object is seen from its centre, not from where light leaves it, if
 * refract.lookup is infinite; and else, too, what other things hide from the centre is not there.
 */
#include "src/tech/env_cube.h"
#include "shaders/embedded.h"
#include "src/tech/background.h"
#include "src/tech/frame.h"
#include "src/tech/ice_caustics.h"

enum {
    FACE_SIZE = 512
};

static rg_record_fn record_surroundings, record_sky;
static rg_when_fn is_due;

const struct rg_image env_cube_color = {
    .name = "env_cube.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .width = FACE_SIZE,
    .height = FACE_SIZE,
    .cube = true,
    .persistent = true, /* of a face that is not due, the last picture */
};

static const struct rg_image env_cube_depth = {
    .name = "env_cube.depth",
    .format = VK_FORMAT_D32_SFLOAT,
    .width = FACE_SIZE,
    .height = FACE_SIZE,
    .layers = 6,
};

/* As large as the view. */
const struct rg_image env_cube_baked = {
    .name = "env_cube.baked",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .cube = true,
};

static const struct rg_image env_cube_baked_depth = {
    .name = "env_cube.baked_depth",
    .format = VK_FORMAT_D32_SFLOAT,
    .layers = 6,
};

#define SURROUNDINGS_ROW(surroundings, target, target_depth, condition) \
    { \
        .name = "env_cube.surroundings", .repeat = RG_PER_LAYER, \
        surroundings(&(target), &(target_depth)), .record = record_surroundings, \
        .when = (condition) \
    }

#define SKY_ROW(target, target_depth, condition) \
    { \
        .name = "env_cube.sky", .repeat = RG_PER_LAYER, \
        BACKGROUND_SKY(&(target), &(target_depth)), .record = record_sky, .when = (condition) \
    }

static const struct rg_pass passes[] = {
    SURROUNDINGS_ROW(BACKGROUND_SURROUNDINGS, env_cube_color, env_cube_depth, is_due),
    SKY_ROW(env_cube_color, env_cube_depth, is_due),
};

static const struct rg_pass shine_passes[] = {
    SURROUNDINGS_ROW(BACKGROUND_SHINING_SURROUNDINGS, env_cube_color, env_cube_depth, is_due),
    SKY_ROW(env_cube_color, env_cube_depth, is_due),
};

static const struct rg_pass bake_passes[] = {
    SURROUNDINGS_ROW(BACKGROUND_SURROUNDINGS, env_cube_baked, env_cube_baked_depth, NULL),
    SKY_ROW(env_cube_baked, env_cube_baked_depth, NULL),
};

static bool is_due(const struct rg_frame *frame, uint32_t repetition)
{
    return frame->faces_due & 1u << repetition;
}

static void push_face(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->faces[rg_cmd_repetition(cmd)], sizeof(struct background_push));
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

static const struct setting rows[] = {
    {
        .name = "env_cube.dynamic",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct env_cube_params, dynamic),
        .initial = 1,
        .max = 1,
        .help = "draw the environment cube as it changes (off: once, at motion.time)",
    },
    {
        .name = "env_cube.always",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct env_cube_params, always),
        .max = 1,
        .help = "and all six faces of it in every frame (off: those in which something changed)",
    },
    {
        .name = "env_cube.faces",
        .type = SETTING_COUNT,
        .offset = offsetof(struct env_cube_params, faces),
        .initial = 6,
        .min = 1,
        .max = 6,
        .help = "or at most so many a frame of a window, in turn",
    },
};

const struct setting_group env_cube_settings =
    SETTING_GROUP("env_cube", rows, struct env_cube_params);

const struct technique env_cube = {
    .graph = RG_TECHNIQUE("env_cube", passes),
    .settings = &env_cube_settings,
    .help = "the scene without the ice, six ways from its centre",
};

const struct technique env_cube_shine = {
    .graph = RG_TECHNIQUE("env_cube", shine_passes),
    .settings = &env_cube_settings,
    .help = "the same with light that comes through the ice",
};

const struct technique env_cube_bake = {
    .graph = RG_TECHNIQUE("env_cube", bake_passes),
    .settings = &env_cube_settings,
    .help = "the same in faces as large as the view",
};
