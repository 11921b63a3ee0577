/* test_window_layout.c: the picture and the panels never cover each other. */
#include <stdlib.h>
#include "src/view/window/window_layout.h"
#include "tests/support/assertions.h"

static bool meet(VkRect2D a, VkRect2D b)
{
    return a.offset.x < b.offset.x + (int32_t)b.extent.width &&
           b.offset.x < a.offset.x + (int32_t)a.extent.width &&
           a.offset.y < b.offset.y + (int32_t)b.extent.height &&
           b.offset.y < a.offset.y + (int32_t)a.extent.height;
}

static uint64_t area(VkRect2D r)
{
    return (uint64_t)r.extent.width * r.extent.height;
}

/* They have no area in common and, together, that of the window. */
static void check(VkExtent2D window, float scale, bool has_panels)
{
    const struct window_layout l = window_layout_of(window, scale, has_panels);
    const VkRect2D parts[] = { l.image, l.bar, l.panel, l.status, l.strip };
    uint64_t sum = 0;
    for (size_t i = 0; i < 5; i++) {
        sum += area(parts[i]);
        for (size_t j = 0; j < i; j++)
            assert_false(area(parts[i]) && area(parts[j]) && meet(parts[i], parts[j]));
    }
    assert_int_equal(sum, (uint64_t)window.width * window.height);
    assert_true(l.image.extent.width >= 1 && l.image.extent.height >= 1);
    assert_true(has_panels || area(l.image) == sum);
}

static void parts_cover_the_window_once(void **state)
{
    (void)state;
    for (uint32_t width = 1; width < 3000; width += width / 7 + 1) {
        for (uint32_t height = 1; height < 2000; height += height / 7 + 1) {
            check((VkExtent2D){ width, height }, 1.0f, true);
            check((VkExtent2D){ width, height }, 2.0f, true);
            check((VkExtent2D){ width, height }, 1.25f, false);
        }
    }
}

static void a_window_around_a_picture_has_its_size(void **state)
{
    (void)state;
    static const float scales[] = { 0.5f, 1.0f, 1.25f, 2.0f, 4.0f };
    for (uint32_t width = 40; width < 3000; width += 37) {
        for (size_t s = 0; s < 5; s++) {
            const VkExtent2D picture = { width, 600 };
            const struct window_layout l =
                window_layout_of(window_layout_for_image(picture, scales[s]), scales[s], true);
            assert_int_equal(l.image.extent.width, width);
            assert_int_equal(l.image.extent.height, 600);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_cover_the_window_once),
        cmocka_unit_test(a_window_around_a_picture_has_its_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
