/* mip_levels.c: mip level generation on the CPU. */
#include "src/scene/mip_levels.h"
#include <math.h>
#include "src/file/half_float.h"

size_t mip_levels_count(const struct mip_levels *mip_levels)
{
    size_t count = 0;
    for (size_t side = mip_levels->side; side > 0; side /= 2)
        count += side * side * mip_levels->layers * mip_levels->channels;
    return count;
}

/* Writes the mean of four texels to index `to`. */
typedef void mean_fn(void *texels, size_t to, const size_t from[4]);

static void fill_levels(void *texels, const struct mip_levels *mip_levels, mean_fn *mean)
{
    const size_t channels = mip_levels->channels;
    size_t from = 0;
    for (size_t side = mip_levels->side; side > 1; side /= 2) {
        const size_t row = side * channels;
        size_t to = from + side * row * mip_levels->layers;
        for (size_t y = 0; y < side / 2 * mip_levels->layers; y++) {
            for (size_t i = 0; i < row / 2; i++) {
                const size_t at = from + 2 * y * row + i / channels * 2 * channels + i % channels;
                mean(texels, to++, (size_t[]){ at, at + channels, at + row, at + row + channels });
            }
        }
        from += side * row * mip_levels->layers;
    }
}

static float average(float a, float b)
{
    return a + 0.5f * (b - a);
}

static uint16_t half_towards_zero(float value)
{
    const uint16_t half = half_from_float(value);
    return fabsf(half_to_float(half)) > fabsf(value) ? half - 1 : half;
}

static void mean_half(void *texels, size_t to, const size_t from[4])
{
    uint16_t *halves = texels;
    float values[4];
    for (int i = 0; i < 4; i++)
        values[i] = half_to_float(halves[from[i]]);
    halves[to] =
        half_towards_zero(average(average(values[0], values[1]), average(values[2], values[3])));
}

void mip_levels_fill_halves(uint16_t *texels, const struct mip_levels *mip_levels)
{
    fill_levels(texels, mip_levels, mean_half);
}

static uint32_t average_bytes(uint32_t a, uint32_t b)
{
    return (a + b + 1) / 2;
}

static void mean_byte(void *texels, size_t to, const size_t from[4])
{
    uint8_t *bytes = texels;
    bytes[to] = (uint8_t)average_bytes(average_bytes(bytes[from[0]], bytes[from[1]]),
                                       average_bytes(bytes[from[2]], bytes[from[3]]));
}

void mip_levels_fill_bytes(uint8_t *texels, const struct mip_levels *mip_levels)
{
    fill_levels(texels, mip_levels, mean_byte);
}
