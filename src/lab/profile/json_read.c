/* json_read.c: reads and validates profiles from untrusted JSON. */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/lab/profile/json_fields.h"
#include "src/lab/profile/profile_reports.h"

enum {
    MAX_FILE_SIZE = 64 * 1024 * 1024, /* jansson needs 20 times as much */
    JSON_PATH_SIZE = 64
};

static const double max_number = 1e8; /* 27 hours in ms */

/* File being read. `json_path` is the JSON path for messages: "rows[3].", or "" at top level. */
struct reader {
    const char *path;
    char json_path[JSON_PATH_SIZE];
    struct profile *profile;
};

static enum status fault(const struct reader *reader, const char *key, const char *what)
{
    log_error("%s: \"%s%s\" %s; write the profile again with --json", reader->path,
              reader->json_path, key, what);
    return STATUS_DATA;
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
    case PROFILE_FIELD_SAMPLES:
    case PROFILE_FIELD_ARRAY:
        return json_is_array(value) ? NULL : "is not an array";
    case PROFILE_FIELD_OBJECT:
        return json_is_object(value) ? NULL : "is not an object";
    case PROFILE_FIELD_SUMMARY:
        break;
    }
    return NULL;
}

static enum status read_kind(const struct reader *reader, const char *name, enum profile_kind *kind)
{
    for (int i = 0; i < PROFILE_KIND_COUNT; i++) {
        if (strcmp(name, profile_kind_names[i]) == 0) {
            *kind = (enum profile_kind)i;
            return STATUS_OK;
        }
    }
    return fault(reader, "kind", "is not a kind of row");
}

static enum status read_heap_text(const struct reader *reader, const json_t *value, char **text)
{
    *text = strdup(json_string_value(value));
    if (!*text)
        return log_out_of_memory(reader->path);
    log_sanitize(*text);
    return STATUS_OK;
}

static enum status read_samples(const struct reader *reader, const char *key, const json_t *array,
                                double **samples)
{
    const uint32_t count = reader->profile->run_count;
    if (json_array_size(array) != count)
        return fault(reader, key, "does not have one number per run");
    *samples = calloc(count, sizeof(**samples));
    if (!*samples)
        return log_out_of_memory(reader->path);
    for (uint32_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(array, i);
        if (!is_number(number))
            return fault(reader, key, "has an element that is not a number from -1e8 to 1e8");
        (*samples)[i] = json_number_value(number);
    }
    return STATUS_OK;
}

static enum status read_fields(struct reader *reader, const json_t *json,
                               const struct profile_field *fields, void *object);

/* Allocates an array of structs and reads its elements. */
static enum status read_array(struct reader *reader, const struct profile_field *field,
                              const json_t *array, char **elements)
{
    enum status status = STATUS_OK;
    *elements = calloc(json_array_size(array) + 1, field->element_size);
    if (!*elements)
        return log_out_of_memory(reader->path);
    const uint32_t count = (uint32_t)json_array_size(array); /* file size is limited */
    *(uint32_t *)(void *)((char *)reader->profile + field->count_offset) = count;
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++) {
        snprintf(reader->json_path, JSON_PATH_SIZE, "%s[%" PRIu32 "].", field->key, i);
        status = read_fields(reader, json_array_get(array, i), field->fields,
                             *elements + i * field->element_size);
    }
    reader->json_path[0] = '\0';
    return status;
}

/* Stores a value of the correct type. */
static enum status read_value(struct reader *reader, const struct profile_field *field,
                              const json_t *value, void *object)
{
    void *at = (char *)object + field->offset;
    switch (field->kind) {
    case PROFILE_FIELD_HEAP:
        return read_heap_text(reader, value, at);
    case PROFILE_FIELD_TEXT:
        memcpy(at, json_string_value(value), json_string_length(value) + 1);
        log_sanitize(at);
        break;
    case PROFILE_FIELD_U32:
        *(uint32_t *)at = (uint32_t)json_integer_value(value);
        break;
    case PROFILE_FIELD_U64:
        *(uint64_t *)at = (uint64_t)json_integer_value(value);
        break;
    case PROFILE_FIELD_DOUBLE:
        *(double *)at = json_number_value(value);
        break;
    case PROFILE_FIELD_BOOL:
        *(bool *)at = json_boolean_value(value);
        break;
    case PROFILE_FIELD_ROW_KIND:
        return read_kind(reader, json_string_value(value), at);
    case PROFILE_FIELD_SAMPLES:
        return read_samples(reader, field->key, value, at);
    case PROFILE_FIELD_ARRAY:
        return read_array(reader, field, value, at);
    case PROFILE_FIELD_OBJECT:
        return read_fields(reader, value, field->fields, object);
    case PROFILE_FIELD_SUMMARY:
        break;
    }
    return STATUS_OK;
}

static enum status read_fields(struct reader *reader, const json_t *json,
                               const struct profile_field *fields, void *object)
{
    enum status status = STATUS_OK;
    for (; fields->key && status == STATUS_OK; fields++) {
        const json_t *value = json_object_get(json, fields->key);
        if (fields->kind == PROFILE_FIELD_SUMMARY || (!value && fields->is_optional))
            continue;
        const char *what = value ? find_fault(fields, value) : "is missing";
        status =
            what ? fault(reader, fields->key, what) : read_value(reader, fields, value, object);
    }
    return status;
}

static enum status read_profile(struct reader *reader, const json_t *root)
{
    const char *type = json_string_value(json_object_get(root, "type"));
    if (!type || strcmp(type, "profile") != 0)
        return fault(reader, "type", "is not \"profile\"");
    if (json_integer_value(json_object_get(root, "format")) != PROFILE_JSON_FORMAT)
        return fault(reader, "format", "is not 2, the only supported format");
    if (json_integer_value(json_object_get(root, "run_count")) == 0)
        return fault(reader, "run_count", "is not a number of runs");
    return read_fields(reader, root, profile_fields, reader->profile);
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
    struct reader reader = { .path = path, .profile = p };
    json_t *root = NULL;
    enum status status = load(path, &root);
    *p = (struct profile){ 0 };
    if (status == STATUS_OK)
        status = read_profile(&reader, root);
    json_decref(root);
    if (status != STATUS_OK)
        profile_finish(p);
    return status;
}
