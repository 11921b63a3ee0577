/* pixel_inspector.c: converts layers to displayable pixels, reads pixels, computes histograms. */
#include "src/view/pixel_inspector.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/metric/heat_map.h"
#include "src/lab/reference/ray_layer_tracer.h"
#include "src/lab/reference/reference.h"
#include "src/setup/aov_to_png.h"
#include "src/setup/object_id_names.h"
#include "src/tech/output/tonemap.h"

static const char *const always[] = { "Z", "N", "P", "object", NULL };
static const float darkest_stops = -12.0f; /* histogram range, stops */
static const float brightest_stops = 8.0f;

/* Moves the current image to `previous`; the next call frees it. Consecutive images must have
 * different handles, because the presenter recognises a new image by its handle. */
static void forget(struct pixel_inspector *inspector, struct gpu *gpu)
{
    gpu_image_destroy(gpu, &inspector->previous);
    inspector->previous = inspector->image;
    inspector->image = (struct gpu_image){ 0 };
    free(inspector->rgba);
    inspector->rgba = NULL;
}

void pixel_inspector_finish(struct pixel_inspector *inspector, struct gpu *gpu)
{
    forget(inspector, gpu);
    gpu_image_destroy(gpu, &inspector->previous);
    image_finish(&inspector->layers);
    free(inspector->names);
    inspector->names = NULL;
}

/* Skips layers that only the reference computes, and traced layers in builds without Embree. */
const struct frame_layer *pixel_inspector_layer(uint32_t i)
{
    const struct frame_layer *layer;
    for (size_t l = 0; i && (layer = techniques_layer(l)); l++) {
        if ((layer->image || (layer->is_traced && reference_is_built())) && !--i)
            return layer;
    }
    return NULL;
}

bool pixel_inspector_replaces_image(const struct pixel_inspector_choice *c)
{
    return c->layer || c->channel || c->false_color || c->stops < 0.0f || c->stops > 0.0f;
}

/* Adds those layers of `params` that the CPU traces to an image. */
static enum status trace_layers(const struct renderer_params *params, const struct viewport *p,
                                const struct renderer_shot *shot, struct image *image)
{
    struct ray_layer_tracer *tracer = NULL;
    char *objects = object_names(&p->scene), *materials = material_names(&p->scene);
    enum status status = objects && materials
                             ? ray_layer_tracer_create(&tracer, params, objects, materials)
                             : log_out_of_memory("names");
    if (status == STATUS_OK)
        status = ray_layer_tracer_draw(tracer, shot, image);
    ray_layer_tracer_destroy(tracer);
    free(objects);
    free(materials);
    return status;
}

enum status pixel_inspector_draw(struct pixel_inspector *inspector, struct viewport *p,
                                 const struct renderer_shot *shot)
{
    struct renderer_params params = viewport_params(p);
    struct renderer *renderer = NULL;
    struct render_result result = { 0 };
    params.refraction = p->state.refraction;
    params.samples = 1;
    params.linear = true;
    params.layers = layer_image_bit(pixel_inspector_layer(inspector->choice.layer));
    for (size_t i = 0; always[i]; i++)
        params.layers |= layer_image_bit(layer_image_find(always[i]));
    const uint64_t traced = ray_layer_tracer_mask(params.layers);
    params.layers &= ~traced;
    enum status status = renderer_create(&renderer, &params);
    if (status == STATUS_OK)
        status = renderer_render(renderer, shot, &result, NULL, NULL);
    renderer_destroy(renderer);
    params.layers = traced;
    if (status == STATUS_OK && traced)
        status = trace_layers(&params, p, shot, &result.image);
    image_finish(&inspector->layers);
    inspector->layers = result.image;
    free(inspector->names);
    inspector->names = object_names(&p->scene);
    inspector->drawn_layer = inspector->choice.layer;
    return status;
}

/* Planes of a layer or of the rendered image. */
struct planes {
    const float *data[FRAME_LAYER_PLANES];
    uint32_t count;
    float scale; /* factor on the texel values */
    size_t size;
};

static struct planes open_planes(const struct pixel_inspector *inspector, const struct viewport *p,
                                 uint32_t layer)
{
    const struct frame_layer *which = layer ? pixel_inspector_layer(layer) : &frame_beauty;
    const struct image *from = layer ? &inspector->layers : renderer_sums(p->renderer);
    struct planes planes = { .scale =
                                 layer ? 1.0f : 1.0f / (float)renderer_sum_count(p->renderer) };
    planes.size = (size_t)from->width * from->height;
    for (uint32_t c = 0; c < (layer ? FRAME_LAYER_PLANES : 3) && which->planes[c]; c++) {
        planes.data[c] = image_find(from, which->planes[c]);
        if (!planes.data[c])
            break;
        planes.count++;
    }
    return planes;
}

static float one_value(const struct planes *planes, uint32_t channel, size_t i)
{
    float sum = 0.0f;
    if (channel && channel <= planes->count)
        return planes->data[channel - 1][i] * planes->scale;
    for (uint32_t c = 0; c < planes->count; c++)
        sum += planes->data[c][i];
    return sum * planes->scale / (float)planes->count;
}

static bool is_value(float x)
{
    return isfinite(x) && x < 1e10f;
}

static void find_range(struct pixel_inspector *inspector, const struct planes *planes)
{
    inspector->min = INFINITY;
    inspector->max = -INFINITY;
    for (size_t i = 0; i < planes->size; i++) {
        const float x = one_value(planes, inspector->choice.channel, i);
        if (is_value(x)) {
            inspector->min = fminf(inspector->min, x);
            inspector->max = fmaxf(inspector->max, x);
        }
    }
    if (inspector->min > inspector->max)
        inspector->min = inspector->max = 0.0f;
}

/* Fills the histogram. The axis is in stops for the rendered image and linear for other layers. */
static void count_bins(struct pixel_inspector *inspector, const struct planes *planes)
{
    const bool is_log = !inspector->choice.layer;
    const float from = is_log ? darkest_stops : inspector->min;
    const float to = is_log ? brightest_stops : inspector->max;
    uint32_t below = 0;
    uint32_t above = 0;
    memset(inspector->bins, 0, sizeof(inspector->bins));
    for (size_t i = 0; i < planes->size; i++) {
        const float x = one_value(planes, inspector->choice.channel, i);
        const float at = is_log ? log2f(fmaxf(x, 1e-30f)) : x;
        const float part = to > from ? (at - from) / (to - from) : 0.0f;
        if (!is_value(x))
            continue;
        below += part < 0.0f;
        above += part > 1.0f;
        const float bin = fminf(fmaxf(part, 0.0f), 1.0f) * (PIXEL_INSPECTOR_BIN_COUNT - 1);
        inspector->bins[(uint32_t)(bin + 0.5f)]++;
    }
    inspector->below_fraction = planes->size ? (float)below / (float)planes->size : 0.0f;
    inspector->above_fraction = planes->size ? (float)above / (float)planes->size : 0.0f;
    if (is_log) {
        inspector->min = from;
        inspector->max = to;
    }
}

static uint8_t to_byte(float x)
{
    return (uint8_t)(fminf(fmaxf(x, 0.0f), 1.0f) * 255.0f + 0.5f);
}

static void write_color(const struct pixel_inspector *inspector, const struct planes *planes,
                        struct tonemap_params tonemap, size_t i, uint8_t rgb[static 3])
{
    const struct pixel_inspector_choice *c = &inspector->choice;
    vec3s linear;
    if (c->layer)
        tonemap = (struct tonemap_params){ 1.0f, TONEMAP_CLIP };
    tonemap.gain *= exp2f(c->stops);
    for (uint32_t k = 0; k < 3; k++)
        linear.raw[k] = c->channel ? one_value(planes, c->channel, i)
                                   : planes->data[k % planes->count][i] * planes->scale;
    const vec3s shown = tonemap_encode(linear, tonemap);
    for (uint32_t k = 0; k < 3; k++)
        rgb[k] = to_byte(shown.raw[k]);
}

/* Writes the grey value or false colour of one pixel. */
static void write_value(const struct pixel_inspector *inspector, const struct planes *planes,
                        float min, float max, size_t i, uint8_t rgb[static 3])
{
    const float x = one_value(planes, inspector->choice.channel, i);
    const float width = max - min;
    const float part = width > 0.0f ? (x - min) / width : 0.0f;
    if (!is_value(x))
        memset(rgb, 0, 3);
    else if (inspector->choice.false_color)
        heat_map_srgb(part, rgb);
    else
        memset(rgb, to_byte(part), 3);
}

static bool shows_colors(const struct pixel_inspector_choice *c)
{
    return !c->false_color &&
           (!c->layer || pixel_inspector_layer(c->layer)->shown == FRAME_SHOWN_COLOR);
}

static uint8_t *make_rgba(struct pixel_inspector *inspector, const struct viewport *p,
                          const struct planes *planes)
{
    const struct pixel_inspector_choice *c = &inspector->choice;
    const struct tonemap_params tonemap = tonemap_params_of(&p->state.scene.settings);
    uint8_t *rgba = NULL;
    if (c->layer && !c->channel && !c->false_color && !shows_colors(c)) {
        const bool ok = layer_image_show(&inspector->layers, pixel_inspector_layer(c->layer),
                                         &p->state.scene.settings, NULL, &rgba, NULL);
        return ok ? rgba : NULL;
    }
    rgba = malloc(planes->size * 4);
    for (size_t i = 0; i < planes->size && rgba; i++) {
        if (shows_colors(c))
            write_color(inspector, planes, tonemap, i, &rgba[i * 4]);
        else
            write_value(inspector, planes, inspector->min, inspector->max, i, &rgba[i * 4]);
        rgba[i * 4 + 3] = 255;
    }
    if (!rgba)
        (void)log_out_of_memory(NULL);
    return rgba;
}

enum status pixel_inspector_show(struct pixel_inspector *inspector, const struct viewport *p,
                                 uint32_t sample_count)
{
    const struct planes planes = open_planes(inspector, p, inspector->choice.layer);
    forget(inspector, p->gpu);
    inspector->sample_count = sample_count;
    if (!planes.count)
        return STATUS_OK; /* the image lacks this layer */
    find_range(inspector, &planes);
    inspector->shown_min = inspector->min;
    inspector->shown_max = inspector->max;
    if (pixel_inspector_replaces_image(&inspector->choice)) {
        inspector->rgba = make_rgba(inspector, p, &planes);
        if (!inspector->rgba)
            return STATUS_TRY_AGAIN;
    }
    count_bins(inspector, &planes);
    if (!inspector->rgba)
        return STATUS_OK;
    const struct gpu_image_params params = {
        .name = "inspector",
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .width = p->state.width,
        .height = p->state.height,
        .texels = inspector->rgba,
        .texels_size = planes.size * 4,
    };
    return gpu_image_create(p->gpu, &inspector->image, &params);
}

static uint32_t take(const struct image *image, const struct frame_layer *layer, size_t i,
                     float *values, uint32_t most)
{
    uint32_t count = 0;
    while (layer && count < most && layer->planes[count]) {
        const float *plane = image_find(image, layer->planes[count]);
        if (!plane)
            break;
        values[count++] = plane[i];
    }
    return count;
}

/* Finds an object's name in `names`, whose lines are "NUMBER NAME". If missing, `name` is "". */
static void find_name(const char *names, uint32_t number, char *name, size_t size)
{
    const char *line = names;
    *name = '\0';
    while (line && *line) {
        char *after;
        const unsigned long found = strtoul(line, &after, 10);
        const char *end = strchr(line, '\n');
        const int length = end ? (int)(end - after) : (int)strlen(after);
        if (found == number && length > 1)
            snprintf(name, size, "%.*s", length - 1, after + 1);
        line = end ? end + 1 : NULL;
    }
}

bool pixel_inspector_values(const struct pixel_inspector *inspector, const struct viewport *p,
                            uint32_t x, uint32_t y, struct pixel_inspector_values *v)
{
    const struct image *layers = &inspector->layers;
    const struct image *sums = p->renderer ? renderer_sums(p->renderer) : NULL;
    const size_t i = (size_t)y * layers->width + x;
    float object = 0.0f;
    if (x >= layers->width || y >= layers->height || !inspector->sample_count || !sums ||
        sums->width != layers->width || sums->height != layers->height)
        return false;
    *v = (struct pixel_inspector_values){ 0 };
    take(sums, &frame_beauty, i, v->color, 4);
    for (size_t c = 0; c < 4; c++)
        v->color[c] /= (float)renderer_sum_count(p->renderer);
    take(layers, layer_image_find("P"), i, v->position, 3);
    take(layers, layer_image_find("N"), i, v->normal, 3);
    take(layers, layer_image_find("Z"), i, &v->distance, 1);
    take(layers, layer_image_find("object"), i, &object, 1);
    v->object = object > 0.0f ? (uint32_t)(object + 0.5f) : 0;
    v->layer_count = take(layers, pixel_inspector_layer(inspector->choice.layer), i, v->layer,
                          FRAME_LAYER_PLANES);
    find_name(inspector->names, v->object, v->name, sizeof(v->name));
    if (inspector->rgba) {
        memcpy(v->shown, &inspector->rgba[i * 4], 3);
        return true;
    }
    float mean[4];
    renderer_display_pixel(p->renderer, i, mean);
    const vec3s shown = tonemap_encode((vec3s){ { mean[0], mean[1], mean[2] } },
                                       tonemap_params_of(&p->state.scene.settings));
    for (size_t c = 0; c < 3; c++)
        v->shown[c] = to_byte(shown.raw[c]);
    return true;
}
