/* The command of a picture, read back by a shell and the parser of options, says the same. */
#include <stdio.h>
#include <stdlib.h>
#include <wordexp.h>
#include "src/app/app.h"
#include "src/view/panels/ui_reproduce_command.h"
#include "tests/support/assertions.h"

struct fixture {
    wordexp_t words; /* the options point into them */
    struct app_options options;
    struct scene scene;
    struct camera camera;
    float time;
};

/* Options of these words, but for the first `skip`, as a shell takes them. */
static void parse(struct fixture *f, const char *text, size_t skip)
{
    bool done;
    assert_int_equal(wordexp(text, &f->words, WRDE_NOCMD | WRDE_UNDEF), 0);
    assert_true(f->words.we_wordc > skip);
    const int count = (int)(f->words.we_wordc - skip);
    assert_int_equal(app_parse(&f->options, APP_RENDER, count, &f->words.we_wordv[skip], &done),
                     STATUS_OK);
    assert_false(done);
}

/* What `firn view` would have of these words, in a window of 320x240, of an object of ice: scenes
 * of others bring no cracks. */
static void start(struct fixture *f, const char *words)
{
    static struct object object;
    static struct material ice = { .flags = MATERIAL_FROM_SETTINGS };
    char text[512];
    *f = (struct fixture){ 0 };
    snprintf(text, sizeof(text), "--samples 1 %s", words); /* of which the last one counts */
    parse(f, text, 0);
    f->scene.model.objects = &object;
    f->scene.model.materials = &ice;
    f->scene.model.object_count = 1;
    f->scene.box = (struct box){ .min = { { -1, -1, -1 } }, .max = { { 1, 1, 1 } } };
    f->options.image.width = 320;
    f->options.image.height = 240;
    assert_int_equal(setup_camera(&f->camera, &f->scene, &f->options.image), STATUS_OK);
}

static void finish(struct fixture *f)
{
    wordfree(&f->words);
}

static char *print(const struct fixture *f)
{
    char *text = ui_render_command_print(&(struct ui_render_command){
        .image = &f->options.image,
        .scene = &f->scene,
        .camera = &f->camera,
        .time = f->time,
    });
    assert_non_null(text);
    return text;
}

static void assert_prints(const struct fixture *f, const char *expected)
{
    char *text = print(f);
    assert_string_equal(text, expected);
    free(text);
}

/* What the printed words mean. */
static void read_back(const struct fixture *f, struct fixture *back)
{
    char *text = print(f);
    *back = (struct fixture){ .scene = f->scene };
    parse(back, text, 2);
    assert_string_equal(back->words.we_wordv[0], "firn");
    assert_string_equal(back->words.we_wordv[1], "render");
    assert_int_equal(setup_camera(&back->camera, &back->scene, &back->options.image), STATUS_OK);
    free(text);
}

/* A picture of these words is this command. */
static void check(const char *words, const char *expected)
{
    struct fixture f;
    start(&f, words);
    assert_prints(&f, expected);
    finish(&f);
}

static void test_defaults_are_not_said(void **state)
{
    (void)state;
    check("sphere", "firn render sphere --size 320x240 --samples 1 -o firn.png");
    check("sphere --orbit 10,20,3 --fov 30 --samples 4",
          "firn render sphere --size 320x240 --samples 4 --orbit 10,20,3 --fov 30 -o firn.png");
    check("sphere --samples 4 --pixel-filter point",
          "firn render sphere --size 320x240 --samples 4 --pixel-filter point -o firn.png");
    check(
        "sphere --refraction one-sided --set cracks.count=7",
        "firn render sphere --size 320x240 --samples 1 --refraction one-sided --set cracks.count=7 "
        "-o firn.png");
}

static void test_levels(void **state)
{
    (void)state;
    check("sphere --quality draft",
          "firn render sphere --size 320x240 --samples 1 --quality draft -o firn.png");
    check("sphere --quality high --pixel-filter box --set refract.steps=3",
          "firn render sphere --size 320x240 --samples 1 --quality high --pixel-filter box "
          "--set refract.steps=3 --set tonemap.dither=off -o firn.png");
    check("sphere --quality high --pixel-filter box --set tonemap.resolve=filtered",
          "firn render sphere --size 320x240 --samples 1 --quality high --pixel-filter box "
          "--set tonemap.dither=off --set tonemap.resolve=filtered -o firn.png");
    check("sphere --set tonemap.dither=on",
          "firn render sphere --size 320x240 --samples 1 --set tonemap.dither=on -o firn.png");
}

static void test_time(void **state)
{
    (void)state;
    struct fixture f;
    start(&f, "sphere --set motion.time=5");
    f.time = 0.1f;
    assert_prints(
        &f, "firn render sphere --size 320x240 --samples 1 --set motion.time=0.1 -o firn.png");
    finish(&f);
}

static void test_index_of_refraction(void **state)
{
    (void)state;
    struct fixture f;
    check("sphere --set refract.ior=2.417", /* --material would take the cracks off */
          "firn render sphere --size 320x240 --samples 1 --set refract.ior=2.417 -o firn.png");
    check("a.obj --material ice", /* all of it is; another exposure would be metered */
          "firn render a.obj --size 320x240 --samples 1 --material ice --set tonemap.exposure=0 -o "
          "firn.png");
    check("a.obj --material ice --set refract.ior=1.7",
          "firn render a.obj --size 320x240 --samples 1 --material ice --set refract.ior=1.7 "
          "--set tonemap.exposure=0 -o firn.png");
    start(&f, "sphere --set refract.ior=1.7");
    assert_prints(
        &f, "firn render sphere --size 320x240 --samples 1 --set refract.ior=1.7 -o firn.png");
    f.scene.model.has_ior = true; /* what the model has by itself need not be said */
    f.scene.model.ior = 1.7f;
    assert_prints(&f, "firn render sphere --size 320x240 --samples 1 -o firn.png");
    f.scene.model.ior = 1.6f;
    assert_prints(
        &f, "firn render sphere --size 320x240 --samples 1 --set refract.ior=1.7 -o firn.png");
    finish(&f);
}

static void test_words_come_back(void **state)
{
    (void)state;
    struct fixture f;
    struct fixture back;
    start(&f, "'it'\\''s a $HOME `x` \"y\".obj' --env 'a b.hdr' --surroundings 'c;d.glb' "
              "--background 0.1,0,3 --set tonemap.exposure=-0.3333333 --set cracks.debug=on "
              "--set cracks.clip=none");
    f.time = 1.0f / 3.0f;
    f.camera = (struct camera){
        .eye = { { 1.0f / 7.0f, -2.0f / 3.0f, 5.1e-5f } },
        .target = { { 1e6f / 3.0f, 0.1f, -0.7f } },
        .fov_deg = 100.0f / 3.0f,
    };
    read_back(&f, &back);
    assert_string_equal(back.options.image.scene.name, "it's a $HOME `x` \"y\".obj");
    assert_string_equal(back.options.image.scene.environment, "a b.hdr");
    assert_string_equal(back.options.image.scene.surroundings, "c;d.glb");
    assert_memory_equal(&back.options.image.scene.background.value,
                        &f.options.image.scene.background.value, sizeof(vec3s));
    assert_memory_equal(&back.camera.eye, &f.camera.eye, sizeof(vec3s));
    assert_memory_equal(&back.camera.target, &f.camera.target, sizeof(vec3s));
    assert_memory_equal(&back.camera.fov_deg, &f.camera.fov_deg, sizeof(float));
    settings_set_value(&f.options.image.scene.settings, settings_find("motion.time"),
                       (double)f.time);
    assert_true(
        settings_equal(&back.options.image.scene.settings, &f.options.image.scene.settings));
    finish(&back);
    finish(&f);
}

static void test_name_like_an_option(void **state)
{
    (void)state;
    check("-- -o.obj",
          "firn render ./-o.obj --size 320x240 --samples 1 --set tonemap.exposure=0 -o firn.png");
}

/* A camera that frames the object in one size does not in another. */
static void test_another_size(void **state)
{
    (void)state;
    struct fixture f;
    struct fixture back;
    start(&f, "sphere");
    f.options.image.width = 100; /* higher than wide: the framing camera stands farther away */
    read_back(&f, &back);
    assert_memory_equal(&back.camera.eye, &f.camera.eye, sizeof(vec3s));
    assert_int_equal(back.options.image.width, 100);
    finish(&back);
    finish(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults_are_not_said),
        cmocka_unit_test(test_levels),
        cmocka_unit_test(test_time),
        cmocka_unit_test(test_index_of_refraction),
        cmocka_unit_test(test_words_come_back),
        cmocka_unit_test(test_name_like_an_option),
        cmocka_unit_test(test_another_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
