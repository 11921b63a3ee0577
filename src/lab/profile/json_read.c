/* json_read.c: reads and validates profiles from untrusted JSON. */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/lab/profile/json.h"
#include "src/lab/profile/json_key_tables.h"

enum {
    MAX_FILE_SIZE = 64 * 1024 * 1024, /* jansson needs 20 times as much */
    JSON_PATH_SIZE = 64
};

static const double max_number = 1e8; /* 27 hours in ms */

/* File being read. `json_path` is the JSON path for messages: "rows[3]", or "" at top level. */
struct reader {
    const char *path;
    char json_path[JSON_PATH_SIZE];
};

static enum status fault(const struct reader *reader, const char *key, const char *what)
{
    log_error("%s: \"%s%s%s\" %s; write the profile again with --json", reader->path,
              reader->json_path, reader->json_path[0] ? "." : "", key, what);
    return STATUS_DATA;
}

static enum status no_memory(const struct reader *reader)
{
    return log_out_of_memory(reader->path);
}

static bool is_number(const json_t *value)
{
    return json_is_number(value) && fabs(json_number_value(value)) <= max_number;
}

/* Returns an error message if a JSON value is invalid for a field, else NULL. */
static const char *find_fault(const struct profile_field *field, const json_t *value)
{
    const json_int_t max = field->kind == PROFILE_FIELD_U32 ? UINT32_MAX : INT64_MAX;

    switch (field->kind) {
    case PROFILE_FIELD_TEXT:
        if (json_is_string(value) && json_string_length(value) >= field->size)
            return "is too long";
        return json_is_string(value) ? NULL : "is not a string";
    case PROFILE_FIELD_HEAP:
    case PROFILE_FIELD_ROW_KIND:
        return json_is_string(value) ? NULL : "is not a string";
    case PROFILE_FIELD_U32:
    case PROFILE_FIELD_U64:
        if (!json_is_integer(value))
            return "is not a whole number";
        return json_integer_value(value) >= 0 && json_integer_value(value) <= max
                   ? NULL
                   : "is out of range";
    case PROFILE_FIELD_DOUBLE:
        return is_number(value) ? NULL : "is not a number from -1e8 to 1e8";
    case PROFILE_FIELD_BOOL:
        return json_is_boolean(value) ? NULL : "is neither true nor false";
    }
    return NULL;
}

static bool find_kind(const char *name, enum profile_kind *kind)
{
    for (int i = 0; i < PROFILE_KIND_COUNT; i++) {
        if (strcmp(name, profile_kind_names[i]) == 0) {
            *kind = (enum profile_kind)i;
            return true;
        }
    }
    return false;
}

/* Stores a value of the correct type. Returns false if out of memory or for an unknown row kind. */
static bool set_value(const struct profile_field *field, const json_t *value, void *object)
{
    void *at = (char *)object + field->offset;
    switch (field->kind) {
    case PROFILE_FIELD_HEAP:
        *(char **)at = strdup(json_string_value(value));
        return *(char **)at;
    case PROFILE_FIELD_TEXT:
        memcpy(at, json_string_value(value), json_string_length(value) + 1);
        return true;
    case PROFILE_FIELD_U32:
        *(uint32_t *)at = (uint32_t)json_integer_value(value);
        return true;
    case PROFILE_FIELD_U64:
        *(uint64_t *)at = (uint64_t)json_integer_value(value);
        return true;
    case PROFILE_FIELD_DOUBLE:
        *(double *)at = json_number_value(value);
        return true;
    case PROFILE_FIELD_BOOL:
        *(bool *)at = json_boolean_value(value);
        return true;
    case PROFILE_FIELD_ROW_KIND:
        return find_kind(json_string_value(value), at);
    }
    return false;
}

static enum status read_fields(const struct reader *reader, const json_t *json,
                               const struct profile_fields *fields, void *object)
{
    for (uint32_t i = 0; i < fields->count; i++) {
        const struct profile_field *field = &fields->fields[i];
        const json_t *value = json_object_get(json, field->key);
        if (!value && field->is_optional)
            continue;
        if (!value)
            return fault(reader, field->key, "is missing");
        const char *what = find_fault(field, value);
        if (what)
            return fault(reader, field->key, what);
        if (set_value(field, value, object))
            continue;
        return field->kind == PROFILE_FIELD_HEAP
                   ? no_memory(reader)
                   : fault(reader, field->key, "is not a kind of row");
    }
    return STATUS_OK;
}

/* Reads an array of exactly `count` numbers into `samples`. */
static enum status read_samples(const struct reader *reader, const json_t *json, const char *key,
                                double *samples, uint32_t count)
{
    const json_t *array = json_object_get(json, key);
    if (!json_is_array(array))
        return fault(reader, key, "is not an array");
    if (json_array_size(array) != count)
        return fault(reader, key, "does not have one number per run");
    for (uint32_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(array, i);
        if (!is_number(number))
            return fault(reader, key, "has an element that is not a number from -1e8 to 1e8");
        samples[i] = json_number_value(number);
    }
    return STATUS_OK;
}

/* Finds a JSON array of objects and allocates *elements, one zeroed struct per object. */
static enum status read_array(const struct reader *reader, const json_t *root, const char *key,
                              uint32_t *count, void **elements, size_t element_size)
{
    const json_t *array = json_object_get(root, key);
    if (!json_is_array(array))
        return fault(reader, key, "is not an array");
    *elements = calloc(json_array_size(array) + 1, element_size);
    if (!*elements)
        return no_memory(reader);
    *count = (uint32_t)json_array_size(array); /* cannot overflow: file size is limited */
    return STATUS_OK;
}

static enum status read_settings(struct reader *reader, const json_t *root, struct profile *p)
{
    void *elements = NULL;
    enum status status =
        read_array(reader, root, "settings", &p->setting_count, &elements, sizeof(*p->settings));
    p->settings = elements;
    for (uint32_t i = 0; i < p->setting_count && status == STATUS_OK; i++) {
        snprintf(reader->json_path, JSON_PATH_SIZE, "settings[%" PRIu32 "]", i);
        status = read_fields(reader, json_array_get(json_object_get(root, "settings"), i),
                             &profile_setting_fields, &p->settings[i]);
    }
    reader->json_path[0] = '\0';
    return status;
}

static enum status read_residents(struct reader *reader, const json_t *root, struct profile *p)
{
    void *elements = NULL;
    enum status status =
        read_array(reader, root, "residents", &p->resident_count, &elements, sizeof(*p->residents));
    p->residents = elements;
    for (uint32_t i = 0; i < p->resident_count && status == STATUS_OK; i++) {
        struct profile_resource *resident = &p->residents[i];
        snprintf(reader->json_path, JSON_PATH_SIZE, "residents[%" PRIu32 "]", i);
        status = read_fields(reader, json_array_get(json_object_get(root, "residents"), i),
                             &profile_resource_fields, resident);
        if (status == STATUS_OK &&
            (resident->last_pass >= p->pass_count || resident->first_pass > resident->last_pass))
            status = fault(reader, "last_pass", "is not a pass at or after first_pass");
    }
    reader->json_path[0] = '\0';
    return status;
}

/* Checks the declared numbers of rows and samples before allocating memory for them. */
static enum status check_counts(const struct reader *reader, const json_t *root,
                                const struct profile *p)
{
    const json_t *rows = json_object_get(root, "rows");
    if (p->run_count == 0)
        return fault(reader, "run_count", "is 0");
    if (p->width == 0 || p->height == 0)
        return fault(reader, p->width ? "height" : "width", "is 0");
    if (!json_is_array(rows))
        return fault(reader, "rows", "is not an array");
    if (json_array_size(rows) <= p->pass_count)
        return fault(reader, "rows", "has fewer elements than pass_count");
    for (size_t i = 0; i < json_array_size(rows); i++)
        if (json_array_size(json_object_get(json_array_get(rows, i), "ms")) != p->run_count)
            return fault(reader, "run_count", "differs from the number of samples of a row");
    return STATUS_OK;
}

static bool is_pass(const struct profile_row *row)
{
    return row->kind < PROFILE_HOST;
}

static enum status read_row(const struct reader *reader, const json_t *json,
                            const struct profile *p, uint32_t index)
{
    struct profile_row *row = &p->rows[index];
    const struct profile_row expected = *row; /* name and kind of non-pass rows */
    enum status status = read_fields(reader, json, &profile_row_fields, row);
    if (status == STATUS_OK)
        status = read_samples(reader, json, "ms", row->ms, p->run_count);
    if (status == STATUS_OK)
        status = read_samples(reader, json, "begin_ms", row->begin_ms, p->run_count);
    if (status == STATUS_OK)
        status = read_samples(reader, json, "record_ms", row->record_ms, p->run_count);
    if (status != STATUS_OK)
        return status;
    if (row->repetition >= row->repetition_count)
        return fault(reader, "repetition", "is not below repetition_count");
    if (index < p->pass_count)
        return is_pass(row) ? STATUS_OK : fault(reader, "kind", "is not a kind of pass");
    return row->kind == expected.kind && strcmp(row->name, expected.name) == 0
               ? STATUS_OK
               : fault(reader, "name",
                       "is out of order: expected record, submit, unattributed at the end");
}

/* Checks that each run's rows add up to its frame time, apart from rounding. */
static enum status check_sums(const struct reader *reader, const struct profile *p)
{
    for (uint32_t run = 0; run < p->run_count; run++) {
        double sum = 0, size = 0;
        for (uint32_t i = 0; i < p->row_count; i++) {
            sum += p->rows[i].ms[run];
            size += fabs(p->rows[i].ms[run]);
        }
        if (!(fabs(sum - p->frame[run]) <= 1e-6 * (size + 1)))
            return fault(reader, "frame", "is not the sum of the rows");
    }
    return STATUS_OK;
}

static enum status read_rows(struct reader *reader, const json_t *root, struct profile *p)
{
    const json_t *rows = json_object_get(root, "rows");

    const struct {
        const char *key;
        double *samples;
    } whole[] = {
        { "frame", p->frame },
        { "plain", p->plain },
        { "wait", p->wait },
    };
    enum status status = STATUS_OK;

    if (json_array_size(rows) != p->row_count)
        return fault(reader, "rows", "does not have pass_count + 3 elements");
    for (uint32_t i = 0; i < p->row_count && status == STATUS_OK; i++) {
        snprintf(reader->json_path, JSON_PATH_SIZE, "rows[%" PRIu32 "]", i);
        status = read_row(reader, json_array_get(rows, i), p, i);
    }
    for (size_t i = 0; i < sizeof(whole) / sizeof(whole[0]) && status == STATUS_OK; i++) {
        snprintf(reader->json_path, JSON_PATH_SIZE, "%s", whole[i].key);
        status = read_samples(reader, json_object_get(root, whole[i].key), "ms", whole[i].samples,
                              p->run_count);
    }
    reader->json_path[0] = '\0';
    return status == STATUS_OK ? check_sums(reader, p) : status;
}

/* Checks that the file is a profile of the supported format. */
static enum status check_type(const struct reader *reader, const json_t *root)
{
    const char *type = json_string_value(json_object_get(root, "type"));
    if (!type || strcmp(type, "profile") != 0)
        return fault(reader, "type", "is not \"profile\"");
    if (json_integer_value(json_object_get(root, "format")) != PROFILE_JSON_FORMAT)
        return fault(reader, "format", "is not 2, the only supported format");
    return STATUS_OK;
}

static enum status read_profile(struct reader *reader, const json_t *root, struct profile *p)
{
    enum status status = check_type(reader, root);
    if (status == STATUS_OK)
        status = read_fields(reader, root, &profile_fields, p);
    if (status == STATUS_OK)
        status = check_counts(reader, root, p);
    if (status == STATUS_OK)
        status = read_settings(reader, root, p);
    if (status == STATUS_OK)
        status = read_residents(reader, root, p);
    if (status == STATUS_OK)
        status = profile_make_rows(p);
    if (status == STATUS_OK)
        status = read_rows(reader, root, p);
    return status;
}

static enum status load(const char *path, json_t **root)
{
    FILE *file = NULL;
    int64_t size = 0;
    json_error_t error;
    enum status status = file_io_open(path, &file, &size);
    *root = NULL;
    if (status != STATUS_OK)
        return status;
    if (size > MAX_FILE_SIZE) {
        fclose(file);
        log_error("%s: larger than %d MiB, so it is no profile of firn profile --json", path,
                  MAX_FILE_SIZE >> 20);
        return STATUS_DATA;
    }
    *root = json_loadf(file, JSON_REJECT_DUPLICATES, &error);
    if (ferror(file)) {
        log_error("%s: cannot be read: %s", path, strerror(EIO));
        status = STATUS_NO_INPUT;
    } else if (!*root) {
        log_error("%s:%d: invalid JSON: %s", path, error.line, error.text);
        status = STATUS_DATA;
    }
    fclose(file);
    return status;
}

enum status profile_read_json(const char *path, struct profile *p)
{
    struct reader reader = { .path = path };
    json_t *root = NULL;
    enum status status = load(path, &root);
    *p = (struct profile){ 0 };
    if (status == STATUS_OK)
        status = read_profile(&reader, root, p);
    json_decref(root);
    if (status != STATUS_OK)
        profile_finish(p);
    return status;
}
