/* test_accumulate.c: accumulation of samples into image planes. */
#include "src/render/sample_accumulation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "src/file/half_float.h"
#include "tests/support/assertions.h"

enum {
    WIDTH = 3,
    HEIGHT = 2,
    TEXELS = WIDTH * HEIGHT,
    SAMPLES = 4,
};

static const struct rg_image half_rgba = { "half", VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image float_rgba = { "float", VK_FORMAT_R32G32B32A32_SFLOAT };
static const struct rg_image float_one = { "one", VK_FORMAT_R32_SFLOAT };

static const struct tile all = { .width = WIDTH, .height = HEIGHT };

/* A value that names its texel, channel and sample; exact as half, and so are sums of four. */
static float value_of(size_t texel, uint32_t channel, uint32_t sample)
{
    float value = 0.25f * (float)texel + 16.0f * (float)channel + 4.0f * (float)sample;
    return channel == 1 ? -value : value;
}

/* Texels of a sample, in memory of just their size; the caller frees them. */
static void *make_texels(VkFormat format, uint32_t sample)
{
    uint32_t size = rg_format_info(format)->size;
    size_t channels = format == VK_FORMAT_R32_SFLOAT ? 1 : 4;
    unsigned char *texels = malloc((size_t)TEXELS * size);
    assert_non_null(texels);
    for (size_t i = 0; i < TEXELS * channels; i++) {
        float value = value_of(i / channels, (uint32_t)(i % channels), sample);
        uint16_t half = half_from_float(value);
        if (format == VK_FORMAT_R16G16B16A16_SFLOAT)
            memcpy(texels + i * 2, &half, 2);
        else
            memcpy(texels + i * 4, &value, 4);
    }
    return texels;
}

/* All samples of a layer, alone in an image. */
static struct image accumulate(const struct frame_layer *layer, uint32_t samples)
{
    struct image image;
    image_init(&image, WIDTH, HEIGHT);
    assert_true(accumulate_add_planes(&image, layer));
    for (uint32_t sample = 0; sample < samples; sample++) {
        void *texels = make_texels(layer->image->format, sample);
        accumulate_sample(&image, &all, layer, texels, sample);
        free(texels);
    }
    accumulate_mean(&image, layer, samples);
    return image;
}

/* A plane holds a channel, of the sample 0 or the mean of all. */
static void check_plane(const struct image *image, const char *name, uint32_t channel,
                        uint32_t samples)
{
    const float *plane = image_find(image, name);
    assert_non_null(plane);
    for (size_t i = 0; i < TEXELS; i++) {
        float sum = 0.0f;
        for (uint32_t sample = 0; sample < samples; sample++)
            sum += value_of(i, channel, sample);
        CHECK_NEAR(plane[i], sum / (float)samples, 0.0);
    }
}

static void check_layer(const struct rg_image *source, uint32_t first_channel, bool mean,
                        uint32_t samples)
{
    struct frame_layer layer = {
        .name = "layer",
        .image = source,
        .planes = { "x", "y", "z", "w" },
        .first_channel = first_channel,
        .mean = mean,
    };
    uint32_t channels = source == &float_one ? 1 : 4;
    for (uint32_t i = channels - first_channel; i < 4; i++)
        layer.planes[i] = NULL;
    struct image image = accumulate(&layer, samples);
    assert_int_equal(image.plane_count, channels - first_channel);
    for (uint32_t i = 0; i < image.plane_count; i++)
        check_plane(&image, layer.planes[i], first_channel + i, mean ? samples : 1);
    image_finish(&image);
}

static void test_formats_and_channels(void **state)
{
    (void)state;
    const struct rg_image *const sources[] = { &half_rgba, &float_rgba, &float_one };
    for (size_t i = 0; i < sizeof(sources) / sizeof(sources[0]); i++) {
        uint32_t channels = sources[i] == &float_one ? 1 : 4;
        for (uint32_t first = 0; first < channels; first++) {
            check_layer(sources[i], first, true, 1);
            check_layer(sources[i], first, true, SAMPLES);
            check_layer(sources[i], first, false, SAMPLES);
        }
    }
}

/* Layers of one image share nothing but their source. */
static void test_layers_side_by_side(void **state)
{
    (void)state;
    const struct frame_layer first = { .image = &float_rgba, .planes = { "a", "b" }, .mean = true };
    const struct frame_layer last = {
        .image = &float_rgba,
        .planes = { "c" },
        .first_channel = 3,
        .half = true,
    };
    struct image image;
    image_init(&image, WIDTH, HEIGHT);
    assert_true(accumulate_add_planes(&image, &first));
    assert_true(accumulate_add_planes(&image, &last));
    assert_false(image.planes[1].half);
    assert_true(image.planes[2].half);
    for (uint32_t sample = 0; sample < SAMPLES; sample++) {
        void *texels = make_texels(VK_FORMAT_R32G32B32A32_SFLOAT, sample);
        accumulate_sample(&image, &all, &first, texels, sample);
        accumulate_sample(&image, &all, &last, texels, sample);
        free(texels);
    }
    accumulate_mean(&image, &first, SAMPLES);
    accumulate_mean(&image, &last, SAMPLES);
    check_plane(&image, "a", 0, SAMPLES);
    check_plane(&image, "b", 1, SAMPLES);
    check_plane(&image, "c", 3, 1);
    image_finish(&image);
}

/* A part's rows are tight; what is around it stays. */
static void test_a_part(void **state)
{
    (void)state;
    const struct frame_layer layer = { .image = &half_rgba, .planes = { "a" }, .mean = true };
    const struct tile part = { .x = 1, .y = 1, .width = 2, .height = 1 };
    struct image image;
    image_init(&image, WIDTH, HEIGHT);
    assert_true(accumulate_add_planes(&image, &layer));
    void *texels = make_texels(half_rgba.format, 1);
    accumulate_sample(&image, &part, &layer, texels, 1);
    free(texels);
    for (size_t i = 0; i < TEXELS; i++)
        CHECK_NEAR(image.planes[0].texels[i], i < 4 ? 0.0f : value_of(i - 4, 0, 1), 0.0);
    image_finish(&image);
}

/* A cleared image reuses its planes' memory, zeroed, for planes of any names. A changed size frees
 * it. */
static void test_cleared_image(void **state)
{
    (void)state;
    struct image image = { 0 };
    float *texels[2];
    image_clear(&image, WIDTH, HEIGHT);
    for (int p = 0; p < 2; p++) {
        texels[p] = image_add_plane(&image, p ? "b" : "a", p);
        assert_non_null(texels[p]);
        texels[p][0] = texels[p][TEXELS - 1] = 1.0f;
    }
    image_clear(&image, WIDTH, HEIGHT);
    assert_null(image_find(&image, "a"));
    assert_ptr_equal(image_add_plane(&image, "c", true), texels[0]);
    image_clear(&image, WIDTH, HEIGHT); /* "b" is still spare */
    for (int p = 0; p < 3; p++) {
        const float *plane = image_add_plane(&image, (const char *[]){ "b", "d", "e" }[p], false);
        assert_non_null(plane);
        assert_true(p == 2 || plane == texels[p]);
        assert_true(plane[0] == 0.0f && plane[TEXELS - 1] == 0.0f && !image.planes[p].half);
    }
    image_clear(&image, HEIGHT, WIDTH + 1);
    assert_int_equal(image.plane_count + image.spare_count, 0);
    assert_non_null(image_add_plane(&image, "a", false));
    image_finish(&image);
}

/* Those that no rung draws have planes alone. */
static void check_planes(const struct frame_layer *layer, struct image *image)
{
    VkFormat format = layer->image ? layer->image->format : VK_FORMAT_R32G32B32A32_SFLOAT;
    uint32_t channels = format == VK_FORMAT_R32_SFLOAT ? 1 : 4;
    assert_true(format == VK_FORMAT_R16G16B16A16_SFLOAT ||
                format == VK_FORMAT_R32G32B32A32_SFLOAT || format == VK_FORMAT_R32_SFLOAT);
    assert_non_null(layer->planes[0]);
    for (uint32_t p = 0; p < frame_layer_plane_count(layer); p++) {
        assert_true(layer->is_traced || layer->first_channel + p < channels);
        assert_null(image_find(image, layer->planes[p]));
    }
    assert_true(accumulate_add_planes(image, layer));
}

/* Every layer takes channels its image has, to planes of its own. */
static void test_layers_of_the_frame(void **state)
{
    (void)state;
    struct image image;
    image_init(&image, 1, 1);
    check_planes(&frame_beauty, &image);
    uint32_t count = 0;
    for (; techniques_layer(count); count++)
        check_planes(techniques_layer(count), &image);
    assert_true(count > 0 && count <= FRAME_LAYER_MAX);
    image_finish(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_formats_and_channels),
        cmocka_unit_test(test_layers_side_by_side),
        cmocka_unit_test(test_a_part),
        cmocka_unit_test(test_cleared_image),
        cmocka_unit_test(test_layers_of_the_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
