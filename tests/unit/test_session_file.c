/* test_session_file.c: what a window shows, to lines and back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/tech/techniques.h"
#include "src/view/session/session_file.h"
#include "tests/support/assertions.h"

/* Lines as the reader of a file sends them. */
static struct preset lines_of(const char *text)
{
    struct preset preset = { .lines = calloc(64, sizeof(struct preset_line)) };
    assert_non_null(preset.lines);
    for (const char *at = text; *at; at += strcspn(at, "\n") + 1) {
        struct preset_line *line = &preset.lines[preset.count++];
        assert_true(preset.count < 64);
        line->number = preset.count;
        snprintf(line->assignment, sizeof(line->assignment), "%.*s", (int)strcspn(at, "\n"), at);
    }
    return preset;
}

static enum status parse(struct session_file *session, const char *text)
{
    struct preset lines = lines_of(text);
    const enum status status = session_file_parse(session, &lines, "a.firn");
    assert_null(lines.lines);
    return status;
}

/* Without the comment, which readers leave out. */
static char *print(const struct session_file *session)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    session_file_print(session, out);
    assert_int_equal(fclose(out), 0);
    assert_int_equal(*text, '#');
    memmove(text, strchr(text, '\n') + 1, strlen(strchr(text, '\n')));
    return text;
}

static void lines_come_back_as_they_were(void **state)
{
    struct session_file first;
    struct session_file again;
    (void)state;
    assert_int_equal(parse(&first, "scene=a%20b%c3%a9%25.glb\nenv=alps\nenv-rotate=-35.5\n"
                                   "rung=bounce\ntime=3.25\n"
                                   "camera=1,2,3,0,0.5,0,0,1,0,40,0,0\n"
                                   "transform=a%3db%20=0.1,-2,3e-05,0,-45,0,0.3\nhide=b\n"
                                   "cracks.count=5\n"),
                     STATUS_OK);
    assert_int_equal(first.object_transform_count, 2);
    assert_string_equal(first.object_transforms[0].name, "a=b ");
    CHECK_NEAR(first.object_transforms[0].rotate_deg.y, -45, 0);
    CHECK_NEAR(first.object_transforms[0].scale, 0.3f, 0);
    assert_true(first.object_transforms[1].is_hidden);
    assert_string_equal(first.scene, "a b\xc3\xa9%.glb");
    CHECK_NEAR(first.env_rotate, -35.5, 0);
    CHECK_NEAR(first.camera.target.y, 0.5, 0);
    CHECK_NEAR(first.camera.fov_deg, 40, 0);
    CHECK_NEAR(settings_get(&first.settings, settings_find("cracks.count")), 5, 0);
    char *text = print(&first);
    assert_int_equal(parse(&again, text), STATUS_OK);
    char *text_again = print(&again);
    assert_string_equal(text, text_again);
    assert_true(settings_equal(&first.settings, &again.settings));
    assert_ptr_equal(first.refraction, again.refraction);
    assert_memory_equal(first.object_transforms, again.object_transforms,
                        sizeof(first.object_transforms));
    free(text);
    free(text_again);
    session_file_finish(&first);
    session_file_finish(&again);
}

static void entries_of_two_sides_are_left_out(void **state)
{
    struct session_file session;
    (void)state;
    assert_int_equal(parse(&session, "scene=sphere\nrung=bounce\nb=state\nb.rung=trace\n"
                                     "b.cracks.count=7\ncamera-2=1,2,3\ntime=2\n"),
                     STATUS_OK);
    assert_true(session.time > 1.9f && session.time < 2.1f);
    session_file_finish(&session);
}

static void wrong_lines_are_refused(void **state)
{
    static const char *const wrong[] = {
        "rung=bounce\n",                                                /* no scene */
        "scene=sphere\n",                                               /* no rung */
        "scene=sphere\nrung=none-such\n",                               /* */
        "scene=\nrung=bounce\n",                                        /* */
        "scene=%\nrung=bounce\n",                                       /* half a byte */
        "scene=%00\nrung=bounce\n",                                     /* the end of a name */
        "scene=sphere\nrung=bounce\nsandbox=off\n",                     /* is no setting */
        "scene=sphere\nrung=bounce\ncracks.count=-1\n",                 /* */
        "scene=sphere\nrung=bounce\ntime=nan\n",                        /* */
        "scene=sphere\nrung=bounce\ncamera=1,2,3\n",                    /* */
        "scene=sphere\nrung=bounce\ncamera=0,0,0,0,0,0,0,1,0,45,0,0\n", /* nowhere */
        "scene=sphere\nrung=bounce\ncamera=0,0,1,0,0,0,0,1,0,45,2,0\n", /* no depth */
        "scene=sphere\nrung=bounce\nenv-rotate=361\n",                  /* */
        "scene=sphere\nrung=bounce\nhide=\n",                           /* nothing */
        "scene=sphere\nrung=bounce\ntransform=a\n",                     /* no numbers */
        "scene=sphere\nrung=bounce\ntransform=a=1,2,3,0,0,0,0\n",       /* of no size */
        "scene=sphere\nrung=bounce\ntransform=a=1,2,3,0,361,0,1\n",     /* */
    };
    struct session_file session;
    (void)state;
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
        assert_int_equal(parse(&session, wrong[i]), STATUS_DATA);
        assert_null(session.scene);
        assert_null(session.lines.lines);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_come_back_as_they_were),
        cmocka_unit_test(entries_of_two_sides_are_left_out),
        cmocka_unit_test(wrong_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
