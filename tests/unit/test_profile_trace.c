/* test_profile_trace.c: Chrome traces as tracing programs expect them, and CSV files. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/profile/profile_reports.h"
#include "tests/support/assertions.h"
#include "tests/support/captured_output.h"
#include "tests/support/profile_sample.h"

enum {
    TRACK_COUNT = 3,
    MAX_DEPTH = 8
};

static char *write_report(profile_report_fn *report, struct profile *p)
{
    struct printed printed;
    const struct profile_sweep sweep = { .points = p, .point_count = 1 };
    assert_int_equal(report(&sweep, captured_output_begin(&printed)), STATUS_OK);
    assert_int_equal(fclose(printed.out), 0);
    return printed.text;
}

static json_t *make_trace(struct profile *p)
{
    char *text = write_report(profile_trace, p);
    json_t *root = json_loads(text, 0, NULL);
    assert_non_null(root);
    free(text);
    return root;
}

static double number(const json_t *event, const char *key)
{
    const json_t *value = json_object_get(event, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static const char *string(const json_t *event, const char *key)
{
    const json_t *value = json_object_get(event, key);
    assert_true(json_is_string(value));
    return json_string_value(value);
}

/* Ends of the spans that are open on each track. */
struct tracks {
    double ends[TRACK_COUNT][MAX_DEPTH];
    int depths[TRACK_COUNT];
    uint32_t counts[3]; /* M, X, C */
};

static void check_span(struct tracks *tracks, const json_t *event, int track)
{
    const double begin = number(event, "ts"), end = begin + number(event, "dur");
    double *ends = tracks->ends[track];
    int *depth = &tracks->depths[track];
    assert_true(number(event, "dur") >= 0);
    while (*depth > 0 && ends[*depth - 1] <= begin + 1e-4)
        (*depth)--;
    assert_true(*depth == 0 || end <= ends[*depth - 1] + 1e-4);
    assert_true(*depth < MAX_DEPTH);
    ends[(*depth)++] = end;
}

static void check_event(struct tracks *tracks, const json_t *event)
{
    const json_t *args = json_object_get(event, "args");
    const double track = number(event, "tid");
    const char *phase = string(event, "ph");
    assert_true(string(event, "name")[0] != '\0');
    assert_true(json_is_integer(json_object_get(event, "pid")));
    assert_true(track == 1 || track == 2);
    assert_true(json_is_object(args));
    if (strcmp(phase, "M") == 0) {
        tracks->counts[0]++;
        assert_int_equal(json_object_size(args), 1);
        return;
    }
    if (strcmp(phase, "X") == 0) {
        tracks->counts[1]++;
        check_span(tracks, event, (int)track);
    } else {
        assert_string_equal(phase, "C");
        tracks->counts[2]++;
        assert_int_equal(json_object_size(args), 1);
        assert_true(json_is_number(json_object_get(args, "ms")) ||
                    json_is_number(json_object_get(args, "bytes")));
    }
}

static struct tracks check_trace(const json_t *root)
{
    struct tracks tracks = { 0 };
    const json_t *events = json_object_get(root, "traceEvents");
    assert_string_equal(string(root, "displayTimeUnit"), "ms");
    assert_true(json_is_array(events));
    for (size_t i = 0; i < json_array_size(events); i++)
        check_event(&tracks, json_array_get(events, i));
    return tracks;
}

/* The sum of the spans of that name on a track, in microseconds. */
static double add_up(const json_t *root, const char *name, int track)
{
    const json_t *events = json_object_get(root, "traceEvents");
    double sum = 0;
    for (size_t i = 0; i < json_array_size(events); i++) {
        const json_t *event = json_array_get(events, i);
        if (strcmp(string(event, "ph"), "X") == 0 && number(event, "tid") == track &&
            strcmp(string(event, "name"), name) == 0)
            sum += number(event, "dur");
    }
    return sum;
}

static void test_trace(void **state)
{
    (void)state;
    struct profile p;
    double pass = 0, submit = 0;
    profile_sample(&p, 1);
    json_t *root = make_trace(&p);
    const struct tracks tracks = check_trace(root);
    assert_int_equal(tracks.counts[0], 3);
    /* frame, record with its passes, submit, wait; passes again */
    assert_int_equal(tracks.counts[1], SAMPLE_RUN_COUNT * (4 + 2 * SAMPLE_PASS_COUNT));
    assert_int_equal(tracks.counts[2], SAMPLE_RUN_COUNT * (2 + SAMPLE_PASS_COUNT));
    for (int run = 0; run < SAMPLE_RUN_COUNT; run++) {
        pass += p.rows[2].ms[run] * 1000;
        submit += p.rows[SAMPLE_PASS_COUNT + 1].ms[run] * 1000;
    }
    CHECK_NEAR(add_up(root, "refract_paper.color", 2), pass, 0.01);
    CHECK_NEAR(add_up(root, "submit", 1), submit, 0.01);
    CHECK_NEAR(add_up(root, "frame 7", 1), p.frame[7] * 1000, 0.001);
    CHECK_NEAR(add_up(root, "refract_paper.color", 1), 50 * SAMPLE_RUN_COUNT, 0.01);
    json_decref(root);
    profile_finish(&p);
}

/* Where a pass begins before the last one ended, and the host waits longer than the frame took. */
static void test_trace_of_nonsense(void **state)
{
    (void)state;
    struct profile p;
    profile_sample(&p, 1);
    for (int run = 0; run < SAMPLE_RUN_COUNT; run++) {
        p.rows[3].begin_ms[run] = 0;
        p.rows[0].record_ms[run] = 100;
        p.rows[SAMPLE_PASS_COUNT].ms[run] = run == 3 ? -1 : 50;
        p.wait[run] = 1000;
    }
    json_t *root = make_trace(&p);
    (void)check_trace(root);
    json_decref(root);
    profile_finish(&p);
}

static void test_csv(void **state)
{
    (void)state;
    static const char header[] = "run,row,technique,repetition,kind,ms,begin_ms,record_ms\r\n";
    struct profile p;
    uint32_t lines = 0;
    double ms = 0;
    profile_sample(&p, 1);
    char *text = write_report(profile_csv, &p);
    assert_int_equal(strncmp(text, header, strlen(header)), 0);
    for (const char *at = text; (at = strstr(at, "\r\n")); at += 2)
        lines++;
    assert_int_equal(lines, 1 + SAMPLE_RUN_COUNT * (p.row_count + 3));
    assert_non_null(strstr(text, "\r\n7,\"copy \"\"quoted\"\" <b>\",readback,0,transfer,"));
    assert_int_equal(
        sscanf(strstr(text, "\r\n7,env_cube.objects,env_cube,1,"), "%*[^r]raster,%lf", &ms), 1);
    assert_true(ms == p.rows[1].ms[7]);
    assert_non_null(strstr(text, "\r\n19,frame,,0,whole,"));
    free(text);
    profile_finish(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_trace),
        cmocka_unit_test(test_trace_of_nonsense),
        cmocka_unit_test(test_csv),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
