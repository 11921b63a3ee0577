/* json_fields.h: which fields of a profile are which keys: one table for writing and for reading.
 * Shared by the files of json.h. */
#ifndef FIRN_PROFILE_JSON_FIELDS_H
#define FIRN_PROFILE_JSON_FIELDS_H

#include <jansson.h>
#include "src/profile/profile.h"

enum {
    PROFILE_JSON_FORMAT = 1,
    /* of numbers: */
    PROFILE_JSON_DIGITS = 17, /* no bit is lost */
    PROFILE_TRACE_DIGITS = 15 /* microseconds: three decimals up to 11 days */
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
};

struct profile_fields {
    const struct profile_field *fields;
    uint32_t count;
};

/* The scalars and strings of each struct, in the order of the file. */
extern const struct profile_fields profile_fields, profile_setting_fields, profile_resident_fields,
    profile_row_fields;

extern const char *const profile_kind_names[PROFILE_KIND_COUNT];

/* Adds all of a profile that docs/profile.md names, but `format` and `type`; without samples also
 * without `settings` and `residents`. False when memory is short. */
bool profile_json_add_all(json_t *json, const struct profile *profile, bool with_samples);

/* Puts a new value at a key, or at the end of an array where key is NULL; NULL if one of them is,
 * or memory is short. */
json_t *profile_json_put(json_t *json, const char *key, json_t *value);

/* UTF-8 in which what is none is '?'. */
json_t *profile_json_string(const char *text);

/* The text of a whole value, with a newline; logs when memory is short. Frees the value, if any. */
MUST_USE enum status profile_json_end(json_t *root, bool is_whole, size_t digits, char **text,
                                      size_t *size);

#endif
