/* json_write.c: writes profiles as JSON. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/profile/json.h"
#include "src/lab/profile/json_key_tables.h"
#include "src/lab/profile/row_aggregation.h"
#include "src/lab/profile/statistics.h"
#include "src/lab/profile/utf8_text.h"

/* Key, offset and size of a struct member, for initialisers of struct profile_field. */
#define KEY(key, object, member) \
    key, offsetof(struct object, member), sizeof(((struct object *)0)->member)
#define AT(object, member) KEY(#member, object, member)
#define FIELDS(table) \
    { \
        (table), sizeof(table) / sizeof((table)[0]) \
    }

static const struct profile_field of_profile[] = {
    { PROFILE_FIELD_HEAP, AT(profile, command) },
    { PROFILE_FIELD_HEAP, AT(profile, scene) },
    { PROFILE_FIELD_TEXT, KEY("rung", profile, refraction) },
    { PROFILE_FIELD_TEXT, AT(profile, material) },
    { PROFILE_FIELD_U32, AT(profile, width) },
    { PROFILE_FIELD_U32, AT(profile, height) },
    { PROFILE_FIELD_TEXT, AT(profile, device) },
    { PROFILE_FIELD_TEXT, AT(profile, driver) },
    { PROFILE_FIELD_TEXT, AT(profile, host) },
    { PROFILE_FIELD_TEXT, AT(profile, clock) },
    { PROFILE_FIELD_BOOL, AT(profile, has_statistics) },
    { PROFILE_FIELD_U32, AT(profile, warmup) },
    { PROFILE_FIELD_U32, AT(profile, run_count) },
    { PROFILE_FIELD_DOUBLE, AT(profile, time) },
    { PROFILE_FIELD_DOUBLE, AT(profile, time_step) },
    { PROFILE_FIELD_DOUBLE, KEY("tree", profile, bvh_ms), .is_optional = true },
    { PROFILE_FIELD_U32, KEY("tree_triangles", profile, bvh_triangles), .is_optional = true },
    { PROFILE_FIELD_U64, KEY("tree_size", profile, bvh_size), .is_optional = true },
    { PROFILE_FIELD_DOUBLE, AT(profile, rays), .is_optional = true },
    { PROFILE_FIELD_U64, AT(profile, rays_size), .is_optional = true },
    { PROFILE_FIELD_DOUBLE, AT(profile, upload) },
    { PROFILE_FIELD_DOUBLE, AT(profile, compile) },
    { PROFILE_FIELD_DOUBLE, AT(profile, realise) },
    { PROFILE_FIELD_DOUBLE, AT(profile, first_frame) },
    { PROFILE_FIELD_U64, AT(profile, memory_used) },
    { PROFILE_FIELD_U64, AT(profile, memory_without_aliasing) },
    { PROFILE_FIELD_U64, AT(profile, memory_bound) },
    { PROFILE_FIELD_U64, AT(profile, memory_persistent) },
    { PROFILE_FIELD_U32, AT(profile, pass_count) },
};

static const struct profile_field of_setting[] = {
    { PROFILE_FIELD_TEXT, AT(profile_setting, name) },
    { PROFILE_FIELD_TEXT, AT(profile_setting, value) },
};

static const struct profile_field of_resident[] = {
    { PROFILE_FIELD_TEXT, AT(profile_resource, name) },
    { PROFILE_FIELD_U32, AT(profile_resource, first_pass) },
    { PROFILE_FIELD_U32, AT(profile_resource, last_pass) },
    { PROFILE_FIELD_U32, AT(profile_resource, block) },
    { PROFILE_FIELD_U64, AT(profile_resource, offset) },
    { PROFILE_FIELD_U64, AT(profile_resource, size) },
};

static const struct profile_field of_row[] = {
    { PROFILE_FIELD_TEXT, AT(profile_row, name) },
    { PROFILE_FIELD_TEXT, AT(profile_row, technique) },
    { PROFILE_FIELD_ROW_KIND, AT(profile_row, kind) },
    { PROFILE_FIELD_U32, AT(profile_row, repetition) },
    { PROFILE_FIELD_U32, AT(profile_row, repetition_count) },
    { PROFILE_FIELD_U32, AT(profile_row, width) },
    { PROFILE_FIELD_U32, AT(profile_row, height) },
    { PROFILE_FIELD_U64, AT(profile_row, target_bytes) },
    { PROFILE_FIELD_U64, AT(profile_row, vertices) },
    { PROFILE_FIELD_U64, AT(profile_row, triangles) },
    { PROFILE_FIELD_U64, AT(profile_row, fragments) },
    { PROFILE_FIELD_U64, AT(profile_row, invocations) },
    { PROFILE_FIELD_U64, AT(profile_row, covered) },
};

const struct profile_fields profile_fields = FIELDS(of_profile);
const struct profile_fields profile_setting_fields = FIELDS(of_setting);
const struct profile_fields profile_resource_fields = FIELDS(of_resident);
const struct profile_fields profile_row_fields = FIELDS(of_row);

const char *const profile_kind_names[PROFILE_KIND_COUNT] = {
    [PROFILE_RASTER] = "raster", [PROFILE_COMPUTE] = "compute",   [PROFILE_TRANSFER] = "transfer",
    [PROFILE_HOST] = "host",     [PROFILE_UNATTRIBUTED] = "rest",
};

json_t *profile_json_put(json_t *json, const char *key, json_t *value)
{
    /* jansson accepts NULL for object and value, and releases the value on failure. */
    const int result =
        key ? json_object_set_new(json, key, value) : json_array_append_new(json, value);
    return result == 0 ? value : NULL;
}

json_t *profile_json_string(const char *text)
{
    char *clean = strdup(text);
    if (!clean)
        return NULL;
    profile_clean_text(clean);
    json_t *string = json_string(clean);
    free(clean);
    return string;
}

static json_t *make_value(const struct profile_field *field, const void *object)
{
    const void *at = (const char *)object + field->offset;
    switch (field->kind) {
    case PROFILE_FIELD_HEAP:
        return profile_json_string(*(char *const *)at ? *(char *const *)at : "");
    case PROFILE_FIELD_TEXT:
        return profile_json_string(at);
    case PROFILE_FIELD_U32:
        return json_integer(*(const uint32_t *)at);
    case PROFILE_FIELD_U64:
        return json_integer((json_int_t)(*(const uint64_t *)at));
    case PROFILE_FIELD_DOUBLE:
        return json_real(*(const double *)at);
    case PROFILE_FIELD_BOOL:
        return json_boolean(*(const bool *)at);
    case PROFILE_FIELD_ROW_KIND:
        return json_string(profile_kind_names[*(const enum profile_kind *)at]);
    }
    return NULL;
}

static bool add_fields(json_t *json, const struct profile_fields *fields, const void *object)
{
    bool ok = true;
    for (uint32_t i = 0; i < fields->count; i++) {
        const struct profile_field *field = &fields->fields[i];
        ok = profile_json_put(json, field->key, make_value(field, object)) && ok;
    }
    return ok;
}

static bool add_numbers(json_t *json, const char *key, const double *numbers, uint32_t count)
{
    json_t *array = profile_json_put(json, key, json_array());
    bool ok = array;
    for (uint32_t i = 0; i < count; i++)
        ok = profile_json_put(array, NULL, json_real(numbers[i])) && ok;
    return ok;
}

static bool add_outliers(json_t *json, const double *samples, uint32_t count)
{
    json_t *array = profile_json_put(json, "outliers", json_array());
    const struct profile_fences fences = profile_fences(samples, count);
    bool ok = array;
    for (uint32_t i = 0; i < count; i++)
        if (samples[i] < fences.low || samples[i] > fences.high)
            ok = profile_json_put(array, NULL, json_integer(i)) && ok;
    return ok;
}

static bool add_summary(json_t *json, const double *samples, const struct profile *p)
{
    const struct profile_summary of_frame = profile_summarize(p->frame, p->run_count);
    const struct profile_summary summary = profile_summarize(samples, p->run_count);

    const struct {
        const char *key;
        double value;
    } numbers[] = {
        { "mean", summary.mean },
        { "sigma", summary.sigma },
        { "min", summary.min },
        { "median", summary.median },
        { "p95", summary.p95 },
        { "max", summary.max },
        { "share", of_frame.mean > 0 ? summary.mean / of_frame.mean : 0 },
    };

    json_t *object = profile_json_put(json, "summary", json_object());
    bool ok = object;
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++)
        ok = profile_json_put(object, numbers[i].key, json_real(numbers[i].value)) && ok;
    return ok && add_outliers(object, samples, p->run_count);
}

static bool add_samples(json_t *json, const double *samples, const struct profile *p,
                        bool with_samples)
{
    return add_summary(json, samples, p) &&
           (!with_samples || add_numbers(json, "ms", samples, p->run_count));
}

static bool add_settings(json_t *json, const struct profile *p)
{
    json_t *array = profile_json_put(json, "settings", json_array());
    bool ok = array;
    for (uint32_t i = 0; i < p->setting_count; i++) {
        json_t *object = profile_json_put(array, NULL, json_object());
        ok = add_fields(object, &profile_setting_fields, &p->settings[i]) && ok;
    }
    return ok;
}

static bool add_residents(json_t *json, const struct profile *p)
{
    json_t *array = profile_json_put(json, "residents", json_array());
    bool ok = array;
    for (uint32_t i = 0; i < p->resident_count; i++) {
        json_t *object = profile_json_put(array, NULL, json_object());
        ok = add_fields(object, &profile_resource_fields, &p->residents[i]) && ok;
    }
    return ok;
}

static bool add_rows(json_t *json, const struct profile *p, bool with_samples)
{
    json_t *array = profile_json_put(json, "rows", json_array());
    bool ok = array;
    for (uint32_t i = 0; i < p->row_count && ok; i++) {
        const struct profile_row *row = &p->rows[i];
        json_t *object = profile_json_put(array, NULL, json_object());
        ok = add_fields(object, &profile_row_fields, row) &&
             add_samples(object, row->ms, p, with_samples) &&
             (!with_samples || (add_numbers(object, "begin_ms", row->begin_ms, p->run_count) &&
                                add_numbers(object, "record_ms", row->record_ms, p->run_count)));
    }
    return ok;
}

bool profile_json_add_all(json_t *json, const struct profile *p, bool with_samples)
{
    const struct {
        const char *key;
        const double *samples;
    } whole[] = {
        { "frame", p->frame },
        { "plain", p->plain },
        { "wait", p->wait },
    };

    bool ok = add_fields(json, &profile_fields, p);
    if (with_samples)
        ok = ok && add_settings(json, p) && add_residents(json, p);
    ok = ok && add_rows(json, p, with_samples);
    for (size_t i = 0; i < sizeof(whole) / sizeof(whole[0]); i++) {
        json_t *object = profile_json_put(json, whole[i].key, json_object());
        ok = ok && add_samples(object, whole[i].samples, p, with_samples);
    }
    return ok && profile_json_put(json, "overhead", json_real(profile_overhead(p)));
}

enum status profile_json_end(json_t *root, bool is_whole, size_t digits, char **text, size_t *size)
{
    char *line = is_whole ? json_dumps(root, JSON_COMPACT | JSON_REAL_PRECISION(digits)) : NULL;
    *size = line ? strlen(line) + 1 : 0;
    *text = line ? realloc(line, *size + 1) : NULL;
    json_decref(root);
    if (*text) {
        memcpy(*text + *size - 1, "\n", 2);
        return STATUS_OK;
    }
    free(line);
    *size = 0;
    return log_out_of_memory(NULL);
}

enum status profile_write_json(const struct profile *p, char **text, size_t *size)
{
    json_t *root = json_object();
    const bool ok = profile_json_put(root, "format", json_integer(PROFILE_JSON_FORMAT)) &&
                    profile_json_put(root, "type", json_string("profile")) &&
                    profile_json_add_all(root, p, true);
    return profile_json_end(root, ok, PROFILE_JSON_DIGITS, text, size);
}
