/* env_box.c: box of parallax-corrected environment lookups (refract.lookup=box). */
#include "src/tech/refract/env_box.h"
#include <math.h>
#include "src/tech/frame_resources.h"

#define SIDE(field, former, what) \
    { \
        .name = "env_box." #field, .renamed_from = "local." former, \
        .label = "Environment box, " what, .type = SETTING_FLOAT, \
        .offset = offsetof(struct env_box_params, field), .min = -1e6, .max = 1e6, \
        .unit = "metres", \
        .help = \
            "box of refract.lookup=box: " what " (if all six are 0: bounds of the surroundings)" \
    }

static const struct setting rows[] = {
    SIDE(min_x, "left", "minimum x"),   SIDE(max_x, "right", "maximum x"),
    SIDE(min_y, "bottom", "minimum y"), SIDE(max_y, "top", "maximum y"),
    SIDE(min_z, "back", "minimum z"),   SIDE(max_z, "front", "maximum z"),
};

SETTING_GROUP(env_box, rows, struct env_box_params);

struct box env_box_of(const struct scene *scene, const struct settings *settings)
{
    const struct env_box_params *box = settings_of(settings, &env_box_settings);
    const float all = fabsf(box->min_x) + fabsf(box->max_x) + fabsf(box->min_y) +
                      fabsf(box->max_y) + fabsf(box->min_z) + fabsf(box->max_z);
    if (!(all > 0.0f))
        return scene->model.box;
    const double *origin = scene->model.origin;
    return (struct box){
        .min = { { (float)((double)box->min_x - origin[0]), (float)((double)box->min_y - origin[1]),
                   (float)((double)box->min_z - origin[2]) } },
        .max = { { (float)((double)box->max_x - origin[0]), (float)((double)box->max_y - origin[1]),
                   (float)((double)box->max_z - origin[2]) } },
    };
}

static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct box box = env_box_of(view->scene, view->settings);
    g->local_min = box.min;
    g->local_max = box.max;
}

const struct technique env_box = {
    .name = "env_box",
    .help = "box projection of the environment",
    .settings = &env_box_settings,
    .write_globals = write_globals,
};
