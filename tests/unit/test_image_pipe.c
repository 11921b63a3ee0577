/*
 * test_image_pipe.c: image headers through the reader's pipe: round trip, and rejection of invalid
 * data.
 */
#include <math.h>
#include "src/file/image_receive.h"
#include "tests/support/assertions.h"
#include "tests/support/memory_pipe.h"

enum {
    WIDTH_AT = 4 + offsetof(struct image_header, image.width),
    PLANE_COUNT_AT = 4 + offsetof(struct image_header, image.plane_count),
    TEXT_COUNT_AT = 4 + offsetof(struct image_header, text_count),
    WINDOW_AT = 4 + offsetof(struct image_header, window),
    MATRIX_AT = 4 + offsetof(struct image_header, world_to_ndc),
    PLANES_AT = 4 + sizeof(struct image_header),
    PLANE_SIZE = sizeof(struct image_plane),
    TEXT_AT = PLANES_AT + 2 * PLANE_SIZE,
};

/* A head of two planes, a place, one matrix and one text. */
static struct image_header make_head(void)
{
    struct image_header head = {
        .has_window = true,
        .window = { 3, 4, 20, 10 },
        .data_window = { -3, 4, 5, 6 },
        .display_window = { -6, 0, 20, 10 },
        .is_latlong = true,
        .has_world_to_ndc = true,
        .world_to_ndc = { 1, 2, 3 },
    };
    image_init(&head.image, 5, 6);
    assert_true(image_header_add_plane(&head, "R", true));
    assert_true(image_header_add_plane(&head, "N.X", false));
    assert_true(image_header_add_text(&head, "firn/settings", "a=1", 3));
    return head;
}

static struct memory_pipe write_head(void)
{
    struct image_header head = make_head();
    struct memory_pipe stream = { .size = 0 };
    assert_true(image_pipe_write_header(&(struct pipe_sink){ memory_pipe_write, &stream }, &head));
    image_header_finish(&head);
    return stream;
}

static enum pipe_fault read_head(struct memory_pipe *stream, struct image_header *head)
{
    stream->at = 0;
    return image_pipe_read_header(
        &(struct pipe_source){ memory_pipe_read, stream, MEMORY_PIPE_SIZE }, head);
}

static void heads_come_back(void **state)
{
    (void)state;
    struct image_header head, wanted = make_head();
    struct memory_pipe stream = write_head();
    assert_int_equal(read_head(&stream, &head), PIPE_OK);
    assert_int_equal(stream.at, stream.size);
    assert_true(image_header_matches(&head, &wanted.image, NULL, 0));
    assert_int_equal(head.text_count, 1);
    assert_string_equal(image_header_text(&head, "firn/settings"), "a=1");
    assert_true(head.has_window && head.has_world_to_ndc && !head.has_world_to_camera);
    assert_true(head.is_latlong && !head.is_cube_map);
    assert_memory_equal(&head.window, &wanted.window, sizeof(head.window));
    assert_memory_equal(&head.data_window, &wanted.data_window, sizeof(head.data_window));
    assert_memory_equal(&head.display_window, &wanted.display_window, sizeof(head.data_window));
    assert_memory_equal(head.world_to_ndc, wanted.world_to_ndc, sizeof(head.world_to_ndc));
    image_header_finish(&head);
    image_header_finish(&wanted);
}

static void short_ones_are_refused(void **state)
{
    (void)state;
    for (size_t size = write_head().size; size-- > 0;) {
        struct memory_pipe stream = write_head();
        struct image_header head;
        stream.size = size;
        assert_int_equal(read_head(&stream, &head), PIPE_SHORT);
        assert_null(head.image.planes);
    }
}

static void refuse(size_t at, uint32_t word, enum pipe_fault wanted)
{
    struct memory_pipe stream = write_head();
    struct image_header head;
    memcpy(stream.bytes + at, &word, sizeof(word));
    const enum pipe_fault fault = read_head(&stream, &head);
    if (fault != wanted)
        fail_msg("%u at %zu: %s, not %s", word, at, pipe_fault_text(fault),
                 pipe_fault_text(wanted));
    assert_null(head.image.planes);
}

static void lies_are_refused(void **state)
{
    (void)state;
    const float nan = NAN;
    uint32_t bits;
    memcpy(&bits, &nan, sizeof(bits));
    refuse(0, 1, PIPE_HEAD);
    refuse(4 + offsetof(struct image_header, has_window), 2, PIPE_HEAD);
    refuse(4 + offsetof(struct image_header, is_latlong), 2, PIPE_HEAD);
    refuse(WIDTH_AT, 0, PIPE_SIZE);
    refuse(WIDTH_AT, IMAGE_MAX_SIDE + 1, PIPE_SIZE);
    refuse(WIDTH_AT, 18, PIPE_SIZE); /* more than its place has */
    refuse(PLANE_COUNT_AT, 0, PIPE_SIZE);
    refuse(PLANE_COUNT_AT, IMAGE_MAX_PLANES + 1, PIPE_SIZE);
    refuse(TEXT_COUNT_AT, IMAGE_TEXT_COUNT_MAX + 1, PIPE_SIZE);
    refuse(WINDOW_AT, 21, PIPE_SIZE);
    refuse(WINDOW_AT, UINT32_MAX, PIPE_SIZE);
    refuse(MATRIX_AT + 60, bits, PIPE_NUMBER);
    refuse(PLANES_AT + PLANE_SIZE, 'R', PIPE_TEXT); /* twice */
    refuse(PLANES_AT + 64, 2, PIPE_TEXT);
    refuse(TEXT_AT, 'f', PIPE_TEXT); /* not firn's */
    refuse(TEXT_AT + 64, IMAGE_TEXT_SIZE_MAX, PIPE_TEXT);
    refuse(TEXT_AT + 68, 'a', PIPE_TEXT); /* '\0' inside */
}

static void unended_names_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        struct memory_pipe stream = write_head();
        struct image_header head;
        memset(stream.bytes + (i ? TEXT_AT : PLANES_AT), 'x', IMAGE_NAME_SIZE);
        assert_int_equal(read_head(&stream, &head), PIPE_TEXT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heads_come_back),
        cmocka_unit_test(short_ones_are_refused),
        cmocka_unit_test(lies_are_refused),
        cmocka_unit_test(unended_names_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
