/* noise.c: value noise on a hashed integer lattice. */
#include "src/scene/generate/noise.h"

#include <cglm/struct.h>
#include <math.h>

/* Hashes an integer with good avalanche (Wellons, "Prospecting for Hash Functions", 2018). */
uint32_t noise_hash(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

static float fade(float t)
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

/* Lattice cell along one axis, with its lower coordinate and the weight of its upper point. */
struct cell {
    uint32_t at;
    float next;
};

static struct cell find_cell(float x)
{
    float below = floorf(x);
    return (struct cell){ (uint32_t)(int32_t)below, fade(x - below) };
}

static float value(uint32_t hash)
{
    return (float)(hash >> 8) / 8388607.5F - 1;
}

static float along_z(uint32_t hash, struct cell z)
{
    return glm_lerp(value(noise_hash(hash ^ z.at)), value(noise_hash(hash ^ (z.at + 1))), z.next);
}

static float along_y(uint32_t hash, struct cell y, struct cell z)
{
    return glm_lerp(along_z(noise_hash(hash ^ y.at), z), along_z(noise_hash(hash ^ (y.at + 1)), z),
                    y.next);
}

float noise_value(vec3s p, uint32_t seed)
{
    struct cell x = find_cell(p.x), y = find_cell(p.y), z = find_cell(p.z);
    uint32_t hash = noise_hash(seed);
    return glm_lerp(along_y(noise_hash(hash ^ x.at), y, z),
                    along_y(noise_hash(hash ^ (x.at + 1)), y, z), x.next);
}

vec3s noise_vector(vec3s p, uint32_t seed)
{
    return (vec3s){ {
        noise_value(p, seed),
        noise_value(p, seed + 0x10000),
        noise_value(p, seed + 0x20000),
    } };
}

void noise_plane_init(struct noise_plane *plane, int octaves, uint32_t seed)
{
    plane->octaves = octaves;
    for (uint32_t i = 0; i < (uint32_t)octaves; i++) {
        for (uint32_t x = 0; x < NOISE_PLANE_SIDE_MAX; x++) {
            for (uint32_t y = 0; y < NOISE_PLANE_SIDE_MAX; y++)
                plane->corners[i][x][y] =
                    value(noise_hash(noise_hash(noise_hash(noise_hash(seed + i) ^ x) ^ y)));
        }
    }
}

float noise_plane_at(const struct noise_plane *plane, float x, float y)
{
    float sum = 0;
    float height = 1;
    for (int i = 0; i < plane->octaves; i++) {
        const uint32_t column = (uint32_t)x, row = (uint32_t)y;
        const float down = fade(y - (float)row);
        const float *left = &plane->corners[i][column][row];
        const float *right = &plane->corners[i][column + 1][row];
        sum += height * glm_lerp(glm_lerp(left[0], left[1], down),
                                 glm_lerp(right[0], right[1], down), fade(x - (float)column));
        x *= 2;
        y *= 2;
        height /= 2;
    }
    return sum;
}

float noise_fractal(vec3s p, int octaves, uint32_t seed)
{
    float sum = 0;
    float height = 1;
    for (int i = 0; i < octaves; i++) {
        sum += height * noise_value(p, seed + (uint32_t)i);
        p = glms_vec3_scale(p, 2);
        height /= 2;
    }
    return sum;
}
