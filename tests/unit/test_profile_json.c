/* test_profile_json.c: profiles as JSON: round trip. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/lab/profile/profile_reports.h"
#include "tests/support/assertions.h"
#include "tests/support/captured_output.h"
#include "tests/support/profile_sample.h"
#include "tests/support/temporary_folder.h"

static const char path[] = "a.json";

/* The caller frees the text. */
static char *write_profile(struct profile *p)
{
    struct printed printed;
    const struct profile_sweep sweep = { .points = p, .point_count = 1 };
    assert_int_equal(profile_json(&sweep, captured_output_begin(&printed)), STATUS_OK);
    assert_int_equal(fclose(printed.out), 0);
    assert_int_equal(strlen(printed.text), printed.size);
    assert_int_equal(printed.text[printed.size - 1], '\n');
    return printed.text;
}

static char *write_sample(double scale)
{
    struct profile p;
    profile_sample(&p, scale);
    char *text = write_profile(&p);
    profile_finish(&p);
    return text;
}

static void save(const char *text, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void test_same_bytes_again(void **state)
{
    (void)state;
    char *first = write_sample(1.0 / 3);
    struct profile p;
    save(first, strlen(first));
    assert_int_equal(profile_read_json(path, &p), STATUS_OK);
    assert_int_equal(p.pass_count, SAMPLE_PASS_COUNT);
    assert_string_equal(p.rows[4].name, "copy \"quoted\" <b>");
    assert_int_equal(p.residents[1].size, 1048576);
    char *second = write_profile(&p);
    assert_string_equal(first, second);
    profile_finish(&p);
    free(first);
    free(second);
}

/* Older files have nothing about a tree. */
static void test_without_a_tree(void **state)
{
    (void)state;
    char *text = write_sample(1.0);
    char *key;
    struct profile p;
    while ((key = strstr(text, "\"tree")))
        key[1] = 'n'; /* another one */
    save(text, strlen(text));
    assert_int_equal(profile_read_json(path, &p), STATUS_OK);
    assert_int_equal(p.bvh_triangles, 0);
    assert_int_equal(p.bvh_size, 0);
    profile_finish(&p);
    free(text);
}

static void test_bytes_that_are_no_utf8(void **state)
{
    (void)state;
    struct profile p;
    profile_sample(&p, 1);
    snprintf(p.device, sizeof(p.device), "\xc3\xb6.glb");
    snprintf(p.driver, sizeof(p.driver), "Eis \xff\xe2\x9d.glb");
    char *text = write_profile(&p);
    assert_non_null(strstr(text, "\"device\":\"\xc3\xb6.glb\""));
    assert_non_null(strstr(text, "\"driver\":\"Eis ???.glb\""));
    profile_finish(&p);
    free(text);
}

/* Control characters of a file could change the state of a terminal. */
static void test_control_characters(void **state)
{
    (void)state;
    struct profile p;
    profile_sample(&p, 1);
    free(p.scene);
    p.scene = strdup("\x1b[2J");
    snprintf(p.rows[2].name, PROFILE_NAME_SIZE, "\x7f\xc2\x9b\xc2\xa0\xc3\xb6");
    char *text = write_profile(&p);
    profile_finish(&p);
    save(text, strlen(text));
    free(text);
    assert_int_equal(profile_read_json(path, &p), STATUS_OK);
    assert_string_equal(p.scene, "?[2J");
    assert_string_equal(p.rows[2].name, "??\xc2\xa0\xc3\xb6");
    profile_finish(&p);
}

/* The sample with one piece of text replaced, where it is found first. */
static const struct {
    const char *from, *to;
    enum status status;
} damages[] = {
    { "\"format\":2", "\"format\":2", STATUS_OK },
    { "\"format\":2", "\"format\":3", STATUS_DATA },
    { "\"type\":\"profile\"", "\"type\":\"sweep\"", STATUS_DATA },
    { "\"type\"", "\"tipe\"", STATUS_DATA },
    { "\"width\":1024", "\"width\":-1", STATUS_DATA },
    { "\"width\":1024", "\"width\":4294967296", STATUS_DATA },
    { "\"width\":1024", "\"width\":1024.5", STATUS_DATA },
    { "\"width\":1024", "\"width\":\"1024\"", STATUS_DATA },
    { "\"width\":1024", "\"breadth\":1024", STATUS_DATA },
    { "\"scene\":\"valley\"", "\"scene\":null", STATUS_DATA },
    { "\"clock\":\"timestamps\"", "\"clock\":\"0123456789012345678901234567890\"", STATUS_OK },
    { "\"clock\":\"timestamps\"", "\"clock\":\"01234567890123456789012345678901\"", STATUS_DATA },
    { "\"has_statistics\":true", "\"has_statistics\":1", STATUS_DATA },
    { "\"upload\":12.0", "\"upload\":\"a\"", STATUS_DATA },
    { "\"upload\":12.0", "\"upload\":1.1e8", STATUS_DATA },
    { "\"upload\":12.0", "\"upload\":1e999", STATUS_DATA },
    { "\"upload\":12.0", "\"upload\":NaN", STATUS_DATA },
    { "\"upload\":12.0", "\"upload\":12.0,\"upload\":12.0", STATUS_DATA },
    { "\"run_count\":20", "\"run_count\":0", STATUS_DATA },
    { "\"run_count\":20", "\"run_count\":19", STATUS_DATA },
    { "\"run_count\":20", "\"run_count\":4294967295", STATUS_DATA },
    { "\"kind\":\"compute\"", "\"kind\":\"magic\"", STATUS_DATA },
    { "\"rows\":[", "\"rows\":[[],", STATUS_DATA },
    { "\"settings\":[{", "\"settings\":[3,{", STATUS_DATA },
    { "\"begin_ms\":[0.0,", "\"begin_ms\":[", STATUS_DATA },
    { "\"begin_ms\":[0.0,", "\"begin_ms\":[true,", STATUS_DATA },
    { "\"record_ms\":[0.050000000000000003", "\"record_ms\":[-1e8", STATUS_OK },
    { "\"ms\":[", "\"ms\":[0.5,", STATUS_DATA },
    { "\"frame\":{", "\"frame\":{\"ms\":[],", STATUS_DATA },
    { "\"plain\":{", "\"plane\":{", STATUS_DATA },
    { "{\"format\"", "[{\"format\"", STATUS_DATA },
    { "{\"format\":2", "[1]", STATUS_DATA },
};

static void test_damaged_files(void **state)
{
    (void)state;
    char *text = write_sample(1);
    const size_t size = strlen(text);
    for (size_t i = 0; i < sizeof(damages) / sizeof(damages[0]); i++) {
        const char *at = strstr(text, damages[i].from);
        assert_non_null(at);
        FILE *file = fopen(path, "wb");
        assert_non_null(file);
        fprintf(file, "%.*s%s%s", (int)(at - text), text, damages[i].to,
                at + strlen(damages[i].from));
        assert_int_equal(fclose(file), 0);
        struct profile p;
        const enum status status = profile_read_json(path, &p);
        if (status != damages[i].status)
            fail_msg("%s: %d", damages[i].to, status);
        assert_true(status == STATUS_OK || (!p.rows && !p.command && p.run_count == 0));
        profile_finish(&p);
    }
    for (size_t cut = 0; cut < size - 1; cut += size / 97) {
        struct profile p;
        save(text, cut);
        assert_int_equal(profile_read_json(path, &p), STATUS_DATA);
    }
    free(text);
}

static void test_missing_file(void **state)
{
    (void)state;
    struct profile p;
    (void)remove(path);
    assert_int_equal(profile_read_json(path, &p), STATUS_NO_INPUT);
    assert_int_equal(profile_read_json("/", &p), STATUS_NO_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bytes_again), cmocka_unit_test(test_bytes_that_are_no_utf8),
        cmocka_unit_test(test_damaged_files),    cmocka_unit_test(test_control_characters),
        cmocka_unit_test(test_missing_file),     cmocka_unit_test(test_without_a_tree),
    };
    return cmocka_run_group_tests(tests, temporary_folder_enter, temporary_folder_leave);
}
