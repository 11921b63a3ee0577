/* test_mip_levels.c: mip levels by box filtering, and cached noise. */
#include <string.h>
#include "src/file/half_float.h"
#include "src/scene/generate/noise.h"
#include "src/scene/mip_levels.h"
#include "tests/support/assertions.h"

/* Two layers of 4 x 4 texels of two bytes: each byte's mean is rounded up, rows first. */
static void bytes_of_layers(void **state)
{
    static const struct mip_levels mip_levels = { .side = 4, .layers = 2, .channels = 2 };
    uint8_t texels[2 * 2 * (16 + 4 + 1) + 1];
    (void)state;
    assert_int_equal(mip_levels_count(&mip_levels), sizeof(texels) - 1);
    memset(texels, 0, sizeof(texels));
    texels[sizeof(texels) - 1] = 77;
    for (size_t i = 0; i < 32; i++) {
        texels[2 * i] = (uint8_t)(i % 4 / 2 * 100 + i / 8 * 10); /* by quarters and layers */
        texels[2 * i + 1] = i % 2 == 0 && i / 4 % 2 == 0;        /* one of four is 1 */
    }
    mip_levels_fill_bytes(texels, &mip_levels);
    const uint8_t *second = texels + 64;
    for (size_t i = 0; i < 8; i++) {
        assert_int_equal(second[2 * i], i % 2 * 100 + i / 2 * 10);
        assert_int_equal(second[2 * i + 1], 1); /* of 1 and 0, then of that and 0 */
    }
    const uint8_t *third = second + 16;
    assert_int_equal(third[0], 55);
    assert_int_equal(third[2], 75);
    assert_int_equal(third[4], 77);
}

/* Exact where a half can be, else towards zero. */
static void halves_round_to_zero(void **state)
{
    static const float numbers[4] = { 1, 2, 3, 4 };
    static const struct mip_levels mip_levels = { .side = 2, .layers = 1, .channels = 3 };
    const float step = 1.0f / 1024; /* between halves from 1 to 2 */
    uint16_t texels[3 * 5];
    (void)state;
    assert_int_equal(mip_levels_count(&mip_levels), 15);
    for (size_t i = 0; i < 4; i++) {
        texels[3 * i] = half_from_float(numbers[i]);
        texels[3 * i + 1] = half_from_float(i == 3 ? 1 : 1 + step);
        texels[3 * i + 2] = half_from_float(i == 3 ? -1 : -1 - step);
    }
    mip_levels_fill_halves(texels, &mip_levels);
    CHECK_NEAR(half_to_float(texels[12]), 2.5, 0);
    CHECK_NEAR(half_to_float(texels[13]), 1, 0);
    CHECK_NEAR(half_to_float(texels[14]), -1, 0);
}

static void planes_hold_the_noise(void **state)
{
    struct noise_plane plane;
    (void)state;
    noise_plane_init(&plane, 3, 12);
    for (uint32_t i = 0; i < 4000; i++) {
        const float x = (float)(i % 63) * 0.11f;
        const float y = (float)i * 0.0018f;
        const float at = noise_plane_at(&plane, x, y);
        const float wanted = noise_fractal((vec3s){ { x, y, 0 } }, 3, 12);
        assert_memory_equal(&at, &wanted, sizeof(at));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_of_layers),
        cmocka_unit_test(halves_round_to_zero),
        cmocka_unit_test(planes_hold_the_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
