/*
 * test_radiance.c: bilinear filtering of textures and environment images in the reference
 * renderer.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/file/half_float.h"
#include "src/lab/reference/surroundings_radiance.h"
#include "src/scene/environment/image_based_lighting.h"

/* Two layers of 2 x 2; the first is black. Red: 0 1 / 0 0, alpha: 1 1 / 1 0; green: sRGB 188. */
static uint8_t texels[2 * 2 * 2 * 4] = {
    [16] = 0, 188, 0, 255, 255, 188, 0, 255, 0, 188, 0, 255, 0, 188, 0, 0,
};

static const struct scene textured = {
    .model.textures = { texels, 2, 2 },
};

static void check_texel(uint32_t material, float u, float v, vec4s want)
{
    const struct globals globals = { 0 };
    const struct radiance radiance = radiance_of(&textured, &globals);
    const vec4s got = radiance_texel(&radiance, material, (vec2s){ { u, v } });
    for (int c = 0; c < 4; c++)
        CHECK_NEAR(got.raw[c], want.raw[c], 1e-4);
}

static void test_textures(void **state)
{
    const float grey = 0.5029F;
    (void)state;
    check_texel(0, 0.3F, 0.9F, (vec4s){ { 1, 1, 1, 1 } });
    check_texel(1, 0.3F, 0.9F, (vec4s){ { 0, 0, 0, 0 } });
    check_texel(2, 0.25F, 0.25F, (vec4s){ { 0, grey, 0, 1 } });
    check_texel(2, 0.75F, 0.25F, (vec4s){ { 1, grey, 0, 1 } });
    check_texel(2, 0.5F, 0.25F, (vec4s){ { 0.5F, grey, 0, 1 } });
    check_texel(2, 0.65F, 0.25F, (vec4s){ { 0.8F, grey, 0, 1 } });
    check_texel(2, 0.5F, 0.5F, (vec4s){ { 0.25F, grey, 0, 0.75F } });
    check_texel(2, 1, 0.25F, (vec4s){ { 0.5F, grey, 0, 1 } }); /* around the edge */
    check_texel(2, -0.25F, 0.25F, (vec4s){ { 1, grey, 0, 1 } });
    check_texel(2, -12.25F, 7.25F, (vec4s){ { 1, grey, 0, 1 } });
    check_texel(2 | MESH_UNLIT | MESH_CUTOUT, 0.75F, 0, (vec4s){ { 0.5F, grey, 0, 0.5F } });
    check_texel(2, 1e9F, -1e9F, (vec4s){ { 0.25F, grey, 0, 0.75F } }); /* on a corner */
}

/* Red grows from the left to the right edge, green is that of the rows. */
static void test_environment(void **state)
{
    enum {
        WIDTH = 4,
        HEIGHT = 2,
    };

    uint16_t halves[WIDTH * HEIGHT * 4] = { 0 };
    const struct scene scene = {
        .background.kind = SCENE_ENVIRONMENT,
        .background.environment = { halves, WIDTH, HEIGHT },
    };
    const struct globals globals = { .sky_strength = 1.0F };
    const struct radiance radiance = radiance_of(&scene, &globals);
    (void)state;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const size_t row = i / WIDTH;
        halves[i * 4] = half_from_float((float)(i % WIDTH));
        halves[i * 4 + 1] = half_from_float((float)row);
    }

    const struct {
        vec3s dir;
        float red, green;
    } rows[] = {
        { { { 0, 0, -1 } }, 1.5F, 0.5F }, /* the middle */
        { { { 1, 0, 0 } }, 2.5F, 0.5F },
        { { { -1, 0, 0 } }, 0.5F, 0.5F },
        { { { 0, 0, 1 } }, 1.5F, 0.5F }, /* the seam: of 3 and 0 */
        { { { 0.70710678F, 0, -0.70710678F } }, 2, 0.5F },
        { { { 0, 1, 0 } }, 1.5F, 0 }, /* the poles: no row beyond */
        { { { 0, -1, 0 } }, 1.5F, 1 },
    };

    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const vec3s got = radiance_sky(&radiance, rows[i].dir);
        CHECK_NEAR(got.y, rows[i].green, 1e-3);
        if (fabsf(rows[i].dir.y) < 0.5F)
            CHECK_NEAR(got.x, rows[i].red, 1e-3);
    }
}

/* Returns the shading normal of a surface that faces +Z, whose u is along +X and v along -Y. */
static vec3s normal_of(const uint8_t texel[static 4], float side)
{
    uint8_t numbers[4];
    struct material material = material_make("mapped");
    const struct mesh_vertex vertex = { .normal = { { 0, 0, 1 } },
                                        .material = 1u << MESH_SURFACE_SHIFT };
    const struct mesh_extra extra = { .tangent = { { 1, 0, 0 } }, .side = side };
    const vec3s dp_du[2] = { { { 1, 0, 0 } }, { { 1, 0, 0 } } };
    const vec3s dp_dv[2] = { { { 0, -1, 0 } }, { { 0, -1, 0 } } };
    const struct radiance_point point = {
        .vertex = &vertex,
        .extra = &extra,
        .dp_du = dp_du,
        .dp_dv = dp_dv,
        .dir = { { 0, 0, -1 } },
    };
    const struct globals globals = { 0 };
    struct radiance_reflectance reflectance;
    struct scene scene = { .model = { .materials = &material, .material_count = 1 } };
    memcpy(numbers, texel, sizeof(numbers));
    material.textures[MATERIAL_NORMAL].layer = 1;
    scene.model.numbers = (struct texture_layers){ numbers, 1, 1 };
    scene.tables.brdf = image_based_lighting_brdf_table();
    assert_non_null(scene.tables.brdf);
    const struct radiance radiance = radiance_of(&scene, &globals);
    assert_true(radiance_reflectance_at(&radiance, &point, &reflectance));
    free(scene.tables.brdf);
    return reflectance.normal;
}

/* Red is along u; green is against v, or on the side that the file's tangent states. */
static void test_normal_map(void **state)
{
    (void)state;
    const uint8_t right[4] = { 217, 128, 218, 255 }, up[4] = { 128, 217, 218, 255 };
    for (float side = -1; side <= 1; side++) {
        const vec3s n = normal_of(right, side), m = normal_of(up, side);
        CHECK_NEAR(n.x, 0.7, 0.01);
        CHECK_NEAR(n.y, 0, 0.01);
        CHECK_NEAR(m.x, 0, 0.01);
        CHECK_NEAR(m.y, side < 0 ? -0.7 : 0.7, 0.01);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_textures),
        cmocka_unit_test(test_environment),
        cmocka_unit_test(test_normal_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
