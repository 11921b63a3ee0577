/* chrome_trace.c: writes a Chrome trace, in integer nanoseconds so that sums are exact. */
#include "src/lab/profile/chrome_trace.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "src/lab/profile/json_key_tables.h"
#include "src/lab/profile/row_aggregation.h"

enum {
    PROCESS = 1,
    CPU_TRACK = 1,
    QUEUE_TRACK = 2
};

struct event {
    int64_t begin, duration; /* duration 0 marks a counter */
    uint64_t number;
    json_t *json;
};

struct trace {
    const struct profile *profile;
    uint64_t *memory_in_use; /* transient memory during each pass, bytes */
    struct event *events;
    uint64_t count, capacity;
    int64_t queue_end; /* end of the last pass */
    bool is_whole;     /* no allocation has failed */
};

static int64_t nanoseconds(double ms)
{
    return ms > 0 ? llround(ms * 1e6) : 0;
}

static json_t *microseconds(int64_t ns)
{
    return json_real((double)ns / 1000);
}

static json_t *make_event(const char *phase, const char *name, int track)
{
    json_t *json = json_object();
    const bool ok = profile_json_put(json, "ph", json_string(phase)) &&
                    profile_json_put(json, "name", profile_json_string(name)) &&
                    profile_json_put(json, "pid", json_integer(PROCESS)) &&
                    profile_json_put(json, "tid", json_integer(track)) &&
                    profile_json_put(json, "args", json_object());
    if (ok)
        return json;
    json_decref(json);
    return NULL;
}

static json_t *add_event(struct trace *trace, json_t *json, int64_t begin, int64_t duration)
{
    trace->is_whole = trace->is_whole && json && trace->count < trace->capacity &&
                      profile_json_put(json, "ts", microseconds(begin));
    if (!trace->is_whole) {
        json_decref(json);
        return NULL;
    }
    trace->events[trace->count] = (struct event){ begin, duration, trace->count, json };
    trace->count++;
    return json;
}

/* Adds a time span to a track. Returns its end time. */
static int64_t add_span(struct trace *trace, const char *name, int track, int64_t begin,
                        int64_t duration)
{
    json_t *json = add_event(trace, make_event("X", name, track), begin, duration);
    trace->is_whole = profile_json_put(json, "dur", microseconds(duration)) && trace->is_whole;
    return begin + duration;
}

static void add_counter(struct trace *trace, const char *name, const char *unit, json_t *value,
                        int64_t begin)
{
    json_t *json = add_event(trace, make_event("C", name, CPU_TRACK), begin, 0);
    /* profile_json_put() releases the value even on failure. */
    trace->is_whole =
        profile_json_put(json_object_get(json, "args"), unit, value) && trace->is_whole;
}

static int64_t min_i64(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static void name_row(const struct profile_row *row, char name[static PROFILE_TABLE_ROW_NAME_SIZE])
{
    profile_table_row_name(&(struct profile_table_row){ .row = row, .row_count = 1 }, name);
}

/* Adds a run's CPU time spans, each clamped to its parent. Returns the end time of `submit`. */
static int64_t add_host(struct trace *trace, uint32_t run, int64_t begin)
{
    const struct profile *p = trace->profile;
    const int64_t end = begin + nanoseconds(p->frame[run]);
    char name[PROFILE_TABLE_ROW_NAME_SIZE];
    int64_t at = begin;

    snprintf(name, sizeof(name), "frame %" PRIu32, run);
    add_span(trace, name, CPU_TRACK, begin, end - begin);
    for (uint32_t i = p->pass_count; i < p->row_count; i++) {
        const struct profile_row *row = &p->rows[i];
        if (row->kind != PROFILE_HOST)
            continue;
        const int64_t first = at;
        at =
            add_span(trace, row->name, CPU_TRACK, at, min_i64(nanoseconds(row->ms[run]), end - at));
        int64_t pass_begin = first;
        for (uint32_t k = 0; k < p->pass_count && i == p->pass_count;
             k++) { /* i is the row `record` */
            name_row(&p->rows[k], name);
            const int64_t length = nanoseconds(p->rows[k].record_ms[run]);
            pass_begin =
                add_span(trace, name, CPU_TRACK, pass_begin, min_i64(length, at - pass_begin));
        }
    }
    add_span(trace, "wait", CPU_TRACK, at, min_i64(nanoseconds(p->wait[run]), end - at));
    add_counter(trace, "frame", "ms", json_real(p->frame[run]), begin);
    return at;
}

static void add_queue(struct trace *trace, uint32_t run, int64_t begin)
{
    const struct profile *p = trace->profile;
    char name[PROFILE_TABLE_ROW_NAME_SIZE];

    for (uint32_t i = 0; i < p->pass_count; i++) {
        const struct profile_row *row = &p->rows[i];
        const int64_t measured = begin + nanoseconds(row->begin_ms[run]);
        const int64_t at = measured > trace->queue_end ? measured : trace->queue_end;
        name_row(row, name);
        trace->queue_end = add_span(trace, name, QUEUE_TRACK, at, nanoseconds(row->ms[run]));
        if (p->resident_count > 0)
            add_counter(trace, "transient memory", "bytes",
                        json_integer((json_int_t)trace->memory_in_use[i]), at);
    }
    if (p->resident_count > 0)
        add_counter(trace, "transient memory", "bytes", json_integer(0), trace->queue_end);
}

/* Compares events by time. A span comes before the spans nested in it. */
static int compare_events(const void *a, const void *b)
{
    const struct event *x = a, *y = b;
    if (x->begin != y->begin)
        return x->begin < y->begin ? -1 : 1;
    if (x->duration != y->duration)
        return x->duration > y->duration ? -1 : 1;
    return (x->number > y->number) - (x->number < y->number);
}

static bool add_name(json_t *array, const char *what, int track, const char *key, json_t *value)
{
    json_t *json = profile_json_put(array, NULL, make_event("M", what, track));
    return profile_json_put(json_object_get(json, "args"), key, value);
}

static bool add_names(json_t *array)
{
    return add_name(array, "process_name", CPU_TRACK, "name", json_string("firn")) &&
           add_name(array, "thread_name", CPU_TRACK, "name", json_string("CPU")) &&
           add_name(array, "thread_sort_index", CPU_TRACK, "sort_index", json_integer(0)) &&
           add_name(array, "thread_name", QUEUE_TRACK, "name", json_string("queue 0")) &&
           add_name(array, "thread_sort_index", QUEUE_TRACK, "sort_index", json_integer(1));
}

static bool trace_init(struct trace *trace, const struct profile *p)
{
    *trace = (struct trace){
        .profile = p,
        .memory_in_use = calloc((size_t)p->pass_count + 1, sizeof(*trace->memory_in_use)),
        .capacity = (uint64_t)p->run_count * (3 * (uint64_t)p->pass_count + 6),
    };
    trace->events = calloc(trace->capacity, sizeof(*trace->events));
    trace->is_whole = trace->memory_in_use && trace->events;
    for (uint32_t i = 0; i < p->resident_count && trace->is_whole; i++)
        for (uint32_t k = p->residents[i].first_pass; k <= p->residents[i].last_pass; k++)
            trace->memory_in_use[k] += p->residents[i].size;
    return trace->is_whole;
}

static void trace_finish(struct trace *trace)
{
    for (uint64_t i = 0; i < trace->count; i++)
        json_decref(trace->events[i].json);
    free(trace->events);
    free(trace->memory_in_use);
}

static bool add_all(struct trace *trace, json_t *array)
{
    const struct profile *p = trace->profile;
    int64_t begin = 0;
    for (uint32_t run = 0; run < p->run_count && trace->is_whole; run++) {
        add_queue(trace, run, add_host(trace, run, begin));
        begin += nanoseconds(p->frame[run]);
    }
    if (!trace->is_whole)
        return false;
    qsort(trace->events, trace->count, sizeof(*trace->events), compare_events);
    for (uint64_t i = 0; i < trace->count; i++)
        if (json_array_append(array, trace->events[i].json) != 0)
            return false;
    return true;
}

enum status profile_write_trace(const struct profile *p, char **text, size_t *size)
{
    struct trace trace;
    json_t *root = json_object();
    json_t *array = profile_json_put(root, "traceEvents", json_array());
    json_t *about = profile_json_put(root, "otherData", json_object());
    const bool ok = trace_init(&trace, p) && add_names(array) && add_all(&trace, array) &&
                    profile_json_put(root, "displayTimeUnit", json_string("ms")) &&
                    profile_json_put(about, "command", profile_json_string(p->command)) &&
                    profile_json_put(about, "device", profile_json_string(p->device)) &&
                    profile_json_put(about, "clock", profile_json_string(p->clock));
    trace_finish(&trace);
    return profile_json_end(root, ok, PROFILE_TRACE_DIGITS, text, size);
}
