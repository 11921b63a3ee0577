/* json_key_tables.h: tables of profile JSON keys, internal to json_write.c and json_read.c. */
#ifndef FIRN_LAB_PROFILE_JSON_KEY_TABLES_H
#define FIRN_LAB_PROFILE_JSON_KEY_TABLES_H

#include <jansson.h>
#include "src/lab/profile/profile_data.h"

enum {
    PROFILE_JSON_FORMAT = 2,
    PROFILE_JSON_DIGITS = 17, /* significant digits, exact for doubles */
    PROFILE_TRACE_DIGITS = 15 /* nanosecond precision up to 11 days */
};

enum profile_field_kind {
    PROFILE_FIELD_HEAP, /* char *, owned */
    PROFILE_FIELD_TEXT, /* char[size] */
    PROFILE_FIELD_U32,
    PROFILE_FIELD_U64,
    PROFILE_FIELD_DOUBLE,
    PROFILE_FIELD_BOOL,
    PROFILE_FIELD_ROW_KIND,
};

struct profile_field {
    enum profile_field_kind kind;
    const char *key;
    size_t offset, size;
    bool is_optional; /* defaults to 0 in files */
};

struct profile_fields {
    const struct profile_field *fields;
    uint32_t count;
};

/* Descriptors of the numbers and strings in each profile struct, in file order. */
extern const struct profile_fields profile_fields, profile_setting_fields, profile_resource_fields,
    profile_row_fields;

extern const char *const profile_kind_names[PROFILE_KIND_COUNT];

/* Adds all keys of docs/profile.md except `format` and `type`. If `with_samples` is false, omits
 * samples, `settings` and `residents`. Returns false if out of memory. */
bool profile_json_add_all(json_t *json, const struct profile *profile, bool with_samples);

/* Sets the key `key` of an object to `value`. If `key` is NULL, appends `value` to an array. Takes
 * ownership of `value` and returns it. Returns NULL if out of memory or if an input is NULL. */
json_t *profile_json_put(json_t *json, const char *key, json_t *value);

/* Returns a JSON string in which bytes that are not UTF-8 are replaced by '?'. */
json_t *profile_json_string(const char *text);

/* Writes JSON and a newline to *text, which the caller frees. Releases `root`, which may be NULL.
 * If out of memory or if `is_whole` is false, logs an error and returns STATUS_TRY_AGAIN. */
MUST_USE enum status profile_json_end(json_t *root, bool is_whole, size_t digits, char **text,
                                      size_t *size);

#endif
