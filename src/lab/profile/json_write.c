/* json_write.c: writes profiles as JSON. */
#include "src/base/log.h"
#include "src/file/json_text.h"
#include "src/lab/profile/json_fields.h"
#include "src/lab/profile/profile_reports.h"
#include "src/lab/profile/row_aggregation.h"

enum {
    DIGITS = 17 /* significant digits, exact for doubles */
};

/* In this file, a NULL json_t means out of memory. jansson functions that are given NULL fail. */

static json_t *make_samples(const double *samples, uint32_t count)
{
    json_t *array = json_array();
    for (uint32_t i = 0; i < count && array; i++)
        array = json_text_append(array, json_real(samples[i]));
    return array;
}

static json_t *make_summary(const double *samples, const struct profile *p)
{
    const struct profile_summary s = profile_summarize(samples, p->run_count);
    const double frame = profile_summarize(p->frame, p->run_count).mean;
    return json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "mean", s.mean, "sigma", s.sigma, "min",
                     s.min, "median", s.median, "p95", s.p95, "max", s.max, "share",
                     frame > 0 ? s.mean / frame : 0.0);
}

static json_t *make_object(const struct profile_field *fields, const void *object,
                           const struct profile *p);

static json_t *make_array(const struct profile_field *field, const char *elements,
                          const struct profile *p)
{
    const uint32_t count = *(const uint32_t *)(const void *)((const char *)p + field->count_offset);
    json_t *array = json_array();
    for (uint32_t i = 0; i < count && array; i++)
        array = json_text_append(array,
                                 make_object(field->fields, elements + i * field->element_size, p));
    return array;
}

static json_t *make_value(const struct profile_field *field, const void *object,
                          const struct profile *p)
{
    const void *at = (const char *)object + field->offset;
    switch (field->kind) {
    case PROFILE_FIELD_HEAP:
        return json_text_string(*(char *const *)at ? *(char *const *)at : "");
    case PROFILE_FIELD_TEXT:
        return json_text_string(at);
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
    case PROFILE_FIELD_SAMPLES:
        return make_samples(*(double *const *)at, p->run_count);
    case PROFILE_FIELD_SUMMARY:
        return make_summary(*(double *const *)at, p);
    case PROFILE_FIELD_ARRAY:
        return make_array(field, *(char *const *)at, p);
    case PROFILE_FIELD_OBJECT:
        return make_object(field->fields, object, p);
    }
    return NULL;
}

static json_t *make_object(const struct profile_field *fields, const void *object,
                           const struct profile *p)
{
    json_t *json = json_object();
    for (; fields->key && json; fields++) {
        if (json_object_set_new(json, fields->key, make_value(fields, object, p)) == 0)
            continue;
        json_decref(json);
        json = NULL;
    }
    return json;
}

static json_t *make_profile(const struct profile *p)
{
    json_t *json = json_pack("{s:i, s:s, s:f}", "format", PROFILE_JSON_FORMAT, "type", "profile",
                             "overhead", profile_overhead(p));
    json_t *fields = make_object(profile_fields, p, p);
    if (json_object_update(json, fields) != 0) {
        json_decref(json);
        json = NULL;
    }
    json_decref(fields);
    return json;
}

static json_t *make_point(const struct profile_sweep *sweep, uint32_t point)
{
    json_t *values = json_array();
    for (uint32_t i = 0; i < sweep->parameter_count && values; i++)
        values = json_text_append(values, json_text_string(profile_sweep_value(sweep, point, i)));
    return json_pack("{s:o, s:o}", "values", values, "profile",
                     make_profile(&sweep->points[point]));
}

static json_t *make_sweep(const struct profile_sweep *sweep)
{
    json_t *parameters = json_array(), *points = json_array();
    for (uint32_t i = 0; i < sweep->parameter_count && parameters; i++)
        parameters = json_text_append(parameters, json_text_string(sweep->parameters[i].name));
    for (uint32_t i = 0; i < sweep->point_count && points; i++)
        points = json_text_append(points, make_point(sweep, i));
    return json_pack("{s:i, s:s, s:o, s:o}", "format", PROFILE_JSON_FORMAT, "type", "sweep",
                     "parameters", parameters, "points", points);
}

enum status profile_json_end(json_t *root, size_t digits, FILE *out)
{
    const int failed = json_dumpf(root, out, JSON_COMPACT | JSON_REAL_PRECISION(digits));
    fputc('\n', out);
    json_decref(root);
    return failed ? log_out_of_memory(NULL) : STATUS_OK;
}

enum status profile_json(const struct profile_sweep *sweep, FILE *out)
{
    json_t *root = sweep->parameter_count ? make_sweep(sweep) : make_profile(sweep->points);
    return profile_json_end(root, DIGITS, out);
}
