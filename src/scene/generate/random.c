/* random.c: a hash of the count, keyed by the seed. */
#include "src/scene/generate/random.h"

#include <cglm/struct.h>

/* An integer hash with good avalanche (Wellons, "Prospecting for Hash Functions", 2018). */
static uint32_t scramble(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

struct random random_begin(uint32_t seed, uint32_t part)
{
    return (struct random){ .key = scramble(scramble(seed) + part) };
}

float random_unit(struct random *random)
{
    return (float)(scramble(random->key ^ scramble(random->count++)) >> 8) * 0x1p-24F;
}

static float random_signed(struct random *random)
{
    return 2 * random_unit(random) - 1;
}

vec3s random_box(struct random *random)
{
    vec3s v;
    for (int i = 0; i < 3; i++)
        v.raw[i] = random_signed(random);
    return v;
}

/* A point of the four-dimensional ball as a quaternion, without a sine, because libraries differ in
 * its last bit. */
mat3s random_rotation(struct random *random)
{
    versors q;
    float norm2;
    do {
        for (int i = 0; i < 4; i++)
            q.raw[i] = random_signed(random);
        norm2 = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    } while (norm2 > 1 || norm2 < 1e-4F);
    return glms_quat_mat3(glms_quat_normalize(q));
}
