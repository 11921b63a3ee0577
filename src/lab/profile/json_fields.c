/* json_fields.c: table of the JSON keys of profiles. */
#include "src/lab/profile/json_fields.h"
#include <stddef.h>

/* Key, offset and size of a struct member, for initialisers of struct profile_field. */
#define KEY(key, object, member) \
    key, offsetof(struct object, member), sizeof(((struct object *)0)->member)
#define AT(object, member) KEY(#member, object, member)
#define ARRAY(member, count, table) \
    { \
        PROFILE_FIELD_ARRAY, AT(profile, member), \
            .fields = (table), .count_offset = offsetof(struct profile, count), \
            .element_size = sizeof(*((struct profile *)0)->member) \
    }

static const struct profile_field of_setting[] = {
    { PROFILE_FIELD_TEXT, AT(profile_setting, name) },
    { PROFILE_FIELD_TEXT, AT(profile_setting, value) },
    { 0 },
};

static const struct profile_field of_resident[] = {
    { PROFILE_FIELD_TEXT, AT(profile_resource, name) },
    { PROFILE_FIELD_U32, AT(profile_resource, first_pass) },
    { PROFILE_FIELD_U32, AT(profile_resource, last_pass) },
    { PROFILE_FIELD_U32, AT(profile_resource, block) },
    { PROFILE_FIELD_U64, AT(profile_resource, offset) },
    { PROFILE_FIELD_U64, AT(profile_resource, size) },
    { 0 },
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
    { PROFILE_FIELD_SUMMARY, KEY("summary", profile_row, ms) },
    { PROFILE_FIELD_SAMPLES, AT(profile_row, ms) },
    { PROFILE_FIELD_SAMPLES, AT(profile_row, begin_ms) },
    { PROFILE_FIELD_SAMPLES, AT(profile_row, record_ms) },
    { 0 },
};

/* Summary and samples of a whole frame. */
#define WHOLE(member) \
    { \
        { PROFILE_FIELD_SUMMARY, KEY("summary", profile, member) }, \
            { PROFILE_FIELD_SAMPLES, KEY("ms", profile, member) }, { 0 }, \
    }

static const struct profile_field of_frame[] = WHOLE(frame);
static const struct profile_field of_plain[] = WHOLE(plain);
static const struct profile_field of_wait[] = WHOLE(wait);

const struct profile_field profile_fields[] = {
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
    ARRAY(settings, setting_count, of_setting),
    ARRAY(residents, resident_count, of_resident),
    ARRAY(rows, row_count, of_row),
    { PROFILE_FIELD_OBJECT, "frame", .fields = of_frame },
    { PROFILE_FIELD_OBJECT, "plain", .fields = of_plain },
    { PROFILE_FIELD_OBJECT, "wait", .fields = of_wait },
    { 0 },
};

const char *const profile_kind_names[PROFILE_KIND_COUNT] = {
    [PROFILE_RASTER] = "raster", [PROFILE_COMPUTE] = "compute",   [PROFILE_TRANSFER] = "transfer",
    [PROFILE_HOST] = "host",     [PROFILE_UNATTRIBUTED] = "rest",
};
