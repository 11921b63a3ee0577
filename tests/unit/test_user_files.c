/* test_user_files.c: which file is next, and where presets are. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/scene/scene.h"
#include "src/view/session/xdg_folders.h"
#include "tests/support/assertions.h"

static void touch(const char *folder, const char *name)
{
    char path[256];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fclose(file), 0);
}

static void expect_next(const char *folder, const char *name, int step, const char *wanted)
{
    char path[256];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    char *next = user_files_next_model(path, step);
    if (wanted) {
        assert_non_null(next);
        assert_string_equal(strrchr(next, '/') + 1, wanted);
        assert_memory_equal(next, folder, strlen(folder));
    } else {
        assert_null(next);
    }
    free(next);
}

static void the_next_model_of_a_folder(void **state)
{
    (void)state;
    char folder[] = "/tmp/test_place.XXXXXX";
    static const char *const names[] = { "a.obj", "b.txt", "c.PLY", "d.glb", ".e.obj" };
    assert_non_null(mkdtemp(folder));
    touch(folder, "a.obj");
    expect_next(folder, "a.obj", 1, NULL);
    for (size_t i = 0; i < 5; i++)
        touch(folder, names[i]);
    expect_next(folder, "a.obj", 1, "c.PLY");
    expect_next(folder, "c.PLY", 1, "d.glb");
    expect_next(folder, "d.glb", 1, "a.obj");
    expect_next(folder, "a.obj", -1, "d.glb");
    expect_next(folder, "gone.obj", 1, NULL);
    for (size_t i = 0; i < 5; i++) {
        char path[256];
        snprintf(path, sizeof(path), "%s/%s", folder, names[i]);
        assert_int_equal(unlink(path), 0);
    }
    assert_int_equal(rmdir(folder), 0);
}

static void scenes_of_firn_go_round(void **state)
{
    (void)state;
    char *name = strdup(scene_name(0));
    uint32_t count = 0;
    do {
        char *next = user_files_next_model(name, 1);
        char *back = user_files_next_model(next, -1);
        assert_string_equal(back, name);
        free(back);
        free(name);
        name = next;
        count++;
    } while (strcmp(name, scene_name(0)) != 0);
    assert_null(scene_name(count));
    free(name);
}

static void presets_are_where_xdg_says(void **state)
{
    (void)state;
    char folder[] = "/tmp/test_place.XXXXXX";
    char wanted[256];
    assert_non_null(mkdtemp(folder));
    unsetenv("XDG_DATA_HOME");
    unsetenv("HOME");
    assert_null(user_files_data("preset", true));
    setenv("XDG_DATA_HOME", "relative", 1);
    assert_null(user_files_data("preset", true));
    setenv("HOME", folder, 1);
    char *path = user_files_data("preset", true);
    snprintf(wanted, sizeof(wanted), "%s/.local/share/firn/presets", folder);
    assert_string_equal(path, wanted);
    char *first = user_files_new(path, "preset", ".txt");
    touch(path, strrchr(first, '/') + 1);
    char *second = user_files_new(path, "preset", ".txt");
    assert_string_equal(strrchr(second, '/'), "/preset-0002.txt");
    assert_int_equal(unlink(first), 0);
    for (char *end = path; end && strlen(path) >= strlen(folder); end = strrchr(path, '/')) {
        if (end != path)
            *end = '\0';
        if (strlen(path) >= strlen(folder))
            assert_int_equal(rmdir(path), 0);
    }
    free(first);
    free(second);
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_next_model_of_a_folder),
        cmocka_unit_test(scenes_of_firn_go_round),
        cmocka_unit_test(presets_are_where_xdg_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
