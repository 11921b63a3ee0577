/* gltf_animation.c: interpolates animation keyframes (glTF 2.0, 3.11) and applies them to nodes. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/suggest.h"
#include "src/scene/import/gltf/gltf.h"

enum {
    WEIGHTS_MAX = 1024, /* maximum components of a keyframe */
};

enum interpolation {
    STEP,
    LINEAR,
    CUBIC,
};

/* Keyframes of an animation channel, of `width` numbers each, or 3 * width for cubic splines. */
struct keys {
    struct gltf_array times, values;
    enum interpolation interpolation;
    uint32_t width;
};

/* Position of a time between two keyframes. */
struct key_span {
    uint32_t before, after;
    float t;        /* 0 at `before`, 1 at `after` */
    float interval; /* seconds between both keyframes */
};

static struct key_span find_span(const struct gltf_array *times, float time)
{
    uint32_t after = 0;
    while (after < times->count && times->values[after] <= time)
        after++;
    if (after == 0 || after == times->count) {
        const uint32_t end = after == 0 ? 0 : times->count - 1;
        return (struct key_span){ end, end, 0, 0 };
    }
    const float interval = times->values[after] - times->values[after - 1];
    return (struct key_span){
        .before = after - 1,
        .after = after,
        .t = (time - times->values[after - 1]) / interval,
        .interval = interval,
    };
}

/* Returns component k of a cubic keyframe's in-tangent, value or out-tangent (third = 0, 1, 2). */
static float cubic_at(const struct keys *keys, uint32_t key, uint32_t third, uint32_t k)
{
    return keys->values.values[((size_t)3 * key + third) * keys->width + k];
}

static float cubic(const struct keys *keys, const struct key_span *at, uint32_t k)
{
    const float t = at->t;
    const float out = at->interval * cubic_at(keys, at->before, 2, k);
    const float in = at->interval * cubic_at(keys, at->after, 0, k);
    return (2 * t * t * t - 3 * t * t + 1) * cubic_at(keys, at->before, 1, k) +
           (t * t * t - 2 * t * t + t) * out +
           (-2 * t * t * t + 3 * t * t) * cubic_at(keys, at->after, 1, k) +
           (t * t * t - t * t) * in;
}

static void interpolate(const struct keys *keys, float time, bool is_rotation, float *to)
{
    const struct key_span at = find_span(&keys->times, time);
    const float t = keys->interpolation == LINEAR ? at.t : 0;
    const float *a = &keys->values.values[(size_t)at.before * keys->width];
    const float *b = &keys->values.values[(size_t)at.after * keys->width];
    if (is_rotation && keys->interpolation == LINEAR) {
        versors rotation_before, rotation_after;
        memcpy(&rotation_before, a, sizeof(rotation_before));
        memcpy(&rotation_after, b, sizeof(rotation_after));
        const versors rotation = glms_quat_slerp(rotation_before, rotation_after, t);
        memcpy(to, &rotation, sizeof(rotation));
        return;
    }
    for (uint32_t k = 0; k < keys->width; k++)
        to[k] = keys->interpolation == CUBIC ? cubic(keys, &at, k) : a[k] + t * (b[k] - a[k]);
}

static void read_interpolation(const struct gltf_object *sampler, struct keys *keys)
{
    const char *word = gltf_string(sampler, "interpolation", "LINEAR");
    keys->interpolation = strcmp(word, "STEP") == 0          ? STEP
                          : strcmp(word, "CUBICSPLINE") == 0 ? CUBIC
                                                             : LINEAR;
    if (keys->interpolation == LINEAR && strcmp(word, "LINEAR") != 0)
        (void)gltf_fault(sampler, "interpolation: expected LINEAR, STEP or CUBICSPLINE");
}

/* Removes the keyframes that a later one with an earlier time replaces, so that times ascend.
 * Keyframes of equal times stay: they are a step. Returns true if any time is repeated or
 * decreases. `width` is the count of a keyframe's numbers. */
static bool order_keys(struct gltf_array *times, float *values, size_t width)
{
    bool is_unordered = false;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < times->count; i++) {
        const float time = times->values[i];
        is_unordered |= kept > 0 && time <= times->values[kept - 1];
        while (kept > 0 && time < times->values[kept - 1])
            kept--;
        times->values[kept] = time;
        memmove(&values[kept * width], &values[i * width], width * sizeof(*values));
        kept++;
    }
    times->count = kept;
    return is_unordered;
}

/* Reads a sampler's keyframes, which must have `width` components unless `width` is 0. */
static bool read_keys(const struct gltf_object *sampler, uint32_t width, struct keys *keys)
{
    struct gltf *gltf = sampler->gltf;
    read_interpolation(sampler, keys);
    if (!gltf_read_floats(gltf, gltf_index(sampler, "input", "accessors"), &keys->times) ||
        !gltf_read_floats(gltf, gltf_index(sampler, "output", "accessors"), &keys->values))
        return false;
    const uint32_t thirds = keys->interpolation == CUBIC ? 3 : 1;
    const uint64_t numbers = (uint64_t)keys->values.count * keys->values.width;
    const uint64_t key_count = (uint64_t)keys->times.count * thirds;
    keys->width = (uint32_t)(numbers / key_count);
    for (uint32_t i = 0; i < keys->times.count; i++) {
        if (keys->times.width != 1 || !isfinite(keys->times.values[i]))
            (void)gltf_fault(sampler, "input: expected finite times");
    }
    for (size_t i = 0; i < numbers; i++) {
        if (!isfinite(keys->values.values[i]))
            (void)gltf_fault(sampler, "output: expected finite numbers");
    }
    if (keys->width == 0 || keys->width > WEIGHTS_MAX || numbers != keys->width * key_count ||
        (width > 0 && keys->width != width))
        (void)gltf_fault(sampler, "output: expected %u numbers per keyframe", width);
    if (gltf->status != STATUS_OK)
        return false;
    gltf->has_unordered_keys |=
        order_keys(&keys->times, keys->values.values, (size_t)keys->width * thirds);
    return true;
}

static void apply_keys(const struct gltf_object *channel, const struct keys *keys, const char *path,
                       float time)
{
    struct gltf *gltf = channel->gltf;
    const struct gltf_object target = gltf_member(channel, "target");
    struct gltf_node *node = &gltf->nodes[gltf_index(&target, "node", "nodes")];
    float numbers[WEIGHTS_MAX] = { 0 };
    const bool is_rotation = strcmp(path, "rotation") == 0;
    interpolate(keys, time, is_rotation, numbers);
    node->has_matrix = node->has_matrix && strcmp(path, "weights") == 0;
    if (is_rotation) {
        versors rotation;
        memcpy(&rotation, numbers, sizeof(rotation));
        rotation = glms_quat_normalize(rotation);
        for (int k = 0; k < 4; k++)
            node->rotation[k] = (double)rotation.raw[k];
    } else if (strcmp(path, "translation") == 0 || strcmp(path, "scale") == 0) {
        double *to = path[0] == 't' ? node->translation : node->scale;
        for (int k = 0; k < 3; k++)
            to[k] = (double)numbers[k];
    } else {
        const uint32_t count = keys->width < node->weight_count ? keys->width : node->weight_count;
        memcpy(node->weights, numbers, count * sizeof(*numbers));
    }
}

static void apply_channel(const struct gltf_object *animation, uint32_t index, float time)
{
    const struct gltf_object channel = gltf_item(animation, "channels", index);
    const struct gltf_object target = gltf_member(&channel, "target");
    const char *path = gltf_string(&target, "path", "");
    const uint32_t sampler_index = (uint32_t)gltf_count(&channel, "sampler", 0);
    const struct gltf_object sampler = gltf_item(animation, "samplers", sampler_index);
    const bool is_weights = strcmp(path, "weights") == 0;
    const uint32_t width = strcmp(path, "rotation") == 0 ? 4 : is_weights ? 0 : 3;
    struct keys keys = { 0 };
    if (gltf_index(&target, "node", "nodes") == gltf_none)
        return; /* unsupported target; gltf_warn() reports it */
    if (!is_weights && strcmp(path, "rotation") != 0 && strcmp(path, "translation") != 0 &&
        strcmp(path, "scale") != 0)
        (void)gltf_fault(&target, "path: expected translation, rotation, scale or weights");
    else if (read_keys(&sampler, width, &keys))
        apply_keys(&channel, &keys, path, time);
    free(keys.times.values);
    free(keys.values.values);
}

uint32_t gltf_animation_find(struct gltf *gltf, const char *name)
{
    const struct gltf_object top = gltf_top(gltf);
    const uint32_t count = gltf_list_length(gltf, "animations");
    struct suggest suggest = { .word = name };
    struct suggest_list list = { 0 };
    char hint[SUGGEST_HINT_SIZE];
    uint32_t number;
    for (uint32_t i = 0; i < count; i++) {
        const struct gltf_object animation = gltf_element(gltf, "animations", i);
        const char *known = gltf_string(&animation, "name", "");
        if (name[0] && strcmp(known, name) == 0)
            return i;
        suggest_offer(&suggest, known);
        suggest_list_add(&list, known);
    }
    if (suggest_number(name, count, &number))
        return number;
    (void)gltf_fault(&top, "no animation has the name or number '%.64s'%s; there are %u%s%s", name,
                     suggest_hint(&suggest, hint), count, count ? ": " : "", list.text);
    return gltf_none;
}

/* Returns the time of an animation's last keyframe in seconds, from the accessors' `max`. */
static float seconds_of(const struct gltf_object *animation)
{
    float seconds = 0;
    for (uint32_t i = 0; i < gltf_length(animation, "samplers"); i++) {
        const struct gltf_object sampler = gltf_item(animation, "samplers", i);
        const uint32_t input = gltf_index(&sampler, "input", "accessors");
        if (input == gltf_none)
            continue;
        const struct gltf_object accessor = gltf_element(animation->gltf, "accessors", input);
        const json_t *end = json_array_get(json_object_get(accessor.json, "max"), 0);
        seconds = fmaxf(seconds, (float)json_number_value(end));
    }
    return fminf(seconds, (float)MODEL_SECONDS_MAX);
}

enum status gltf_animations_read(struct gltf *gltf, struct model *model)
{
    const struct gltf_object top = gltf_top(gltf);
    const uint32_t count = gltf_list_length(gltf, "animations");
    if (count > MODEL_ANIMATION_MAX)
        return gltf_fault(&top, "expected at most %d animations, got %u", MODEL_ANIMATION_MAX,
                          count);
    model->animations = calloc(count + (size_t)1, sizeof(*model->animations));
    if (!model->animations)
        return gltf_out_of_memory(gltf);
    model->animation_count = count;
    model->animation = gltf->animation == gltf_none ? 0 : gltf->animation + 1;
    for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++) {
        const struct gltf_object object = gltf_element(gltf, "animations", i);
        struct model_animation *animation = &model->animations[i];
        gltf_attempt_begin(gltf, &gltf->import->channels);
        (void)snprintf(animation->name, sizeof(animation->name), "%s",
                       gltf_string(&object, "name", ""));
        animation->seconds = seconds_of(&object);
        (void)gltf_attempt_end(gltf);
    }
    return gltf->status;
}

void gltf_animate(struct gltf *gltf, uint32_t index, float time)
{
    const struct gltf_object animation = gltf_element(gltf, "animations", index);
    const uint32_t count = gltf_length(&animation, "channels");
    for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++) {
        gltf_attempt_begin(gltf, &gltf->import->channels);
        apply_channel(&animation, i, time);
        (void)gltf_attempt_end(gltf);
    }
}
