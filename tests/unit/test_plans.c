/*
 * test_plans.c: plans of the program's frames, as text, are equal to tests/golden/plan_*.txt, and
 * those of small graphs, one for each feature, to feature_*.txt.
 *
 * test-plans FOLDER            compares
 * test-plans FOLDER --update   writes the files anew, to be read in the diff
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "src/render/frame/compile_frame_plan.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/bubbles.h"
#include "src/tech/refract/refract.h"
#include "src/tech/trace/refract_trace.h"
#include "src/tech/water/caustics.h"
#include "tests/support/assertions.h"
#include "tests/support/feature_graphs.h"

enum list_kind {
    LIST_FRAME,
    LIST_CAPTURE,
    LIST_RESOLVE,
};

struct golden {
    const char *name;
    enum list_kind list;
    const char *refraction;
    bool layers;                   /* all of them */
    bool static_cube;              /* that comes from outside */
    bool pool;                     /* the scene is one */
    uint32_t objects;              /* how many it has; 0: one */
    const char *setting;           /* that is changed; NULL: none */
    const struct feature *feature; /* instead of a list */
    const char *program, *folder;
    bool update;
};

static const struct golden goldens[] = {
    { .name = "plan_paper", .refraction = "paper" },
    { .name = "plan_paper_layers", .refraction = "paper", .layers = true },
    { .name = "plan_paper_static_cube", .refraction = "paper", .static_cube = true },
    { .name = "plan_one_sided", .refraction = "one-sided" },
    { .name = "plan_one_sided_layers", .refraction = "one-sided", .layers = true },
    { .name = "plan_bounce", .refraction = "bounce" },
    { .name = "plan_objects_layers", .refraction = "bounce", .objects = 2, .layers = true },
    { .name = "plan_trace_layers", .refraction = "trace", .objects = 2, .layers = true },
    { .name = "plan_pool", .refraction = "paper", .pool = true },
    { .name = "plan_pool_layers", .refraction = "paper", .pool = true, .layers = true },
    { .name = "plan_shine_layers",
      .refraction = "paper",
      .setting = "ice_caustics.light=sun",
      .layers = true },
    { .name = "plan_capture", .list = LIST_CAPTURE },
    { .name = "plan_resolve", .list = LIST_RESOLVE },
};

enum {
    LIST_COUNT = sizeof(goldens) / sizeof(goldens[0]),
    GOLDEN_COUNT = LIST_COUNT + FEATURE_COUNT,
    OTHER_COUNT = 6, /* tests without a golden file */
};

static const struct scene of_object = { 0 }, of_pool = { .has_pool = true },
                          of_convex = { .is_convex = true };

/* `settings` is for the request, and gets the golden's. */
static struct frame_request request_of(const struct golden *golden, struct settings *settings)
{
    static const enum technique_purpose purposes[] = {
        [LIST_FRAME] = TECHNIQUE_IMAGE,
        [LIST_CAPTURE] = TECHNIQUE_CAPTURE,
        [LIST_RESOLVE] = TECHNIQUE_RESOLVE,
    };

    *settings = settings_default();
    assert_int_equal(settings_assign(settings, "env_cube.size=512", SETTING_USER, NULL), STATUS_OK);
    if (golden->static_cube)
        assert_int_equal(settings_assign(settings, "env_cube.dynamic=off", SETTING_USER, NULL),
                         STATUS_OK);
    if (golden->setting)
        assert_int_equal(settings_assign(settings, golden->setting, SETTING_USER, NULL), STATUS_OK);
    return (struct frame_request){
        .config = {
            .settings = settings,
            .purpose = purposes[golden->list],
            .refraction =
                golden->refraction ? techniques_find_refraction(golden->refraction) : NULL,
            .scene = golden->pool ? &of_pool : &of_object,
            .object_count = golden->objects,
        },
        .view = { 1024, 768 },
        .layers = golden->layers ? UINT64_MAX : 0,
        .beauty = golden->list == LIST_FRAME,
        .display = golden->list != LIST_CAPTURE,
        .keep_cube = golden->list == LIST_CAPTURE,
    };
}

/* The caller frees it. */
static char *text_of(const struct rg_plan *plan)
{
    char *text;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    rg_dump(plan, file);
    fclose(file);
    return text;
}

/* The same. */
static char *dump(const struct golden *golden)
{
    if (golden->feature) {
        struct rg_plan *plan = run_plan(&golden->feature->params, NULL);
        char *text = text_of(plan);
        rg_plan_destroy(plan);
        return text;
    }
    struct settings settings;
    const struct frame_request request = request_of(golden, &settings);
    struct frame_plan plan;
    assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
    char *text = text_of(plan.plan);
    frame_plan_finish(&plan);
    return text;
}

/* Whether a file holds this text; if not, prints the first line that differs, was and is. */
static bool compare(const struct golden *golden, FILE *file, const char *text)
{
    char *line = NULL;
    size_t room = 0;
    bool same = true;
    for (unsigned number = 1; same; number++) {
        ssize_t length = getline(&line, &room, file);
        size_t wanted = strcspn(text, "\n") + (strchr(text, '\n') != NULL);
        if (length < 0 && !wanted)
            break;
        same = length >= 0 && (size_t)length == wanted && !memcmp(line, text, wanted);
        if (!same)
            print_error("%s.txt:%u\nwas: %s%sis:  %.*s%s", golden->name, number,
                        length < 0 ? "" : line, length < 0 ? "(the end)\n" : "", (int)wanted, text,
                        wanted ? "" : "(the end)\n");
        text += wanted;
    }
    free(line);
    return same;
}

static void write_golden(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void test_golden(void **state)
{
    const struct golden *golden = *state;
    char path[1024];
    char *text = dump(golden);
    snprintf(path, sizeof(path), "%s/%s.txt", golden->folder, golden->name);
    if (golden->update)
        write_golden(path, text);
    FILE *file = fopen(path, "r");
    bool same = file && compare(golden, file, text);
    if (!file)
        print_error("%s cannot be read\n", path);
    if (!same)
        print_error("if that is right: %s %s --update\n", golden->program, golden->folder);
    if (file)
        fclose(file);
    free(text);
    assert_true(same);
}

static bool has_pass_of(const struct rg_plan *plan, const char *technique)
{
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        if (!strcmp(plan->passes[i].technique->name, technique))
            return true;
    }
    return false;
}

static bool is_culled(const struct rg_plan *plan, const char *pass)
{
    for (uint32_t i = 0; i < plan->culled_count; i++) {
        if (!strcmp(plan->culled[i].pass->name, pass))
            return true;
    }
    return false;
}

/* A rung that reads no back normals does not pay for them. */
static void test_one_sided_draws_no_back_normals(void **state)
{
    (void)state;
    const struct golden one_sided = { .refraction = "one-sided" };
    const struct golden paper = { .refraction = "paper" };
    const char *pass = "ice_normal.clear_back";
    struct settings settings;
    struct frame_request request = request_of(&one_sided, &settings);
    struct frame_plan plan;
    assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
    assert_false(has_pass_of(plan.plan, "ice_normal"));
    assert_true(is_culled(plan.plan, pass));
    frame_plan_finish(&plan);

    request = request_of(&paper, &settings);
    assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
    assert_true(has_pass_of(plan.plan, "ice_normal"));
    assert_false(is_culled(plan.plan, pass));
    assert_true(is_culled(plan.plan, "refract_paper.layers")); /* no layer is asked for */
    frame_plan_finish(&plan);
}

static uint32_t count_images(const struct rg_plan *plan, const char *prefix)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->image_count; i++)
        count += !strncmp(plan->images[i].image->name, prefix, strlen(prefix));
    return count;
}

/* Of ice with nothing in it, what the settings switch on of its surface is in the plan, and nothing
 * else of it. */
static void check_surface(const char *const *assignments, bool lights, bool frost, uint32_t maps)
{
    static const char *const nothing[] = { "air.count=0", "bubbles.count=0", "cracks.count=0" };
    struct settings settings = settings_default();
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(settings_assign(&settings, nothing[i], SETTING_USER, NULL), STATUS_OK);
    for (; *assignments; assignments++)
        assert_int_equal(settings_assign(&settings, *assignments, SETTING_USER, NULL), STATUS_OK);
    const struct technique *refraction;
    for (size_t r = 0; (refraction = techniques_refraction(r)); r++) {
        if (!refraction->refraction.shaders->bump_frag && !refraction->refraction.shades_fullscreen)
            continue;
        struct settings defaults;
        struct frame_request request =
            request_of(&(struct golden){ .refraction = refraction->refraction.name }, &defaults);
        request.config.settings = &settings;
        struct frame_plan plan;
        assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
        assert_int_equal(has_pass_of(plan.plan, "over"), lights);
        assert_int_equal(has_pass_of(plan.plan, "frost"), frost);
        assert_int_equal(count_images(plan.plan, "frost."), frost);
        /* the exit direction, and the packed image that it is unpacked from */
        const uint32_t images = refraction->refraction.packs_layers ? 2 : 1;
        assert_int_equal(count_images(plan.plan, "refract."), frost ? images : 0);
        assert_int_equal(count_images(plan.plan, "bump."), maps);
        frame_plan_finish(&plan);
    }
}

static void test_surface_is_switched_off(void **state)
{
    (void)state;
    check_surface((const char *const[]){ NULL }, true, false, 1);
    check_surface((const char *const[]){ "bump.strength=0", NULL }, true, false, 0);
    check_surface((const char *const[]){ "light.count=0", NULL }, false, false, 1);
    check_surface((const char *const[]){ "highlight.strength=0", NULL }, false, false, 1);
    check_surface((const char *const[]){ "frost.amount=0.5", NULL }, true, true, 1);
    check_surface((const char *const[]){ "bump.strength=0", "light.strength=0", NULL }, false,
                  false, 0);
    check_surface(
        (const char *const[]){ "bump.strength=0", "light.count=0", "frost.amount=1", NULL }, false,
        true, 1);
}

static bool has_image(const struct rg_plan *plan, const char *name)
{
    for (uint32_t i = 0; i < plan->image_count; i++) {
        if (!strcmp(plan->images[i].image->name, name))
            return true;
    }
    return false;
}

/* A picture with all layers has the passes and layers of what is on. Returns how many passes. */
static uint32_t check_inside(const char *setting, bool air_is_on, bool bubbles_are_on)
{
    const struct golden paper = { .refraction = "paper", .layers = true };
    struct settings settings;
    struct frame_request request = request_of(&paper, &settings);
    struct frame_plan plan;
    assert_int_equal(settings_assign(&settings, setting, SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
    assert_true(has_pass_of(plan.plan, "air") == air_is_on);
    assert_true(has_image(plan.plan, "frame.air") == air_is_on);
    assert_true(has_image(plan.plan, "air.color") == air_is_on);
    assert_true(has_pass_of(plan.plan, "bubbles") == bubbles_are_on);
    assert_true(has_image(plan.plan, "bubbles.color") == bubbles_are_on);
    for (uint32_t i = 0; techniques_layer(i); i++) {
        const struct rg_image *image = techniques_layer(i)->image;
        const bool is_off = !image || (image == &air_color && !air_is_on) ||
                            (image == &bubbles_color && !bubbles_are_on) ||
                            image == &caustics_layer || image == &refract_media ||
                            image == &refract_last_object;
        assert_true(!frame_plan_buffer(&plan, image) == is_off);
    }
    const uint32_t count = plan.plan->pass_count;
    frame_plan_finish(&plan);
    return count;
}

/* Passes and the copy of a layer less: the air's layer has one of its own. */
static void test_what_is_off_is_not_there(void **state)
{
    (void)state;
    const uint32_t all = check_inside("air.count=1", true, true);
    assert_int_equal(check_inside("air.count=0", false, true), all - 3);
    assert_int_equal(check_inside("bubbles.count=0", true, false), all - 2);
}

struct objects_cost {
    uint32_t whole, limited; /* passes that draw all over the picture; or where an object is */
    VkDeviceSize memory;
};

static struct objects_cost cost_of(const char *refraction, uint32_t objects)
{
    const struct golden golden = { .refraction = refraction, .objects = objects };
    struct settings settings;
    struct frame_request request = request_of(&golden, &settings);
    struct frame_plan plan;
    assert_int_equal(settings_assign(&settings, "air.count=0", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&settings, "bubbles.count=0", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&settings, "cracks.count=0", SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
    struct objects_cost cost = { .memory = plan.plan->memory_used };
    for (uint32_t i = 0; i < plan.plan->pass_count; i++)
        ++*(plan.plan->passes[i].pass->area ? &cost.limited : &cost.whole);
    frame_plan_finish(&plan);
    return cost;
}

/* More objects cost no more memory, and no pass that draws where they are not. */
static void test_objects_draw_where_they_are(void **state)
{
    (void)state;
    const struct technique *refraction;
    for (size_t r = 0; (refraction = techniques_refraction(r)); r++) {
        const struct objects_cost two = cost_of(refraction->refraction.name, 2);
        const uint32_t each = two.limited;
        assert_true(each || refraction->refraction.traces_bvh);
        for (uint32_t count = 5; count <= 50; count *= 10) {
            const struct objects_cost more = cost_of(refraction->refraction.name, count);
            assert_int_equal(more.whole, two.whole);
            assert_int_equal(more.limited, (count - 1) * each);
            assert_int_equal(more.memory, two.memory);
        }
    }
}

/* Without cracks nothing of them is drawn. Nothing looks for what is inside then, or in what is
 * convex. */
static void test_no_cracks_no_passes(void **state)
{
    (void)state;
    const char *const switches[] = { "cracks.count=0", "cracks.count=1", "cracks.count=1" };
    for (size_t i = 0; i < 3; i++) {
        struct settings settings = settings_default();
        struct frame_plan plan;
        assert_int_equal(settings_assign(&settings, switches[i], SETTING_USER, NULL), STATUS_OK);
        const struct frame_request request = {
            .config = { .settings = &settings,
                        .scene = i == 2 ? &of_convex : &of_object,
                        .refraction = techniques_refraction(0) },
            .view = { 64, 64 },
            .display = true,
        };
        assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
        assert_int_equal(has_pass_of(plan.plan, "cracks"), i > 0);
        assert_int_equal(has_pass_of(plan.plan, "ice_interval"), i == 1);
        frame_plan_finish(&plan);
    }
}

/* Returns the width of an image in a plan, texels; 0: there is none. */
static uint32_t width_of(const struct rg_plan *plan, const char *name)
{
    for (uint32_t i = 0; i < plan->image_count; i++) {
        if (!strcmp(plan->images[i].image->name, name))
            return plan->images[i].extent.width;
    }
    return 0;
}

/* What is in the ice is drawn at a fraction of the picture and nothing of it at the picture's size,
 * but for layers, which are always of that size. */
static void test_small_targets(void **state)
{
    (void)state;
    static const char *const small[] = { "ice_depth.front.small",   "ice_depth.back.small",
                                         "ice_interval.near.small", "air.cover.small",
                                         "bubbles.color.small",     "cracks.color.small" };
    static const char *const whole[] = { "ice_depth.front", "ice_depth.back", "ice_interval.near",
                                         "air.cover",       "bubbles.color",  "cracks.color" };
    for (size_t layers = 0; layers < 2; layers++) {
        const struct golden paper = { .refraction = "paper",
                                      .layers = layers,
                                      .setting = "inclusions.scale=0.25" };
        struct settings settings;
        struct frame_request request = request_of(&paper, &settings);
        struct frame_plan plan;
        request.view = (VkExtent2D){ 66, 64 };
        assert_int_equal(frame_plan_init(&plan, &request), STATUS_OK);
        for (size_t i = 0; i < sizeof(small) / sizeof(small[0]); i++) {
            assert_int_equal(width_of(plan.plan, small[i]), 17);
            assert_int_equal(width_of(plan.plan, whole[i]), layers ? 66 : 0);
        }
        assert_int_equal(width_of(plan.plan, "ice_normal.back"), 66);
        frame_plan_finish(&plan);
    }
}

static struct golden golden_of(const struct feature *feature)
{
    return (struct golden){ .name = feature->name, .feature = feature };
}

int main(int argc, char **argv)
{
    struct golden states[GOLDEN_COUNT];
    struct CMUnitTest tests[GOLDEN_COUNT + OTHER_COUNT] = {
        cmocka_unit_test(test_surface_is_switched_off),
        cmocka_unit_test(test_one_sided_draws_no_back_normals),
        cmocka_unit_test(test_what_is_off_is_not_there),
        cmocka_unit_test(test_no_cracks_no_passes),
        cmocka_unit_test(test_small_targets),
        cmocka_unit_test(test_objects_draw_where_they_are),
    };
    if (argc < 2) {
        fprintf(stderr, "usage: %s FOLDER [--update]\n", argv[0]);
        return 2;
    }
    for (size_t i = 0; i < GOLDEN_COUNT; i++) {
        states[i] = i < LIST_COUNT ? goldens[i] : golden_of(feature_list[i - LIST_COUNT]);
        states[i].program = argv[0];
        states[i].folder = argv[1];
        states[i].update = argc > 2 && !strcmp(argv[2], "--update");
        tests[OTHER_COUNT + i] =
            (struct CMUnitTest){ states[i].name, test_golden, NULL, NULL, &states[i] };
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
