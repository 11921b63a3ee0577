/* gltf_json.c: typed access to a glTF file's JSON values, whose locations are kept for messages. */
#include <math.h>
#include <stdarg.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/gltf/gltf.h"

enum status gltf_fault(const struct gltf_object *object, const char *format, ...)
{
    char text[512];
    va_list arguments;
    if (object->gltf->status != STATUS_OK)
        return object->gltf->status;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    const char *separator = object->location[0] ? ": " : "";
    if (object->gltf->attempt)
        model_loss_add(object->gltf->attempt, "%s%s%s", object->location, separator, text);
    else
        log_error("%s: %s%s%s", object->gltf->path, object->location, separator, text);
    object->gltf->status = STATUS_DATA;
    return STATUS_DATA;
}

void gltf_attempt_begin(struct gltf *gltf, struct model_loss *loss)
{
    gltf->attempt = gltf->status == STATUS_OK ? loss : NULL;
}

bool gltf_attempt_end(struct gltf *gltf)
{
    const bool has_succeeded = gltf->status == STATUS_OK;
    if (gltf->attempt && gltf->status == STATUS_DATA)
        gltf->status = STATUS_OK;
    gltf->attempt = NULL;
    return has_succeeded;
}

enum status gltf_out_of_memory(struct gltf *gltf)
{
    if (gltf->status == STATUS_OK)
        gltf->status = log_out_of_memory(gltf->path);
    return gltf->status;
}

struct gltf_object gltf_top(struct gltf *gltf)
{
    return (struct gltf_object){ .gltf = gltf, .json = gltf->root };
}

static const json_t *get(const struct gltf_object *object, const char *key)
{
    return json_object_get(object->json, key);
}

/* Wraps the JSON value at outer.key[index], or at outer.key if `index` is gltf_none. */
static struct gltf_object wrap_object(const struct gltf_object *outer, const json_t *json,
                                      const char *key, uint32_t index)
{
    struct gltf_object inner = { .gltf = outer->gltf, .json = json };
    const char *dot = outer->location[0] ? "." : "";
    char number[16] = "";
    if (index != gltf_none)
        (void)snprintf(number, sizeof(number), "[%u]", index);
    const int length = snprintf(inner.location, sizeof(inner.location), "%s%s%s%s", outer->location,
                                dot, key, number);
    if (length >= (int)sizeof(inner.location)) /* truncated; known keys are shorter */
        memcpy(&inner.location[sizeof(inner.location) - 4], "...", 4);
    if (json && !json_is_object(json)) {
        (void)gltf_fault(&inner, "expected an object");
        inner.json = NULL;
    }
    return inner;
}

struct gltf_object gltf_member(const struct gltf_object *object, const char *key)
{
    return wrap_object(object, get(object, key), key, gltf_none);
}

struct gltf_object gltf_extension(const struct gltf_object *object, const char *name)
{
    const struct gltf_object extensions = gltf_member(object, "extensions");
    return wrap_object(object, get(&extensions, name), name, gltf_none);
}

struct gltf_object gltf_item(const struct gltf_object *object, const char *key, uint32_t index)
{
    return wrap_object(object, json_array_get(get(object, key), index), key, index);
}

struct gltf_object gltf_element(struct gltf *gltf, const char *list, uint32_t index)
{
    const struct gltf_object top = gltf_top(gltf);
    return gltf_item(&top, list, index);
}

uint32_t gltf_length(const struct gltf_object *object, const char *key)
{
    const json_t *list = get(object, key);
    if (!list)
        return 0;
    if (json_is_array(list) && json_array_size(list) <= MODEL_NODE_MAX)
        return (uint32_t)json_array_size(list);
    (void)gltf_fault(object, "%s: expected an array of at most %d elements", key, MODEL_NODE_MAX);
    return 0;
}

uint32_t gltf_list_length(struct gltf *gltf, const char *list)
{
    const struct gltf_object top = gltf_top(gltf);
    return gltf_length(&top, list);
}

/* Reads a finite float. Returns false if the value is not a number or too large for a float. */
static bool read_float(const json_t *value, float *number)
{
    *number = (float)json_number_value(value);
    return json_is_number(value) && isfinite(*number);
}

float gltf_number(const struct gltf_object *object, const char *key, float fallback)
{
    const json_t *value = get(object, key);
    float number;
    if (!value)
        return fallback;
    if (read_float(value, &number))
        return number;
    (void)gltf_fault(object, "%s: expected a number", key);
    return fallback;
}

bool gltf_flag(const struct gltf_object *object, const char *key)
{
    const json_t *value = get(object, key);
    if (value && !json_is_boolean(value))
        (void)gltf_fault(object, "%s: expected true or false", key);
    return json_is_true(value);
}

/* Reads a non-negative integer, such as 3 or 3.0. Returns false for other values. */
static bool read_count(const json_t *value, uint64_t *count)
{
    const double max = 9007199254740992; /* 2^53: all integers below are exact */
    const double number = json_number_value(value);
    *count = number >= 0 && number <= max ? (uint64_t)number : 0;
    return json_is_number(value) && number >= 0 && number <= max && !((double)*count < number);
}

uint64_t gltf_count(const struct gltf_object *object, const char *key, uint64_t fallback)
{
    const json_t *value = get(object, key);
    if (!value)
        return fallback;
    uint64_t count;
    if (read_count(value, &count))
        return count;
    (void)gltf_fault(object, "%s: expected a non-negative integer", key);
    return fallback;
}

const char *gltf_string(const struct gltf_object *object, const char *key, const char *fallback)
{
    const json_t *value = get(object, key);
    if (!value)
        return fallback;
    if (json_is_string(value))
        return json_string_value(value);
    (void)gltf_fault(object, "%s: expected a string", key);
    return fallback;
}

static uint32_t read_index(const struct gltf_object *object, const char *key, const json_t *value,
                           const char *list)
{
    const uint32_t count = gltf_list_length(object->gltf, list);
    uint64_t index;
    if (!read_count(value, &index)) {
        (void)gltf_fault(object, "%s: expected an index", key);
        return gltf_none;
    }
    if (index < count)
        return (uint32_t)index;
    (void)gltf_fault(object, "%s: %s[%llu] does not exist", key, list, (unsigned long long)index);
    return gltf_none;
}

uint32_t gltf_index(const struct gltf_object *object, const char *key, const char *list)
{
    const json_t *value = get(object, key);
    return value ? read_index(object, key, value, list) : gltf_none;
}

uint32_t gltf_index_at(const struct gltf_object *object, const char *key, uint32_t index,
                       const char *list)
{
    return read_index(object, key, json_array_get(get(object, key), index), list);
}

/* Returns a member that is an array of `count` numbers, each in the range of a float. Returns NULL
 * if it is absent, or invalid, which is a fault. */
static const json_t *find_numbers(const struct gltf_object *object, const char *key, uint32_t count)
{
    const json_t *list = get(object, key);
    float number;
    if (!list)
        return NULL;
    bool is_valid = json_is_array(list) && json_array_size(list) == count;
    for (uint32_t i = 0; is_valid && i < count; i++)
        is_valid = read_float(json_array_get(list, i), &number);
    if (!is_valid)
        (void)gltf_fault(object, "%s: expected %u numbers", key, count);
    return is_valid ? list : NULL;
}

bool gltf_floats(const struct gltf_object *object, const char *key, float *numbers, uint32_t count)
{
    const json_t *list = find_numbers(object, key, count);
    for (uint32_t i = 0; list && i < count; i++)
        numbers[i] = (float)json_number_value(json_array_get(list, i));
    return list;
}

bool gltf_doubles(const struct gltf_object *object, const char *key, double *numbers,
                  uint32_t count)
{
    const json_t *list = find_numbers(object, key, count);
    for (uint32_t i = 0; list && i < count; i++)
        numbers[i] = json_number_value(json_array_get(list, i));
    return list;
}
