/*
 * image_based_lighting.c: prefilters an environment for image-based lighting (split-sum). Glossy
 * lobes are importance-sampled with GGX. Each sample reads a mip level that matches the sample
 * density, because few samples would cause fireflies (Krivanek and Colbert 2008, "Real-time shading
 * with filtered importance sampling"). The diffuse lobe sums all texels of a small level.
 */
#include "src/scene/environment/image_based_lighting.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "shaders/brdf.h"
#include "shaders/surroundings/surroundings.h"
#include "src/file/half_float.h"

enum {
    LEVEL_MAX = 10,
    WIDTH_MAX = 1024,   /* width of the finest level */
    DIFFUSE_WIDTH = 32, /* width of the level for diffuse lobes */
    SAMPLE_COUNT = 64,  /* samples per glossy lobe */
    SPLIT_SAMPLE_COUNT = 256,
    OVERLAP = 4, /* solid angle of a mip texel, relative to that of a sample */
};

static const float pi = 3.14159265358979f;

/* Tangents of normals rotate with these about the vertical axis if their cosine to it is lower. */
#define AXIS_COSINE 0.9f

/* Mip chain of the environment. */
struct levels {
    vec3s *texels[LEVEL_MAX];
    int width[LEVEL_MAX]; /* level widths: powers of two, twice the heights */
    int count;
    vec3s diffuse_dirs[DIFFUSE_WIDTH * DIFFUSE_WIDTH / 2]; /* of the diffuse lobe's texels */
};

static vec3s texel_direction(float u, float v)
{
    const float around = (u - 0.5f) * 2.0f * pi;
    const float down = v * pi;
    return (vec3s){ { sinf(down) * sinf(around), cosf(down), -sinf(down) * cosf(around) } };
}

/* Returns the mean of the environment's texels that one texel of the first level covers. */
static vec3s mean_of(const struct environment *e, uint32_t x, uint32_t y, uint32_t width)
{
    const uint32_t height = width / 2;
    const uint32_t left = x * e->width / width;
    const uint32_t top = y * e->height / height;
    uint32_t right = (x + 1) * e->width / width;
    uint32_t bottom = (y + 1) * e->height / height;
    right = right > left ? right : left + 1;
    bottom = bottom > top ? bottom : top + 1;
    vec3s sum = glms_vec3_zero();
    for (uint32_t row = top; row < bottom; row++) {
        for (uint32_t column = left; column < right; column++) {
            const uint16_t *texel = &e->texels[((size_t)row * e->width + column) * 4];
            for (int k = 0; k < 3; k++)
                sum.raw[k] += half_to_float(texel[k]);
        }
    }
    return glms_vec3_divs(sum, (float)((right - left) * (bottom - top)));
}

/* Returns the mean of four texels of the next finer level. */
static vec3s mean_of_four(const vec3s *finer, size_t x, size_t y, size_t width)
{
    const vec3s *above = &finer[4 * y * width + 2 * x];
    const vec3s *below = above + 2 * width;
    return glms_vec3_scale(
        glms_vec3_add(glms_vec3_add(above[0], above[1]), glms_vec3_add(below[0], below[1])), 0.25f);
}

static bool make_levels(struct levels *levels, const struct environment *e)
{
    int width = DIFFUSE_WIDTH;
    while (width < WIDTH_MAX && (uint32_t)width < e->width)
        width *= 2;
    *levels = (struct levels){ .count = 0 };
    for (int i = 0; i < DIFFUSE_WIDTH * DIFFUSE_WIDTH / 2; i++) {
        const int x = i % DIFFUSE_WIDTH, y = i / DIFFUSE_WIDTH;
        levels->diffuse_dirs[i] = texel_direction(((float)x + 0.5f) / (float)DIFFUSE_WIDTH,
                                                  ((float)y + 0.5f) / (0.5f * DIFFUSE_WIDTH));
    }
    for (; width >= 4 && levels->count < LEVEL_MAX; width /= 2, levels->count++) {
        const size_t count = (size_t)width * ((size_t)width / 2);
        vec3s *texels = malloc(count * sizeof(*texels));
        if (!texels)
            return false;
        levels->texels[levels->count] = texels;
        levels->width[levels->count] = width;
        for (size_t i = 0; i < count; i++) {
            const size_t x = i % (size_t)width, y = i / (size_t)width;
            texels[i] = levels->count
                            ? mean_of_four(levels->texels[levels->count - 1], x, y, (size_t)width)
                            : mean_of(e, (uint32_t)x, (uint32_t)y, (uint32_t)width);
        }
    }
    return true;
}

/* Returns a bilinearly interpolated sample of a level. */
static vec3s sample_level(const struct levels *levels, int level, vec2s uv)
{
    const int width = levels->width[level], height = width / 2;
    const float x = uv.x * (float)width - 0.5f;
    const float y = fminf(fmaxf(uv.y * (float)height - 0.5f, 0.0f), (float)height - 1.0f);
    const int left = (int)x - (x < 0.0f), top = (int)y;
    const int below = top + 1 < height ? top + 1 : top;
    const int columns[2] = { left & (width - 1), (left + 1) & (width - 1) };
    const vec3s *texels = levels->texels[level];
    const float across = x - (float)left, down = y - (float)top;
    const vec3s upper =
        glms_vec3_lerp(texels[top * width + columns[0]], texels[top * width + columns[1]], across);
    const vec3s lower = glms_vec3_lerp(texels[below * width + columns[0]],
                                       texels[below * width + columns[1]], across);
    return glms_vec3_lerp(upper, lower, down);
}

/* Returns the coarsest level whose texels subtend at most `solid_angle`, or level 0. */
static int level_of(const struct levels *levels, float solid_angle)
{
    int level = 0;
    while (level + 1 < levels->count) {
        const float width = (float)levels->width[level + 1];
        if (4.0f * pi / (width * width / 2.0f) > solid_angle)
            break;
        level++;
    }
    return level;
}

/* GGX sample of the light direction, in a frame where the normal and the view direction are +Z. */
struct light_sample {
    vec3s from;
    float weight;
    int level;
};

static float radical_inverse(uint32_t i)
{
    uint32_t bits = 0;
    for (int k = 0; k < 32; k++)
        bits |= (i >> k & 1u) << (31 - k);
    return (float)bits * 0x1p-32f;
}

static void make_samples(struct light_sample *samples, const struct levels *levels, float roughness)
{
    const float square = powf(roughness, 4.0f);
    for (uint32_t i = 0; i < SAMPLE_COUNT; i++) {
        const float u = ((float)i + 0.5f) / SAMPLE_COUNT;
        const float around = 2.0f * pi * radical_inverse(i);
        const float z = sqrtf((1.0f - u) / (1.0f + (square - 1.0f) * u));
        const float side = sqrtf(fmaxf(0.0f, 1.0f - z * z));
        const vec3s h = { { side * cosf(around), side * sinf(around), z } };
        const float d = z * z * (square - 1.0f) + 1.0f;
        const float density = square / (pi * d * d) / 4.0f;
        samples[i].from = (vec3s){ { 2.0f * z * h.x, 2.0f * z * h.y, 2.0f * z * z - 1.0f } };
        samples[i].weight = fmaxf(0.0f, samples[i].from.z);
        samples[i].level = level_of(levels, OVERLAP / (SAMPLE_COUNT * density));
    }
}

/* Computes the equirectangular coordinates of the samples around a normal. */
static void place_samples(vec2s uv[static SAMPLE_COUNT], const struct light_sample *samples,
                          vec3s n)
{
    const vec3s other = { { fabsf(n.y) < AXIS_COSINE ? 0.0f : 1.0f,
                            fabsf(n.y) < AXIS_COSINE ? 1.0f : 0.0f, 0.0f } };
    const vec3s x = glms_vec3_normalize(glms_vec3_cross(other, n));
    const vec3s y = glms_vec3_cross(n, x);
    for (uint32_t i = 0; i < SAMPLE_COUNT; i++) {
        const vec3s from = samples[i].from;
        const vec3s dir =
            glms_vec3_muladds(x, from.x, glms_vec3_muladds(y, from.y, glms_vec3_scale(n, from.z)));
        uv[i] = surroundings_equirect_uv(dir, 0.0f);
    }
}

/* Returns the radiance of a glossy lobe, with the sample coordinates `uv` shifted by `turn`. */
static vec3s glossy_radiance(const struct levels *levels, const struct light_sample *samples,
                             const vec2s *uv, float turn)
{
    vec3s sum = glms_vec3_zero();
    float weights = 0.0f;
    for (uint32_t i = 0; i < SAMPLE_COUNT; i++) {
        const vec2s at = { { uv[i].x + turn, uv[i].y } };
        if (!(samples[i].weight > 0.0f))
            continue;
        sum = glms_vec3_muladds(sample_level(levels, samples[i].level, at), samples[i].weight, sum);
        weights += samples[i].weight;
    }
    return glms_vec3_divs(sum, weights);
}

static vec3s diffuse_irradiance(const struct levels *levels, vec3s n)
{
    int level = 0;
    while (levels->width[level] > DIFFUSE_WIDTH)
        level++;
    const int width = levels->width[level], height = width / 2;
    vec3s sum = glms_vec3_zero();
    float weights = 0.0f;
    for (int row = 0; row < height; row++) {
        const float v = ((float)row + 0.5f) / (float)height;
        const float area = sinf(v * pi);
        for (int column = 0; column < width; column++) {
            const vec3s dir = levels->diffuse_dirs[row * width + column];
            const float weight = fmaxf(0.0f, glms_vec3_dot(n, dir)) * area;
            sum = glms_vec3_muladds(levels->texels[level][row * width + column], weight, sum);
            weights += weight;
        }
    }
    return glms_vec3_divs(sum, weights);
}

/* Rows near the horizon compute the coordinates of the samples once: those of the other texels are
 * rotated about the vertical axis. */
static void fill_layer(uint16_t *texels, const struct levels *levels, int layer)
{
    struct light_sample samples[SAMPLE_COUNT];
    vec2s uv[SAMPLE_COUNT];
    const bool is_diffuse = layer == LIT_DIFFUSE_LAYER;
    if (!is_diffuse)
        make_samples(samples, levels, ((float)layer + 1.0f) / LIT_ROUGH_LAYERS);
    for (int i = 0; i < LIT_WIDTH * LIT_HEIGHT; i++) {
        const int x = i % LIT_WIDTH, y = i / LIT_WIDTH;
        const vec3s n =
            texel_direction(((float)x + 0.5f) / LIT_WIDTH, ((float)y + 0.5f) / LIT_HEIGHT);
        const bool rotates = fabsf(n.y) < AXIS_COSINE;
        if (!is_diffuse && (x == 0 || !rotates))
            place_samples(uv, samples, n);
        const float turn = rotates ? (float)x / LIT_WIDTH : 0.0f;
        const vec3s light =
            is_diffuse ? diffuse_irradiance(levels, n) : glossy_radiance(levels, samples, uv, turn);
        for (int k = 0; k < 3; k++)
            texels[4 * i + k] = half_from_float(fminf(light.raw[k], 65504.0f));
        texels[4 * i + 3] = half_from_float(1.0f);
    }
}

uint16_t *image_based_lighting_prefilter(const struct environment *environment)
{
    const size_t layer_size = (size_t)LIT_WIDTH * LIT_HEIGHT * 4;
    struct levels levels;
    uint16_t *texels = malloc(LIT_LAYERS * layer_size * sizeof(*texels));
    if (!make_levels(&levels, environment)) {
        free(texels);
        texels = NULL;
    }
    for (int layer = 0; texels && layer < LIT_LAYERS; layer++)
        fill_layer(&texels[(size_t)layer * layer_size], &levels, layer);
    for (int i = 0; i < levels.count; i++)
        free(levels.texels[i]);
    return texels;
}

/* Returns Smith's masking function of GGX (Walter et al. 2007); `square` is alpha squared. */
static float smith_masking(float cosine, float square)
{
    return 2.0f * cosine / (cosine + sqrtf(square + (1.0f - square) * cosine * cosine));
}

/* Returns scale and bias of F0 in the split-sum approximation, by GGX importance sampling. */
static vec2s integrate_brdf(float roughness, float cosine)
{
    const float square = powf(roughness, 4.0f);
    const vec3s to_camera = { { sqrtf(1.0f - cosine * cosine), 0.0f, cosine } };
    vec2s sum = glms_vec2_zero();
    for (uint32_t i = 0; i < SPLIT_SAMPLE_COUNT; i++) {
        const float u = ((float)i + 0.5f) / SPLIT_SAMPLE_COUNT;
        const float around = 2.0f * pi * radical_inverse(i);
        const float z = sqrtf((1.0f - u) / (1.0f + (square - 1.0f) * u));
        const float side = sqrtf(fmaxf(0.0f, 1.0f - z * z));
        const vec3s h = { { side * cosf(around), side * sinf(around), z } };
        const float view_dot_h = glms_vec3_dot(to_camera, h);
        const float light = 2.0f * view_dot_h * z - cosine;
        if (light <= 0.0f || view_dot_h <= 0.0f)
            continue;
        const float weight = smith_masking(light, square) * smith_masking(cosine, square) *
                             view_dot_h / (z * cosine * SPLIT_SAMPLE_COUNT);
        const float schlick = powf(1.0f - view_dot_h, 5.0f);
        sum.x += (1.0f - schlick) * weight;
        sum.y += schlick * weight;
    }
    return sum;
}

uint16_t *image_based_lighting_brdf_table(void)
{
    const size_t side = LIT_SPLIT_SIDE;
    uint16_t *texels = malloc(2 * side * side * sizeof(*texels));
    for (size_t i = 0; texels && i < side * side; i++) {
        const size_t row = i / side, column = i % side;
        const float root = (float)column / (float)(side - 1);
        const float roughness = (float)row / (float)(side - 1);
        const vec2s split = integrate_brdf(fmaxf(roughness, 0.02f), fmaxf(root * root, 1e-3f));
        texels[2 * i] = half_from_float(split.x);
        texels[2 * i + 1] = half_from_float(split.y);
    }
    return texels;
}

/* A light is dominant if its brightest texel exceeds DOMINANT_RATIO times the mean. The light's
 * other texels are at least DOMINANT_FRACTION as bright as its brightest texel. */
#define DOMINANT_FRACTION 0.35f
#define DOMINANT_RATIO    4.0f
#define DOMINANT_COSINE   0.75f /* minimum cosine of the angle to the brightest texel */
#define DOMINANT_MARGIN   0.02f /* margin of the cone's cosine */

/* Returns the brightness and the direction of a texel in the layer of lowest roughness. */
static float light_texel(const uint16_t *table, size_t i, vec3s *dir)
{
    const size_t x = i % LIT_WIDTH, y = i / LIT_WIDTH;
    *dir = texel_direction(((float)x + 0.5f) / LIT_WIDTH, ((float)y + 0.5f) / LIT_HEIGHT);
    return half_to_float(table[4 * i]) + half_to_float(table[4 * i + 1]) +
           half_to_float(table[4 * i + 2]);
}

vec4s image_based_lighting_dominant_cone(const struct environment *environment,
                                         const uint16_t *table)
{
    const vec4s none = { { 0.0f, 0.0f, 0.0f, 1.0f } };
    const size_t count = (size_t)LIT_WIDTH * LIT_HEIGHT;
    float maximum = 0.0f, mean = 0.0f, cosine = 1.0f;
    vec3s dir, brightest = { { 0.0f, 1.0f, 0.0f } }, axis = glms_vec3_zero();
    if (!table)
        return none;
    for (size_t i = 0; i < count; i++) {
        const float light = light_texel(table, i, &dir);
        mean += light * sqrtf(1.0f - dir.y * dir.y) * 0.5f * pi / (float)count;
        if (light > maximum)
            brightest = dir;
        maximum = fmaxf(maximum, light);
    }
    if (!(maximum > DOMINANT_RATIO * mean))
        return none;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < count; i++) {
            const float light = light_texel(table, i, &dir);
            if (light < DOMINANT_FRACTION * maximum ||
                glms_vec3_dot(dir, brightest) < DOMINANT_COSINE)
                continue;
            if (pass == 0)
                axis = glms_vec3_muladds(dir, light * sqrtf(1.0f - dir.y * dir.y), axis);
            else
                cosine = fminf(cosine, glms_vec3_dot(dir, axis));
        }
        axis = glms_vec3_normalize(axis);
    }
    axis = glms_vec3_rotate(axis, environment->turn * 2.0f * pi, (vec3s){ { 0.0f, 1.0f, 0.0f } });
    return glms_vec4(axis, fmaxf(cosine - DOMINANT_MARGIN, 0.0f));
}
