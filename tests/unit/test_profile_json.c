/* Profiles as JSON, and back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/lab/profile/json.h"
#include "tests/support/assertions.h"
#include "tests/support/profile_sample.h"
#include "tests/support/temporary_folder.h"

static const char path[] = "a.json";

static char *write_sample(double scale)
{
    struct profile p;
    char *text = NULL;
    size_t size = 0;
    profile_sample(&p, scale);
    assert_int_equal(profile_write_json(&p, &text, &size), STATUS_OK);
    assert_int_equal(strlen(text), size);
    assert_int_equal(text[size - 1], '\n');
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
    char *first = write_sample(1.0 / 3), *second = NULL;
    size_t size = 0;
    struct profile p;
    save(first, strlen(first));
    assert_int_equal(profile_read_json(path, &p), STATUS_OK);
    assert_int_equal(p.pass_count, SAMPLE_PASS_COUNT);
    assert_string_equal(p.rows[4].name, "copy \"quoted\" <b>");
    assert_int_equal(p.residents[1].size, 1048576);
    assert_int_equal(profile_write_json(&p, &second, &size), STATUS_OK);
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
    char *text = NULL;
    size_t size = 0;
    profile_sample(&p, 1);
    free(p.scene);
    p.scene = strdup("Eis \xc3\xb6\xff\xe2\x9d.glb");
    assert_int_equal(profile_write_json(&p, &text, &size), STATUS_OK);
    assert_non_null(strstr(text, "\"scene\":\"Eis \xc3\xb6???.glb\""));
    profile_finish(&p);
    free(text);
}

/* The sample with one piece of text replaced, where it is found first. */
static const struct {
    const char *from, *to;
    enum status status;
} damages[] = {
    { "\"format\":2", "\"format\":2", STATUS_OK },
    { "\"outliers\":[", "\"surplus\":[", STATUS_OK },
    { "\"format\":2", "\"format\":3", STATUS_DATA },
    { "\"type\":\"profile\"", "\"type\":\"sweep\"", STATUS_DATA },
    { "\"type\"", "\"tipe\"", STATUS_DATA },
    { "\"width\":1024", "\"width\":-1", STATUS_DATA },
    { "\"width\":1024", "\"width\":0", STATUS_DATA },
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
    { "\"pass_count\":5", "\"pass_count\":4", STATUS_DATA },
    { "\"pass_count\":5", "\"pass_count\":6", STATUS_DATA },
    { "\"pass_count\":5", "\"pass_count\":4294967295", STATUS_DATA },
    { "\"last_pass\":4", "\"last_pass\":5", STATUS_DATA },
    { "\"last_pass\":4", "\"last_pass\":2", STATUS_DATA },
    { "\"kind\":\"compute\"", "\"kind\":\"magic\"", STATUS_DATA },
    { "\"kind\":\"compute\"", "\"kind\":\"host\"", STATUS_DATA },
    { "\"kind\":\"rest\"", "\"kind\":\"host\"", STATUS_DATA },
    { "\"name\":\"record\"", "\"name\":\"submit\"", STATUS_DATA },
    { "\"repetition\":1", "\"repetition\":2", STATUS_DATA },
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

/* One run's row is changed, so that rows no longer add up. */
static void test_sums(void **state)
{
    (void)state;
    struct profile p;
    char *text = NULL;
    size_t size = 0;
    profile_sample(&p, 1);
    p.rows[2].ms[3] += 0.01;
    assert_int_equal(profile_write_json(&p, &text, &size), STATUS_OK);
    profile_finish(&p);
    save(text, size);
    free(text);
    assert_int_equal(profile_read_json(path, &p), STATUS_DATA);
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
        cmocka_unit_test(test_damaged_files),    cmocka_unit_test(test_sums),
        cmocka_unit_test(test_missing_file),     cmocka_unit_test(test_without_a_tree),
    };
    return cmocka_run_group_tests(tests, temporary_folder_enter, temporary_folder_leave);
}
