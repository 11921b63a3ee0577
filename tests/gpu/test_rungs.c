/*
 * test_rungs.c: what the rungs of refraction share.
 */
#include "tests/support/check.h"

#include "src/scene/generate.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

static const double eta = 1.0003 / 1.3091;

/* ---- pictures of one object ---- */

struct rung_picture {
    struct picture_request request;
    struct render_result result;
    struct picture_layer beauty;
    size_t pixel_count;
};

static struct rung_picture draw(struct gpu *gpu, const struct scene *scene, const char *rung,
                                const struct settings *settings, uint32_t size)
{
    struct rung_picture p = {
        .request = {
            .scene = scene,
            .settings = settings,
            .rung = rung,
            .camera = { .eye = { { 0.91F, 0.8F, 3.63F } }, .fov_deg = 35 },
            .width = size,
            .height = size,
        },
        .pixel_count = (size_t)size * size,
    };
    p.result = picture_render(gpu, &p.request);
    p.beauty = picture_layer(&p.result.image, "");
    return p;
}

static void finish(struct rung_picture *p)
{
    render_result_finish(&p->result);
}

/* ---- what all rungs share ---- */

static struct settings set_all(const char *const *assignments)
{
    struct settings settings = picture_settings("light.count=0");
    for (; *assignments; assignments++)
        assert_int_equal(settings_set(&settings, *assignments), STATUS_OK);
    return settings;
}

/* Where light of one radiance comes from everywhere, the object shows the same. */
static void white_furnace_is_white(void **state)
{
    static const char *const exact[] = { "refract.fresnel=exact", "refract.dispersion=1", NULL };
    const struct settings settings = set_all(exact);
    struct scene scene = { .background = SCENE_COLOR, .background_color = { { 1, 1, 1 } } };
    assert_true(generate_ice_cube(&scene.model.object, 4800));
    scene.box = mesh_box(&scene.model.object);
    for (const struct rung *rung = frame_rungs; rung->name; rung++) {
        struct rung_picture p = draw(*state, &scene, rung->name, &settings, 128);
        for (size_t i = 0; i < p.pixel_count; i++)
            CHECK_NEAR(vec_difference(picture_at(p.beauty, i), (struct vec){ 1, 1, 1 }), 0, 1e-3);
        finish(&p);
    }
    scene_finish(&scene);
}

static double unpolarised(double ci)
{
    const double n = 1 / eta;
    const double ct = sqrt(1 - eta * eta * (1 - ci * ci));
    const double rs = (ci - n * ct) / (ci + n * ct);
    const double rp = (n * ci - ct) / (n * ci + ct);
    return (rs * rs + rp * rp) / 2;
}

static void check_share(struct gpu *gpu, const struct scene *scene, const char *rung, size_t kind)
{
    static const char *const kinds[][3] = {
        { "refract.fresnel=paper", NULL },
        { "refract.fresnel=exact", NULL },
        { "refract.fresnel=crossfade", "refract.crossfade=0.3", NULL },
    };
    const struct settings settings = set_all(kinds[kind]);
    struct picture_request request = {
        .scene = scene,
        .settings = &settings,
        .rung = rung,
        .camera = { .eye = { { 0, 0, 4 } }, .fov_deg = 35 },
        .width = 64,
        .height = 64,
        .layers = picture_layer_bit("fresnel") | picture_layer_bit("N"),
    };
    struct render_result result = picture_render(gpu, &request);
    const struct picture_layer normal = picture_layer(&result.image, "N");
    const float *share = image_find(&result.image, "fresnel.Z");
    size_t count = 0;
    for (size_t i = 0; i < (size_t)64 * 64; i++) {
        const double ci = -vec_dot(picture_at(normal, i), picture_pixel_ray(&request, i));
        const double expected[] = { pow(1 - ci, 3), unpolarised(ci), 0.7 };
        if (!(ci > 0.1))
            continue;
        CHECK_NEAR(share[i], expected[kind], 3e-3);
        count++;
    }
    assert_true(count > 1000);
    render_result_finish(&result);
}

/* Eq. 4, Fresnel's equations, one share for all. */
static void share_of_the_reflection_is_as_set(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    for (size_t kind = 0; kind < 3; kind++) {
        check_share(*state, &scene, "paper", kind);
        check_share(*state, &scene, "one-sided", kind);
    }
    scene_finish(&scene);
}

/* Each colour of a dispersed picture is that of one drawn with its index alone. */
static void colours_bend_by_their_own_index(void **state)
{
    static const char *const dispersed[] = { "refract.dispersion=4", NULL };
    /* (1.3091 - 1) 0.025 4 apart */
    static const char *const alone[3][2] = { { "refract.ior=1.27819" },
                                             { "refract.ior=1.3091" },
                                             { "refract.ior=1.34001" } };
    static const char *const rungs[] = { "paper", "one-sided" };
    const struct settings settings = set_all(dispersed);
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 4800);
    picture_use_directions(&scene, 256);
    for (size_t r = 0; r < 2; r++) {
        struct rung_picture all = draw(*state, &scene, rungs[r], &settings, 96);
        for (int channel = 0; channel < 3; channel++) {
            const struct settings one = set_all(alone[channel]);
            struct rung_picture p = draw(*state, &scene, rungs[r], &one, 96);
            size_t differ = 0;
            for (size_t i = 0; i < p.pixel_count; i++) {
                const float a = all.beauty.planes[channel][i];
                const float b = p.beauty.planes[channel][i];
                differ += !(fabsf(a - b) <= 2e-3F);
            }
            assert_true(differ <= p.pixel_count / 500); /* at a limit of total reflection */
            finish(&p);
        }
        finish(&all);
    }
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(white_furnace_is_white),
        ON_DEVICE(share_of_the_reflection_is_as_set),
        ON_DEVICE(colours_bend_by_their_own_index),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
