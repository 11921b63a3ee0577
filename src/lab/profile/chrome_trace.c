/* chrome_trace.c: writes a Chrome trace, in integer nanoseconds so that sums are exact. */
#include <inttypes.h>
#include <math.h>
#include "src/file/json_text.h"
#include "src/lab/profile/json_fields.h"
#include "src/lab/profile/profile_reports.h"

enum {
    PROCESS = 1,
    CPU_TRACK = 1,
    QUEUE_TRACK = 2,
    DIGITS = 15 /* nanosecond precision up to 11 days */
};

struct trace {
    const struct profile *profile;
    json_t *events;
    int64_t queue_end; /* end of the last pass */
    bool has_failed;   /* out of memory */
};

static int64_t nanoseconds(double ms)
{
    return ms > 0 ? llround(ms * 1e6) : 0;
}

static double microseconds(int64_t ns)
{
    return (double)ns / 1000;
}

static void add_event(struct trace *trace, json_t *event)
{
    trace->has_failed = json_array_append_new(trace->events, event) != 0 || trace->has_failed;
}

/* Adds a time span to a track. Returns its end time. */
static int64_t add_span(struct trace *trace, const char *name, int track, int64_t begin,
                        int64_t duration)
{
    add_event(trace, json_pack("{s:s, s:s, s:i, s:i, s:f, s:f, s:{}}", "ph", "X", "name", name,
                               "pid", PROCESS, "tid", track, "ts", microseconds(begin), "dur",
                               microseconds(duration), "args"));
    return begin + duration;
}

static void add_counter(struct trace *trace, const char *name, const char *unit, double value,
                        int64_t begin)
{
    add_event(trace,
              json_pack("{s:s, s:s, s:i, s:i, s:f, s:{s:f}}", "ph", "C", "name", name, "pid",
                        PROCESS, "tid", CPU_TRACK, "ts", microseconds(begin), "args", unit, value));
}

static int64_t min_i64(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static void name_row(const struct profile_row *row, char name[static PROFILE_NAME_SIZE + 16])
{
    if (row->repetition_count > 1)
        snprintf(name, PROFILE_NAME_SIZE + 16, "%s [%" PRIu32 "]", row->name, row->repetition);
    else
        snprintf(name, PROFILE_NAME_SIZE + 16, "%s", row->name);
}

/* Adds a run's CPU time spans, each clamped to its parent. Returns the end time of `submit`. */
static int64_t add_host(struct trace *trace, uint32_t run, int64_t begin)
{
    const struct profile *p = trace->profile;
    const struct profile_row *record = &p->rows[p->pass_count], *submit = record + 1;
    const int64_t end = begin + nanoseconds(p->frame[run]);
    char name[PROFILE_NAME_SIZE + 16];

    snprintf(name, sizeof(name), "frame %" PRIu32, run);
    add_span(trace, name, CPU_TRACK, begin, end - begin);
    const int64_t recorded = add_span(trace, "record", CPU_TRACK, begin,
                                      min_i64(nanoseconds(record->ms[run]), end - begin));
    int64_t pass_begin = begin;
    for (uint32_t i = 0; i < p->pass_count; i++) {
        name_row(&p->rows[i], name);
        const int64_t length = nanoseconds(p->rows[i].record_ms[run]);
        pass_begin =
            add_span(trace, name, CPU_TRACK, pass_begin, min_i64(length, recorded - pass_begin));
    }
    const int64_t submitted = add_span(trace, "submit", CPU_TRACK, recorded,
                                       min_i64(nanoseconds(submit->ms[run]), end - recorded));
    add_span(trace, "wait", CPU_TRACK, submitted,
             min_i64(nanoseconds(p->wait[run]), end - submitted));
    add_counter(trace, "frame", "ms", p->frame[run], begin);
    return submitted;
}

/* Returns the transient memory in use during a pass, in bytes. */
static double memory_in_use(const struct profile *p, uint32_t pass)
{
    double size = 0;
    for (uint32_t i = 0; i < p->resident_count; i++)
        if (p->residents[i].first_pass <= pass && pass <= p->residents[i].last_pass)
            size += (double)p->residents[i].size;
    return size;
}

static void add_queue(struct trace *trace, uint32_t run, int64_t begin)
{
    const struct profile *p = trace->profile;
    char name[PROFILE_NAME_SIZE + 16];

    for (uint32_t i = 0; i < p->pass_count; i++) {
        const struct profile_row *row = &p->rows[i];
        const int64_t measured = begin + nanoseconds(row->begin_ms[run]);
        const int64_t at = measured > trace->queue_end ? measured : trace->queue_end;
        name_row(row, name);
        trace->queue_end = add_span(trace, name, QUEUE_TRACK, at, nanoseconds(row->ms[run]));
        add_counter(trace, "transient memory", "bytes", memory_in_use(p, i), at);
    }
    add_counter(trace, "transient memory", "bytes", 0, trace->queue_end);
}

static void add_name(struct trace *trace, const char *what, int track, const char *name)
{
    add_event(trace, json_pack("{s:s, s:s, s:i, s:i, s:{s:s}}", "ph", "M", "name", what, "pid",
                               PROCESS, "tid", track, "args", "name", name));
}

enum status profile_trace(const struct profile_sweep *sweep, FILE *out)
{
    const struct profile *p = sweep->points;
    struct trace trace = { .profile = p, .events = json_array() };
    int64_t begin = 0;
    add_name(&trace, "process_name", CPU_TRACK, "firn");
    add_name(&trace, "thread_name", CPU_TRACK, "CPU");
    add_name(&trace, "thread_name", QUEUE_TRACK, "queue 0");
    for (uint32_t run = 0; run < p->run_count && !trace.has_failed; run++) {
        add_queue(&trace, run, add_host(&trace, run, begin));
        begin += nanoseconds(p->frame[run]);
    }
    json_t *root =
        json_pack("{s:s, s:o, s:{s:o, s:o, s:s}}", "displayTimeUnit", "ms", "traceEvents",
                  trace.events, "otherData", "command", json_text_string(p->command), "device",
                  json_text_string(p->device), "clock", p->clock);
    if (trace.has_failed) {
        json_decref(root);
        root = NULL;
    }
    return profile_json_end(root, DIGITS, out);
}
