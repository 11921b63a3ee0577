/* test_tile.c: tilings of images of many sizes cover each pixel exactly once. */
#include <stdlib.h>
#include "src/base/tile.h"
#include "tests/support/assertions.h"

/* How often each pixel is in a tile: once. */
static void check_cover(const struct tiling *tiling)
{
    const struct tile largest = tile_largest(tiling);
    const uint32_t width = tiling->width, height = tiling->height;
    uint8_t *seen = calloc((size_t)width * height, 1);
    assert_non_null(seen);
    for (uint32_t i = 0; i < tiling->columns * tiling->rows; i++) {
        const struct tile t = tile_at(tiling, i);
        assert_true(t.width > 0 && t.height > 0 && t.x % 2 == 0 && t.y % 2 == 0);
        assert_true(t.x + t.width <= width && t.y + t.height <= height);
        assert_true(t.width <= largest.width && t.height <= largest.height);
        assert_true(t.width + 3 >= largest.width && t.height + 3 >= largest.height);
        for (uint32_t y = t.y; y < t.y + t.height; y++) {
            for (uint32_t x = t.x; x < t.x + t.width; x++)
                seen[y * width + x]++;
        }
    }
    for (size_t i = 0; i < (size_t)width * height; i++)
        assert_int_equal(seen[i], 1);
    free(seen);
}

static void test_all_sizes(void **state)
{
    (void)state;
    for (uint32_t side = 1; side < 70; side++) {
        for (uint32_t parts = 1; parts <= 16; parts++) {
            const struct tiling wide = { side, 3, parts, 1 };
            const struct tiling high = { 5, side, 2, parts };
            assert_int_equal(tile_fits(&wide), parts == 1 || side / 2 >= parts);
            assert_int_equal(tile_fits(&high), parts == 1 || side / 2 >= parts);
            if (tile_fits(&wide))
                check_cover(&wide);
            if (tile_fits(&high))
                check_cover(&high);
        }
    }
}

static void test_order(void **state)
{
    (void)state;
    const struct tiling tiling = { 16384, 8190, 4, 2 };
    const struct tile last = tile_at(&tiling, 7), second = tile_at(&tiling, 1);
    assert_int_equal(second.x, 4096);
    assert_int_equal(second.y, 0);
    assert_int_equal(last.x, 12288);
    assert_int_equal(last.y, 4094); /* not 4095 */
    assert_int_equal(last.height, 4096);
    assert_int_equal(tile_largest(&tiling).width, 4096);
    assert_int_equal(tile_largest(&tiling).height, 4096);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_sizes),
        cmocka_unit_test(test_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
