/* ice_bump_map.c: generates tileable bump maps of dimples and gradient noise. */
#include "src/scene/ice_bump_map.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/half_float.h"
#include "src/scene/generate/noise.h"
#include "src/scene/mip_levels.h"

enum {
    SIZE = BUMP_MAPS_SIZE,
    PERIOD_MAX = 64, /* maximum number of cells across the tile */
};

/* Periodic lattice of random vectors. */
struct lattice {
    uint32_t period; /* number of cells across the tile */
    vec2s corners[PERIOD_MAX][PERIOD_MAX];
};

static void lattice_init(struct lattice *lattice, uint32_t period, uint32_t seed)
{
    lattice->period = period;
    for (uint32_t y = 0; y < period; y++) {
        for (uint32_t x = 0; x < period; x++) {
            vec3s v = noise_vector((vec3s){ { (float)x, (float)y, 0 } }, seed);
            lattice->corners[y][x] = (vec2s){ { v.x, v.y } };
        }
    }
}

static vec2s corner(const struct lattice *lattice, uint32_t x, uint32_t y)
{
    return lattice->corners[y % lattice->period][x % lattice->period];
}

/* Consecutive texels of a texture row within one lattice cell. */
struct span {
    uint32_t x, y;         /* cell coordinates */
    uint32_t first, count; /* first texel's x, and number of texels */
    float rest_y;          /* row's offset from the cell's top, in cells */
};

static struct span find_span(const struct lattice *lattice, uint32_t x, uint32_t y)
{
    const uint32_t cell = x * lattice->period / SIZE;
    const uint32_t end = ((cell + 1) * SIZE + lattice->period - 1) / lattice->period;
    const uint32_t in_y = y * lattice->period;
    return (struct span){ cell, in_y / SIZE, x, end - x, (float)(in_y % SIZE) / SIZE };
}

/* Returns the x offset of texel i from the cell's left side, in cells. */
static float cell_x(const struct lattice *lattice, const struct span *span, uint32_t i)
{
    return (float)((span->first + i) * lattice->period - span->x * SIZE) / SIZE;
}

static float fade(float t)
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

/* Fills a field with gradient noise (Perlin 2002), about -1 to 1, with one feature per cell. */
static void gradient_noise(const struct lattice *lattice, const struct span *span, float *values)
{
    const vec2s upper[2] = { corner(lattice, span->x, span->y),
                             corner(lattice, span->x + 1, span->y) };
    const vec2s lower[2] = { corner(lattice, span->x, span->y + 1),
                             corner(lattice, span->x + 1, span->y + 1) };
    const float down = span->rest_y, up = down - 1;
    for (uint32_t i = 0; i < span->count; i++) {
        const float right = cell_x(lattice, span, i), left = right - 1;
        const float across = fade(right);
        const float above = glm_lerp(upper[0].x * right + upper[0].y * down,
                                     upper[1].x * left + upper[1].y * down, across);
        const float below = glm_lerp(lower[0].x * right + lower[0].y * up,
                                     lower[1].x * left + lower[1].y * up, across);
        values[i] = 1.6F * glm_lerp(above, below, fade(down));
    }
}

/* Fills a span with smoothed cellular noise: the squared distance to the nearest feature point,
 * about 0 to 1. The noise looks like adjacent bowls with rounded ridges. */
static void cellular_noise(const struct lattice *lattice, const struct span *span, float *values)
{
    memset(values, 0, span->count * sizeof(*values));
    for (uint32_t point = 0; point < 25; point++) {
        const uint32_t x = point % 5, y = point / 5;
        const vec2s at =
            corner(lattice, span->x + lattice->period + x - 2, span->y + lattice->period + y - 2);
        const float from_y = span->rest_y - (float)y + 2 - 0.4F * at.y;
        for (uint32_t i = 0; i < span->count; i++) {
            const float from_x = cell_x(lattice, span, i) - (float)x + 2 - 0.4F * at.x;
            const float d = from_x * from_x + from_y * from_y + 0.1F;
            values[i] += 1 / (d * d * d * d);
        }
    }
    for (uint32_t i = 0; i < span->count; i++)
        values[i] = 1 / sqrtf(sqrtf(values[i]));
}

/* Evaluates a noise field at all texels of a span. */
typedef void field_fn(const struct lattice *lattice, const struct span *span, float *values);

/* Adds a scaled noise field to a tile of heights. */
static void add_field(float *heights, struct lattice *lattice, field_fn *field, uint32_t period,
                      float height, uint32_t seed)
{
    float values[SIZE];
    lattice_init(lattice, period, seed);
    for (uint32_t i = 0; i < SIZE * SIZE;) {
        const struct span span = find_span(lattice, i % SIZE, i / SIZE);
        field(lattice, &span, values);
        for (uint32_t k = 0; k < span.count; k++)
            heights[i++] += height * values[k];
    }
}

static float at(const float *heights, uint32_t x, uint32_t y)
{
    return heights[y % SIZE * SIZE + x % SIZE];
}

static vec2s slope(const float *heights, uint32_t x, uint32_t y)
{
    return (vec2s){ {
        at(heights, x + 1, y) - at(heights, x + SIZE - 1, y),
        at(heights, x, y + 1) - at(heights, x, y + SIZE - 1),
    } };
}

static void write_slopes(uint16_t *texels, const float *heights)
{
    double sum = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        sum += (double)glms_vec2_norm2(slope(heights, i % SIZE, i / SIZE));
    float scale = sum > 0 ? (float)sqrt(SIZE * SIZE / sum) : 0; /* sum is 0 for constant heights */
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        vec2s s = glms_vec2_scale(slope(heights, i % SIZE, i / SIZE), scale);
        texels[4 * i + 0] = half_from_float(s.x);
        texels[4 * i + 1] = half_from_float(s.y);
    }
}

/* Returns the value below which a given fraction of a field lies, by a histogram over -2 to 2. */
static float quantile(const float *field, float fraction)
{
    uint32_t counts[4096] = { 0 };
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        counts[(uint32_t)(glm_clamp(field[i] / 4 + 0.5F, 0, 0.9999F) * 4096)]++;
    float below = 0;
    uint32_t bin = 0;
    for (; bin < 4096 && below <= fraction * SIZE * SIZE; bin++)
        below += (float)counts[bin];
    return ((float)bin / 4096 - 0.5F) * 4;
}

static uint16_t to_unit_half(float x)
{
    return half_from_float(glm_clamp(x, 0, 1));
}

/* Writes smoothness, which is 1 where the field is below a quantile, and fades to 0 above it. */
static void write_smoothness(uint16_t *texels, const float *field, float fraction)
{
    const float width = 0.25F;
    float threshold = quantile(field, fraction);
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        float t = glm_clamp((threshold - field[i]) / width + 0.5F, 0, 1);
        texels[4 * i + 2] = to_unit_half(fraction <= 0   ? 0
                                         : fraction >= 1 ? 1
                                                         : t * t * (3 - 2 * t));
    }
}

static void write_frost(uint16_t *texels, const float *field)
{
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        texels[4 * i + 3] = to_unit_half(0.7F + 0.45F * field[i]);
}

static void generate(struct bump_maps *maps, const struct bump_maps_params *params, float *field,
                     struct lattice *lattice)
{
    const size_t field_size = (size_t)SIZE * SIZE * sizeof(*field);
    const uint32_t seed = params->seed * 16;
    memset(field, 0, field_size);
    add_field(field, lattice, cellular_noise, 7, 1.0F, seed);
    add_field(field, lattice, gradient_noise, 3, 0.8F, seed + 1);
    add_field(field, lattice, gradient_noise, 11, 0.14F, seed + 2);
    add_field(field, lattice, gradient_noise, 29, 0.025F, seed + 3);
    write_slopes(maps->texels, params->heights ? params->heights : field);
    memset(field, 0, field_size);
    add_field(field, lattice, gradient_noise, 4, 0.8F, seed + 4);
    add_field(field, lattice, gradient_noise, 9, 0.35F, seed + 5);
    add_field(field, lattice, gradient_noise, 23, 0.12F, seed + 6);
    write_smoothness(maps->texels, field, params->smooth);
    for (uint32_t i = 0; i < SIZE * SIZE && params->smoothness; i++)
        maps->texels[4 * i + 2] = to_unit_half(params->smoothness[i]);
    memset(field, 0, field_size);
    add_field(field, lattice, gradient_noise, 31, 0.6F, seed + 7);
    add_field(field, lattice, gradient_noise, 64, 0.5F, seed + 8);
    write_frost(maps->texels, field);
}

bool bump_maps_init(struct bump_maps *maps, const struct bump_maps_params *params)
{
    const struct mip_levels mip_levels = { .side = SIZE, .layers = 1, .channels = 4 };
    float *field = malloc((size_t)SIZE * SIZE * sizeof(*field));
    struct lattice *lattice = malloc(sizeof(*lattice));
    *maps = (struct bump_maps){
        .texels = malloc(mip_levels_count(&mip_levels) * sizeof(*maps->texels)),
        .size = SIZE,
    };
    bool done = field && lattice && maps->texels;
    if (done) {
        generate(maps, params, field, lattice);
        mip_levels_fill_halves(maps->texels, &mip_levels);
    } else {
        bump_maps_finish(maps);
    }
    free(field);
    free(lattice);
    return done;
}

void bump_maps_finish(struct bump_maps *maps)
{
    free(maps->texels);
    *maps = (struct bump_maps){ 0 };
}
