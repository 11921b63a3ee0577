/* random.c: random numbers hashed from a seed and a counter. */
#include "src/scene/generate/random.h"

#include <cglm/struct.h>
#include "src/scene/generate/noise.h"

struct random random_begin(uint32_t seed, uint32_t part)
{
    return (struct random){ .key = noise_hash(noise_hash(seed) + part) };
}

float random_unit(struct random *random)
{
    return (float)(noise_hash(random->key ^ noise_hash(random->count++)) >> 8) * 0x1p-24F;
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

/* Normalises a random point of the 4D unit ball to a quaternion. Avoids sines, which differ between
 * C libraries. */
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
