/* stage_textures.c: generates textures of slate and of wooden boards from periodic value noise. */
#include "src/scene/stage/stage_textures.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/file/srgb.h"
#include "src/scene/generate/noise.h"

enum {
    SIZE = STAGE_TEXTURE_SIZE,
    BOARDS = 5, /* boards across the texture */
};

/* Colour and height of a point of the floor. */
struct sample {
    vec3s color;
    float height; /* texels */
};

/* Returns a random value from 0 to 1 of a lattice point. */
static float lattice(uint32_t x, uint32_t y, uint32_t seed)
{
    return (float)(noise_hash(x + 0x9e3779b9u * noise_hash(y + 0x85ebca6bu * seed)) >> 8) /
           16777216.0f;
}

/* Returns value noise from 0 to 1 at (u, v), with `across` and `along` lattice cells in the unit
 * square, beyond which the noise repeats. */
static float noise(float u, float v, uint32_t across, uint32_t along, uint32_t seed)
{
    const float x = (u - floorf(u)) * (float)across, y = (v - floorf(v)) * (float)along;
    const uint32_t x0 = (uint32_t)x % across, y0 = (uint32_t)y % along;
    const uint32_t x1 = (x0 + 1) % across, y1 = (y0 + 1) % along;
    const float fx = x - floorf(x), fy = y - floorf(y);
    const float sx = fx * fx * (3.0f - 2.0f * fx), sy = fy * fy * (3.0f - 2.0f * fy);
    const float upper = glm_lerp(lattice(x0, y0, seed), lattice(x1, y0, seed), sx);
    const float lower = glm_lerp(lattice(x0, y1, seed), lattice(x1, y1, seed), sx);
    return glm_lerp(upper, lower, sy);
}

/* Returns the sum of `octaves` noise fields, from 0 to 1. */
static float fractal(float u, float v, uint32_t cells, int octaves, uint32_t seed)
{
    float sum = 0.0f, weight = 0.5f;
    for (int i = 0; i < octaves; i++, weight *= 0.5f, cells *= 2)
        sum += weight * noise(u, v, cells, cells, seed + (uint32_t)i);
    return sum / (1.0f - 2.0f * weight);
}

/* Returns a point of cleft slate: terraces with broken edges, and fine grain. */
static struct sample slate_at(float u, float v)
{
    const float warp = 0.06f * (fractal(u, v, 6, 3, 11) - 0.5f);
    const float layer = 7.0f * fractal(u + warp, v - warp, 3, 4, 1);
    const float step = layer - floorf(layer);
    const float terrace = floorf(layer) + glm_smoothstep(0.0f, 0.16f, step);
    const float grain = fractal(u, v, 48, 4, 5);
    const float stain = fractal(u, v, 4, 4, 8);
    const float rust = glm_smoothstep(0.62f, 0.8f, fractal(u, v, 7, 4, 21));
    const float value = 0.052f + 0.030f * stain + 0.030f * grain + 0.003f * terrace;
    const vec3s cold = { { 0.94f * value, 0.99f * value, 1.06f * value } };
    const vec3s warm = { { 1.25f * value, 1.0f * value, 0.78f * value } };
    return (struct sample){ glms_vec3_lerp(cold, warm, 0.5f * rust),
                            2.6f * terrace + 5.0f * grain + 3.0f * stain };
}

/* Returns a point of oiled boards along v: rings that darken on one side, fibres and pores. */
static struct sample wood_at(float u, float v)
{
    const uint32_t board = (uint32_t)(u * BOARDS);
    const float across = u * BOARDS - (float)board, own = lattice(board, 3, 7);
    const float shifted = v + own;
    const float bend = noise(u, shifted, 2 * BOARDS, 4, 31 + board) +
                       0.3f * noise(u, shifted, 6 * BOARDS, 9, 37 + board);
    const float ring = (2.5f + 4.0f * own) * (across + 0.35f * bend) + 9.0f * own;
    const float late = ring - floorf(ring);
    const float dark = late < 0.86f ? powf(late / 0.86f, 3.0f) : (1.0f - late) / 0.14f;
    const float fibre = noise(u, shifted, 340, 10, 41) - 0.5f;
    const float pore = glm_smoothstep(0.80f, 0.95f, noise(u, shifted, 256, 40, 43));
    const float edge = fminf(across, 1.0f - across);
    const float gap = 1.0f - glm_smoothstep(0.004f, 0.016f, edge);
    const vec3s early_color = { { 0.300f, 0.165f, 0.080f } };
    const vec3s late_color = { { 0.165f, 0.080f, 0.036f } };
    const float tone = (0.82f + 0.36f * lattice(board, 5, 9)) * (1.0f + 0.16f * fibre) *
                       (1.0f - 0.35f * pore) * (1.0f - 0.85f * gap);
    return (struct sample){
        glms_vec3_scale(glms_vec3_lerp(early_color, late_color, 0.8f * dark), tone),
        0.5f * fibre - 0.5f * pore - 5.0f * gap - 0.2f * dark,
    };
}

static uint8_t byte_of(float x)
{
    return (uint8_t)lroundf(255.0f * glm_clamp(x, 0.0f, 1.0f));
}

/* Writes the normals of a height field that repeats. */
static void write_normals(uint8_t *texels, const float *heights)
{
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            const float *row = &heights[(size_t)y * SIZE];
            const float dx = row[(x + 1) % SIZE] - row[(x + SIZE - 1) % SIZE];
            const float dy = heights[(size_t)((y + 1) % SIZE) * SIZE + x] -
                             heights[(size_t)((y + SIZE - 1) % SIZE) * SIZE + x];
            const vec3s n = glms_vec3_normalize((vec3s){ { -0.25f * dx, 0.25f * dy, 1.0f } });
            uint8_t *texel = &texels[((size_t)y * SIZE + x) * 4];
            for (int k = 0; k < 3; k++)
                texel[k] = byte_of(0.5f + 0.5f * n.raw[k]);
            texel[3] = 255;
        }
    }
}

bool stage_textures_generate(struct stage_textures *textures, bool is_wood)
{
    const size_t count = (size_t)SIZE * SIZE;
    float *heights = malloc(count * sizeof(*heights));
    *textures = (struct stage_textures){ malloc(4 * count), malloc(4 * count), { { 0 } } };
    if (!heights || !textures->colors || !textures->normals) {
        free(heights);
        free(textures->colors);
        free(textures->normals);
        *textures = (struct stage_textures){ 0 };
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t x = i % SIZE, y = i / SIZE;
        const float u = ((float)x + 0.5f) / SIZE, v = ((float)y + 0.5f) / SIZE;
        const struct sample at = is_wood ? wood_at(u, v) : slate_at(u, v);
        for (int k = 0; k < 3; k++)
            textures->colors[4 * i + (size_t)k] = byte_of(srgb_encode(at.color.raw[k]));
        textures->colors[4 * i + 3] = 255;
        heights[i] = at.height;
        textures->mean = glms_vec3_add(textures->mean, at.color);
    }
    textures->mean = glms_vec3_divs(textures->mean, (float)count);
    write_normals(textures->normals, heights);
    free(heights);
    return true;
}
