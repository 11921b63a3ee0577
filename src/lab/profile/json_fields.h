/* json_fields.h: table of the JSON keys of profiles, which drives writing and reading. */
#ifndef FIRN_LAB_PROFILE_JSON_FIELDS_H
#define FIRN_LAB_PROFILE_JSON_FIELDS_H

#include <jansson.h>
#include <stdio.h>
#include "src/lab/profile/profile_data.h"

enum {
    PROFILE_JSON_FORMAT = 2
};

enum profile_field_kind {
    PROFILE_FIELD_HEAP, /* char *, owned */
    PROFILE_FIELD_TEXT, /* char[size] */
    PROFILE_FIELD_U32,
    PROFILE_FIELD_U64,
    PROFILE_FIELD_DOUBLE,
    PROFILE_FIELD_BOOL,
    PROFILE_FIELD_ROW_KIND,
    PROFILE_FIELD_SAMPLES, /* double *, owned; one per run */
    PROFILE_FIELD_SUMMARY, /* written only: summary of the samples */
    PROFILE_FIELD_ARRAY,   /* pointer to structs, owned */
    PROFILE_FIELD_OBJECT,  /* keys of an inner JSON object; same struct */
};

struct profile_field {
    enum profile_field_kind kind;
    const char *key; /* NULL ends a table */
    size_t offset, size;
    const struct profile_field *fields; /* of the elements or the inner object */
    size_t count_offset, element_size;  /* of an array */
    bool is_optional;                   /* defaults to 0 in files */
};

/* Keys of struct profile. `run_count` precedes all samples. */
extern const struct profile_field profile_fields[];

extern const char *const profile_kind_names[PROFILE_KIND_COUNT];

/* Writes JSON and a newline, and releases `root`. If `root` is NULL, logs that memory is out. */
MUST_USE enum status profile_json_end(json_t *root, size_t digits, FILE *out);

#endif
