/* local_box.c: box of projected environment lookups (refract.lookup=box). */
#include "src/tech/local_box.h"
#include <math.h>
#include "src/tech/frame.h"

#define LOCAL(field, what) \
    { \
        .name = "local." #field, .label = "Environment box, " what, .type = SETTING_FLOAT, \
        .offset = offsetof(struct local_params, field), .min = -1e6, .max = 1e6, .unit = "metres", \
        .help = \
            "box of refract.lookup=box: " what " (if all six are 0: bounds of the surroundings)" \
    }

static const struct setting local_rows[] = {
    LOCAL(left, "minimum x"), LOCAL(right, "maximum x"), LOCAL(bottom, "minimum y"),
    LOCAL(top, "maximum y"),  LOCAL(back, "minimum z"),  LOCAL(front, "maximum z"),
};

const struct setting_group local_settings = SETTING_GROUP("local", local_rows, struct local_params);

struct box local_box_of(const struct scene *scene, const struct settings *settings)
{
    const struct local_params *local = settings_of(settings, &local_settings);
    const float all = fabsf(local->left) + fabsf(local->right) + fabsf(local->bottom) +
                      fabsf(local->top) + fabsf(local->back) + fabsf(local->front);
    if (!(all > 0.0f))
        return scene->around;
    return (struct box){
        .min = { { local->left, local->bottom, local->back } },
        .max = { { local->right, local->top, local->front } },
    };
}

static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct box box = local_box_of(view->scene, view->settings);
    g->local_min = box.min;
    g->local_max = box.max;
}

const struct technique local_box = {
    .name = "local_box",
    .help = "box projection of the environment",
    .settings = { &local_settings },
    .write_globals = write_globals,
};
