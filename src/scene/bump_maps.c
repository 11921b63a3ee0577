/* bump_maps.c: dimples and noise on a tile whose edges fit each other. */
#include "src/scene/bump_maps.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/image/half.h"
#include "src/scene/noise.h"

enum {
    SIZE = BUMP_MAPS_SIZE,
    PERIOD_MAX = 64, /* cells across the tile */
};

/* A random vector at every corner of the cells that a tile is cut into. */
struct lattice {
    uint32_t period; /* cells across the tile */
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

/* A texel in cells: the whole ones, and the rest. */
struct place {
    uint32_t x, y;
    vec2s rest;
};

static struct place find_place(const struct lattice *lattice, uint32_t x, uint32_t y)
{
    uint32_t in_x = x * lattice->period;
    uint32_t in_y = y * lattice->period;
    return (struct place){
        .x = in_x / SIZE,
        .y = in_y / SIZE,
        .rest = { { (float)(in_x % SIZE) / SIZE, (float)(in_y % SIZE) / SIZE } },
    };
}

static float fade(float t)
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

/* Gradient noise (Perlin 2002): about -1 to 1, one cell wide. */
static float wave(const struct lattice *lattice, uint32_t x, uint32_t y)
{
    const struct place p = find_place(lattice, x, y);
    float value[2][2];
    for (uint32_t j = 0; j < 2; j++) {
        for (uint32_t i = 0; i < 2; i++) {
            vec2s from = { { p.rest.x - (float)i, p.rest.y - (float)j } };
            value[j][i] = glms_vec2_dot(corner(lattice, p.x + i, p.y + j), from);
        }
    }
    float upper = glm_lerp(value[0][0], value[0][1], fade(p.rest.x));
    float lower = glm_lerp(value[1][0], value[1][1], fade(p.rest.x));
    return 1.6F * glm_lerp(upper, lower, fade(p.rest.y));
}

/* Square of the distance to the nearest of scattered points, about 0 to 1, with rounded ridges:
 * bowls side by side. */
static float dimple(const struct lattice *lattice, uint32_t x, uint32_t y)
{
    const struct place p = find_place(lattice, x, y);
    float sum = 0;
    for (uint32_t j = 0; j < 5; j++) {
        for (uint32_t i = 0; i < 5; i++) {
            vec2s at =
                corner(lattice, p.x + lattice->period + i - 2, p.y + lattice->period + j - 2);
            vec2s from = { { p.rest.x - (float)i + 2 - 0.4F * at.x,
                             p.rest.y - (float)j + 2 - 0.4F * at.y } };
            float d = glms_vec2_norm2(from) + 0.1F;
            sum += 1 / (d * d * d * d);
        }
    }
    return 1 / sqrtf(sqrtf(sum));
}

typedef float field_fn(const struct lattice *lattice, uint32_t x, uint32_t y);

/* Adds a field to a tile of heights. */
static void add_field(float *heights, struct lattice *lattice, field_fn *field, uint32_t period,
                      float height, uint32_t seed)
{
    lattice_init(lattice, period, seed);
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++)
            heights[y * SIZE + x] += height * field(lattice, x, y);
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

static void make_slopes(uint16_t *texels, const float *heights)
{
    double sum = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        sum += (double)glms_vec2_norm2(slope(heights, i % SIZE, i / SIZE));
    float scale = (float)sqrt(SIZE * SIZE / sum);
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        vec2s s = glms_vec2_scale(slope(heights, i % SIZE, i / SIZE), scale);
        texels[4 * i + 0] = half_from_float(s.x);
        texels[4 * i + 1] = half_from_float(s.y);
    }
}

/* The value below which a share of a field lies, to a thousandth of the range -2 to 2. */
static float quantile(const float *field, float share)
{
    uint32_t counts[4096] = { 0 };
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        counts[(uint32_t)(glm_clamp(field[i] / 4 + 0.5F, 0, 0.9999F) * 4096)]++;
    float below = 0;
    uint32_t bin = 0;
    for (; bin < 4096 && below <= share * SIZE * SIZE; bin++)
        below += (float)counts[bin];
    return ((float)bin / 4096 - 0.5F) * 4;
}

static uint16_t to_share(float x)
{
    return half_from_float(glm_clamp(x, 0, 1));
}

/* Where the field is low it is smooth; from smooth to rough it takes a while. */
static void make_smooth(uint16_t *texels, const float *field, float share)
{
    const float width = 0.25F;
    float middle = quantile(field, share);
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        float t = glm_clamp((middle - field[i]) / width + 0.5F, 0, 1);
        texels[4 * i + 2] = to_share(share <= 0 ? 0 : share >= 1 ? 1 : t * t * (3 - 2 * t));
    }
}

static void make_crystals(uint16_t *texels, const float *field)
{
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        texels[4 * i + 3] = to_share(0.7F + 0.45F * field[i]);
}

static void make(struct bump_maps *maps, const struct bump_maps_params *params, float *field,
                 struct lattice *lattice)
{
    const size_t field_size = (size_t)SIZE * SIZE * sizeof(*field);
    const uint32_t seed = params->seed * 16;
    memset(field, 0, field_size);
    add_field(field, lattice, dimple, 7, 1.0F, seed);
    add_field(field, lattice, wave, 3, 0.8F, seed + 1);
    add_field(field, lattice, wave, 11, 0.14F, seed + 2);
    add_field(field, lattice, wave, 29, 0.025F, seed + 3);
    make_slopes(maps->texels, field);
    memset(field, 0, field_size);
    add_field(field, lattice, wave, 4, 0.8F, seed + 4);
    add_field(field, lattice, wave, 9, 0.35F, seed + 5);
    add_field(field, lattice, wave, 23, 0.12F, seed + 6);
    make_smooth(maps->texels, field, params->smooth);
    memset(field, 0, field_size);
    add_field(field, lattice, wave, 31, 0.6F, seed + 7);
    add_field(field, lattice, wave, 64, 0.5F, seed + 8);
    make_crystals(maps->texels, field);
}

bool bump_maps_init(struct bump_maps *maps, const struct bump_maps_params *params)
{
    float *field = malloc((size_t)SIZE * SIZE * sizeof(*field));
    struct lattice *lattice = malloc(sizeof(*lattice));
    *maps = (struct bump_maps){
        .texels = malloc((size_t)SIZE * SIZE * 4 * sizeof(*maps->texels)),
        .size = SIZE,
    };
    bool done = field && lattice && maps->texels;
    if (done)
        make(maps, params, field, lattice);
    else
        bump_maps_finish(maps);
    free(field);
    free(lattice);
    return done;
}

void bump_maps_finish(struct bump_maps *maps)
{
    free(maps->texels);
    *maps = (struct bump_maps){ 0 };
}
