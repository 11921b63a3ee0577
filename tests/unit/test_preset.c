/* test_preset.c: presets through the reader's pipe: round trip, and rejection of invalid data. */
#include "src/file/preset.h"
#include "tests/support/assertions.h"
#include "tests/support/memory_pipe.h"

enum {
    COUNT_AT = 4, /* bytes from the beginning */
    TEXT_AT = 12,
};

static struct memory_pipe write_two(void)
{
    struct preset_line lines[] = { { 3, "a.b=1" }, { 0, "c.d=on" } };
    const struct preset preset = { lines, 2 };
    struct memory_pipe stream = { .size = 0 };
    assert_true(preset_pipe_write(&(struct pipe_sink){ memory_pipe_write, &stream }, &preset));
    return stream;
}

static enum pipe_fault read_back(struct memory_pipe *stream, struct preset *preset)
{
    stream->at = 0;
    return preset_pipe_read(&(struct pipe_source){ memory_pipe_read, stream, MEMORY_PIPE_SIZE },
                            preset);
}

static void lines_come_back(void **state)
{
    (void)state;
    struct memory_pipe stream = write_two();
    struct preset preset;
    assert_int_equal(read_back(&stream, &preset), PIPE_OK);
    assert_int_equal(stream.at, stream.size);
    assert_int_equal(preset.count, 2);
    assert_int_equal(preset.lines[0].number, 3);
    assert_string_equal(preset.lines[0].assignment, "a.b=1");
    assert_int_equal(preset.lines[1].number, 0);
    assert_string_equal(preset.lines[1].assignment, "c.d=on");
    preset_finish(&preset);
}

static void short_ones_are_refused(void **state)
{
    (void)state;
    for (size_t size = write_two().size; size-- > 0;) {
        struct memory_pipe stream = write_two();
        struct preset preset;
        stream.size = size;
        assert_int_equal(read_back(&stream, &preset), PIPE_SHORT);
        assert_null(preset.lines);
    }
}

static void others_are_refused(void **state)
{
    (void)state;

    const struct {
        size_t at;
        uint32_t value;
        enum pipe_fault fault;
    } cases[] = {
        { 0, 0, PIPE_HEAD },
        { COUNT_AT, PRESET_LINE_COUNT_MAX + 1, PIPE_SIZE },
        { COUNT_AT, 1, PIPE_END },
        { TEXT_AT, 0x0a3d6161, PIPE_TEXT }, /* "aa=\n" */
    };

    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct memory_pipe stream = write_two();
        struct preset preset;
        memcpy(stream.bytes + cases[i].at, &cases[i].value, sizeof(cases[i].value));
        assert_int_equal(read_back(&stream, &preset), cases[i].fault);
        assert_null(preset.lines);
    }
}

static void unterminated_lines_are_refused(void **state)
{
    (void)state;
    struct memory_pipe stream = write_two();
    struct preset preset;
    memset(stream.bytes + TEXT_AT, 'x', PRESET_LINE_SIZE);
    assert_int_equal(read_back(&stream, &preset), PIPE_TEXT);
    assert_null(preset.lines);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_come_back),
        cmocka_unit_test(short_ones_are_refused),
        cmocka_unit_test(others_are_refused),
        cmocka_unit_test(unterminated_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
