/* mtl_texture_convert.c: converts MTL map images to glTF's: alpha and normals. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/importer.h"

enum {
    CHANNELS = 4,
    RELIEF = 64,          /* white is width / RELIEF high */
    BLUE_OF_NORMALS = 16, /* mean |blue-red| of a normal map */
};

static uint8_t grey_of(const uint8_t *texel)
{
    return (uint8_t)((texel[0] + texel[1] + texel[2] + 1) / 3);
}

static void convert_alpha(uint8_t *texels, size_t count)
{
    bool has_alpha = false;
    for (size_t i = 0; i < count; i++)
        has_alpha |= texels[CHANNELS * i + 3] < UINT8_MAX;
    for (size_t i = 0; i < count; i++) {
        uint8_t *texel = &texels[CHANNELS * i];
        texel[3] = has_alpha ? texel[3] : grey_of(texel);
        memset(texel, UINT8_MAX, 3);
    }
}

static bool are_normals(const uint8_t *texels, size_t count)
{
    uint64_t difference = 0;
    for (size_t i = 0; i < count; i++)
        difference += (uint64_t)abs(texels[CHANNELS * i + 2] - texels[CHANNELS * i]);
    return difference > BLUE_OF_NORMALS * (uint64_t)count;
}

/* Converts a tileable height map to a normal map by central differences. If the image is already a
 * normal map, leaves it unchanged. If out of memory, returns false. */
static bool convert_heights(uint8_t *texels, int width, int height)
{
    const size_t count = (size_t)width * (size_t)height;
    if (are_normals(texels, count))
        return true;
    uint8_t *heights = malloc(count);
    if (!heights)
        return false;
    for (size_t i = 0; i < count; i++)
        heights[i] = grey_of(&texels[CHANNELS * i]);
    for (int y = 0; y < height; y++) {
        const uint8_t *above = &heights[(size_t)((y + height - 1) % height) * (size_t)width];
        const uint8_t *below = &heights[(size_t)((y + 1) % height) * (size_t)width];
        const uint8_t *row = &heights[(size_t)y * (size_t)width];
        for (int x = 0; x < width; x++) {
            const float step = 2.0F * UINT8_MAX * RELIEF;
            const float difference = (float)(row[(x + 1) % width] - row[(x + width - 1) % width]);
            const vec3s normal = glms_vec3_normalize((vec3s){ {
                -difference * (float)width / step,
                (float)(below[x] - above[x]) * (float)height / step,
                1,
            } });
            uint8_t *texel = &texels[CHANNELS * ((size_t)y * (size_t)width + (size_t)x)];
            for (int k = 0; k < 3; k++)
                texel[k] = (uint8_t)lroundf(127.5F + 127.5F * normal.raw[k]);
        }
    }
    free(heights);
    return true;
}

bool model_texture_convert(uint8_t *texels, int width, int height,
                           const struct model_texture *texture)
{
    if (texture->change == MODEL_TEXTURE_TO_NORMALS)
        return convert_heights(texels, width, height);
    if (texture->change == MODEL_TEXTURE_TO_ALPHA)
        convert_alpha(texels, (size_t)width * (size_t)height);
    return true;
}
