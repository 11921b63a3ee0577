/* test_bump_maps.c: generated bump maps: periodicity, slopes and smooth regions. */
#include "src/scene/ice_bump_map.h"

#include <math.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/file/half_float.h"

enum {
    SIZE = BUMP_MAPS_SIZE,
};

static struct bump_maps maps_of(double share, uint32_t seed)
{
    struct bump_maps maps;
    assert_true(
        bump_maps_init(&maps, &(struct bump_maps_params){ (float)share, seed, NULL, NULL }));
    assert_int_equal(maps.size, SIZE);
    return maps;
}

/* Channel c of a texel; the tile repeats. */
static double slope(const struct bump_maps *maps, uint32_t x, uint32_t y, uint32_t c)
{
    return (double)half_to_float(maps->texels[4 * (y % SIZE * SIZE + x % SIZE) + c]);
}

static double mask(const struct bump_maps *maps, uint32_t x, uint32_t y, uint32_t c)
{
    return slope(maps, x, y, 2 + c);
}

typedef double texel_fn(const struct bump_maps *maps, uint32_t x, uint32_t y, uint32_t c);

/* Mean step from a column to the next, and from a row. */
static double step(const struct bump_maps *maps, texel_fn *texel, uint32_t at, uint32_t c)
{
    double sum = 0;
    for (uint32_t i = 0; i < SIZE; i++)
        sum += fabs(texel(maps, at + 1, i, c) - texel(maps, at, i, c)) +
               fabs(texel(maps, i, at + 1, c) - texel(maps, i, at, c));
    return sum / (2 * SIZE);
}

/* Across the tile's edge there are no larger steps than elsewhere. */
static void test_edges_fit(void **state)
{
    static texel_fn *const texels[] = { slope, mask };
    struct bump_maps maps = maps_of(0.5, 3);
    (void)state;
    for (uint32_t k = 0; k < 4; k++) {
        double most = 0;
        for (uint32_t at = 0; at + 1 < SIZE; at++)
            most = fmax(most, step(&maps, texels[k / 2], at, k % 2));
        assert_true(step(&maps, texels[k / 2], SIZE - 1, k % 2) <= most);
        assert_true(most > 0 && most < 0.5);
    }
    bump_maps_finish(&maps);
}

/* They are a height's: uphill and down, and the same around every texel of four. */
static void test_slopes(void **state)
{
    struct bump_maps maps = maps_of(0.5, 0);
    double sum[2] = { 0 };
    double square = 0;
    double around = 0;
    (void)state;
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        const uint32_t x = i % SIZE;
        const uint32_t y = i / SIZE;
        const double u = slope(&maps, x, y, 0);
        const double v = slope(&maps, x, y, 1);
        const double u_by_v = slope(&maps, x, y + 1, 0) - slope(&maps, x, y + SIZE - 1, 0);
        const double v_by_u = slope(&maps, x + 1, y, 1) - slope(&maps, x + SIZE - 1, y, 1);
        sum[0] += u;
        sum[1] += v;
        square += u * u + v * v;
        around = fmax(around, fabs(u_by_v - v_by_u));
    }
    CHECK_NEAR(sum[0] / (SIZE * SIZE), 0, 1e-3);
    CHECK_NEAR(sum[1] / (SIZE * SIZE), 0, 1e-3);
    CHECK_NEAR(square / (SIZE * SIZE), 1, 1e-3);
    assert_true(around < 0.01); /* halves' steps */
    bump_maps_finish(&maps);
}

static double mean_mask(const struct bump_maps *maps, uint32_t c)
{
    double sum = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        sum += mask(maps, i % SIZE, i / SIZE, c);
    return sum / (SIZE * SIZE);
}

static void test_share_of_smooth(void **state)
{
    static const double shares[] = { 0, 0.25, 0.5, 0.8, 1 };
    (void)state;
    for (size_t i = 0; i < sizeof(shares) / sizeof(shares[0]); i++) {
        struct bump_maps maps = maps_of(shares[i], 5);
        const bool all = shares[i] == 0 || shares[i] == 1;
        CHECK_NEAR(mean_mask(&maps, 0), shares[i], all ? 0 : 0.05);
        CHECK_NEAR(mean_mask(&maps, 1), 0.7, 0.1);
        bump_maps_finish(&maps);
    }
}

static void test_seeds(void **state)
{
    struct bump_maps a = maps_of(0.5, 1);
    struct bump_maps b = maps_of(0.5, 1);
    struct bump_maps c = maps_of(0.5, 2);
    const size_t texels = (size_t)SIZE * SIZE;
    (void)state;
    assert_memory_equal(a.texels, b.texels, texels * 4 * sizeof(*a.texels));
    double product = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        product += slope(&a, i, i / SIZE, 0) * slope(&c, i, i / SIZE, 0);
    CHECK_NEAR(product / (SIZE * SIZE), 0, 0.1); /* 0.5 if they were alike */
    bump_maps_finish(&a);
    bump_maps_finish(&b);
    bump_maps_finish(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edges_fit),
        cmocka_unit_test(test_slopes),
        cmocka_unit_test(test_share_of_smooth),
        cmocka_unit_test(test_seeds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
