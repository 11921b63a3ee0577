/* layer_comparison.c: compares two images layer by layer. */
#include "src/lab/metric/layer_comparison.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char beauty[] = "beauty";
static const char *const beauty_planes[3] = { "R", "G", "B" };

const char *const comparison_metric_names[COMPARISON_METRIC_COUNT] = {
    [COMPARISON_FLIP] = "flip", [COMPARISON_RMSE] = "rmse",   [COMPARISON_RELMSE] = "relmse",
    [COMPARISON_MAE] = "mae",   [COMPARISON_ANGLE] = "angle",
};

static size_t pixel_count(const struct comparison_params *params)
{
    return (size_t)params->reference->width * params->reference->height;
}

static bool counts(const struct comparison_params *params, size_t pixel)
{
    return !params->counted || params->counted[pixel];
}

static bool is_beauty(const char *plane)
{
    return strlen(plane) == 1 && strchr("RGB", *plane);
}

static bool find_planes(const struct comparison_params *params, const char *const names[static 3],
                        const float *reference[static 3], const float *test[static 3])
{
    bool found = true;
    for (int i = 0; i < 3; i++) {
        reference[i] = image_find(params->reference, names[i]);
        test[i] = image_find(params->test, names[i]);
        found = found && reference[i] && test[i];
    }
    return found;
}

static struct comparison_layer *add_layer(struct comparison *c, const char *name, size_t length)
{
    for (uint32_t i = 0; i < c->layer_count; i++) {
        struct comparison_layer *layer = &c->layers[i];
        if (strlen(layer->name) == length && !strncmp(layer->name, name, length))
            return layer;
    }
    struct comparison_layer *layer = &c->layers[c->layer_count++];
    /* `name` fits; `layer` is zero-initialised */
    memcpy(layer->name, name, length);
    return layer;
}

static void add_plane(struct comparison *c, const struct comparison_params *params,
                      const struct image_plane *plane, const float *test)
{
    const char *dot = strrchr(plane->name, '.');
    const bool of_beauty = c->has_beauty && is_beauty(plane->name);
    const char *name = of_beauty ? beauty : plane->name;
    const bool has_layer = dot && dot != plane->name;
    struct comparison_layer *layer =
        add_layer(c, name, has_layer ? (size_t)(dot - plane->name) : strlen(name));
    difference_add(&layer->difference, plane->texels, test, params->counted, pixel_count(params));
}

static bool measure_layers(struct comparison *c, const struct comparison_params *params)
{
    const struct image *r = params->reference, *t = params->test;
    c->layers = calloc(r->plane_count + 1, sizeof(*c->layers));
    c->only_reference = calloc(r->plane_count + 1, sizeof(*c->only_reference));
    c->only_test = calloc(t->plane_count + 1, sizeof(*c->only_test));
    if (!c->layers || !c->only_reference || !c->only_test)
        return false;
    if (c->has_beauty)
        add_layer(c, beauty, strlen(beauty));
    for (uint32_t i = 0; i < r->plane_count; i++) {
        const float *test = image_find(t, r->planes[i].name);
        if (test)
            add_plane(c, params, &r->planes[i], test);
        else
            c->only_reference[c->only_reference_count++] = r->planes[i].name;
    }
    for (uint32_t i = 0; i < t->plane_count; i++) {
        if (!image_find(r, t->planes[i].name))
            c->only_test[c->only_test_count++] = t->planes[i].name;
    }
    return true;
}

static bool measure_flip(struct comparison *c, const struct comparison_params *params)
{
    struct flip_pair pair = {
        .width = params->reference->width,
        .height = params->reference->height,
        .ppd = params->ppd,
    };
    double sum = 0.0;
    c->has_beauty = find_planes(params, beauty_planes, pair.reference, pair.test);
    if (!c->has_beauty)
        return true;
    c->errors = malloc(pixel_count(params) * sizeof(*c->errors));
    if (!c->errors)
        return false;
    c->is_hdr = !params->display && !params->has_exposure;
    if (c->is_hdr ? !flip_hdr(&pair, params->curve, c->errors, &c->exposures)
                  : !flip_ldr(&pair, params->exposure, c->errors))
        return false;
    for (size_t i = 0; i < pixel_count(params); i++) {
        if (!counts(params, i))
            c->errors[i] = 0.0f;
        sum += (double)c->errors[i];
    }
    c->flip = c->counted ? sum / (double)c->counted : (double)NAN;
    return true;
}

static bool measure_exit(struct comparison *c, const struct comparison_params *params)
{
    static const char *const names[3] = { "exit.X", "exit.Y", "exit.Z" };
    struct angle_pair pair = { .counted = params->counted, .pixel_count = pixel_count(params) };
    c->has_exit = find_planes(params, names, pair.reference, pair.test);
    if (!c->has_exit)
        return true;
    c->degrees = malloc(pair.pixel_count * sizeof(*c->degrees));
    return c->degrees && angle_measure(&c->angle, &pair, c->degrees);
}

/* Counts pixels at which layer `tir` differs. If both images have a layer `exit`, skips pixels
 * where both lack an exit direction. */
static void measure_tir(struct comparison *c, const struct comparison_params *params)
{
    static const char *const names[3] = { "exit.X", "exit.Y", "exit.Z" };
    const float *reference_exit[3], *test_exit[3];
    const float *reference = image_find(params->reference, "tir.Z");
    const float *test = image_find(params->test, "tir.Z");
    c->has_tir = reference && test;
    if (!c->has_tir)
        return;
    const bool has_exit = find_planes(params, names, reference_exit, test_exit);
    for (size_t i = 0; i < pixel_count(params); i++) {
        if (!counts(params, i) ||
            (has_exit && !angle_is_there(reference_exit, i) && !angle_is_there(test_exit, i)))
            continue;
        c->tir_count++;
        c->tir_differs += !(reference[i] == test[i]); /* NaN differs from everything */
    }
}

bool comparison_init(struct comparison *c, const struct comparison_params *params)
{
    *c = (struct comparison){ 0 };
    assert(pixel_count(params) > 0);
    for (size_t i = 0; i < pixel_count(params); i++)
        c->counted += counts(params, i);
    if (!measure_flip(c, params) || !measure_layers(c, params) || !measure_exit(c, params)) {
        comparison_finish(c);
        return false;
    }
    measure_tir(c, params);
    return true;
}

void comparison_finish(struct comparison *c)
{
    free(c->errors);
    free(c->degrees);
    free(c->layers);
    free(c->only_reference);
    free(c->only_test);
    *c = (struct comparison){ 0 };
}

const struct comparison_layer *comparison_find(const struct comparison *c, const char *name)
{
    for (uint32_t i = 0; i < c->layer_count; i++) {
        if (!strcmp(c->layers[i].name, name))
            return &c->layers[i];
    }
    return NULL;
}

const struct comparison_layer *comparison_metric(const struct comparison *c,
                                                 enum comparison_metric metric, double *value)
{
    const bool is_angle = metric == COMPARISON_ANGLE;
    const struct comparison_layer *layer = NULL;
    if (is_angle ? c->has_exit : c->has_beauty)
        layer = comparison_find(c, is_angle ? "exit" : beauty);
    if (layer) {
        const double values[COMPARISON_METRIC_COUNT] = {
            [COMPARISON_FLIP] = c->flip,
            [COMPARISON_RMSE] = difference_rmse(&layer->difference),
            [COMPARISON_RELMSE] = difference_relmse(&layer->difference),
            [COMPARISON_MAE] = difference_mae(&layer->difference),
            [COMPARISON_ANGLE] = c->angle.mean,
        };
        *value = values[metric];
    }
    return layer;
}
