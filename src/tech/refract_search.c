/*
 * refract_search.c: the exit searched along the refracted ray.
 *
 * The ray is followed in the picture until it is behind the back faces: steps up to the object's
 * bounding sphere, then the one that went outside is divided where it would meet a flat face. There
 * it is bent by the back normal of that place.
 *
 * Error: some hundredths of a degree on average on convex objects in 512 x 512 pixels, growing with
 * the size of the pixels; but what is totally reflected leaves in the direction of its first
 * reflection, dozens of degrees off. Of a concave object the nearest back faces count.
 */
#include "src/tech/refract_search.h"
#include "shaders/embedded.h"
#include "shaders/refract_march.h"
#include "src/tech/bump.h"
#include "src/tech/frame.h"
#include "src/tech/refract.h"

static rg_record_fn record_object;

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS, REFRACT_USE_ENV_CUBE, REFRACT_USE_NORMAL_BACK, REFRACT_USE_DEPTH_BACK, { 0 },
};

static const struct rg_use bumped_uses[] = {
    FRAME_USE_GLOBALS,      REFRACT_USE_ENV_CUBE, REFRACT_USE_NORMAL_BACK,
    REFRACT_USE_DEPTH_BACK, BUMP_USE_MAP,         { 0 },
};

static const struct rg_pass passes[] = {
    REFRACT_ROWS(search, , REFRACT_FRONT_FACES, .uses = uses,
                 .push_size = sizeof(struct refract_march), .record = record_object),
};

static const struct rg_pass bumped_passes[] = {
    REFRACT_ROWS(search, _bump, REFRACT_BUMPED_FACES, .uses = bumped_uses,
                 .push_size = sizeof(struct refract_march), .record = record_object),
};

static void record_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_search_settings),
                sizeof(struct refract_march));
    rg_cmd_draw_mesh(cmd, &frame->object);
}

static const struct setting rows[] = {
    {
        .name = "refract_search.steps",
        .type = SETTING_COUNT,
        .offset = offsetof(struct refract_march, steps),
        .initial = 8,
        .min = 1,
        .max = 256,
        .help = "along a ray inside, until one is outside",
    },
    {
        .name = "refract_search.halvings",
        .type = SETTING_COUNT,
        .offset = offsetof(struct refract_march, halvings),
        .initial = 8,
        .max = 32,
        .help = "of the step that went outside, at most; fewer find a flat face",
    },
};

const struct setting_group refract_search_settings =
    SETTING_GROUP("refract_search", rows, struct refract_march);

const struct technique refract_search[] =
    REFRACT_TECHNIQUES("refract_search", passes, .settings = &refract_search_settings,
                       .help = "two bends, the exit searched among the back faces");

const struct technique refract_search_bumped[] =
    REFRACT_TECHNIQUES("refract_search", bumped_passes, .settings = &refract_search_settings,
                       .help = "the same with bumps");
