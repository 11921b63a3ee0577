/* interpret_texel_format.c: encodes and decodes texels by format for the reference interpreter. */
#include "tests/support/interpret_texel_format.h"

#include <assert.h>

struct channels {
    uint32_t count, bits;
};

static struct channels channels_of(VkFormat format)
{
    switch ((int)format) {
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
        return (struct channels){ 1, 32 };
    case VK_FORMAT_R32G32_UINT:
        return (struct channels){ 2, 32 };
    case VK_FORMAT_R8G8B8A8_UINT:
        return (struct channels){ 4, 8 };
    case VK_FORMAT_R16G16B16A16_UINT:
        return (struct channels){ 4, 16 };
    case VK_FORMAT_R32G32B32A32_UINT:
        return (struct channels){ 4, 32 };
    default:
        assert(false);
        return (struct channels){ 0, 0 };
    }
}

uint32_t interpret_format_mask(VkFormat format)
{
    return UINT32_MAX >> (32 - channels_of(format).bits);
}

uint32_t interpret_format_size(VkFormat format)
{
    const struct channels channels = channels_of(format);
    return channels.count * channels.bits / 8;
}

void interpret_format_store(uint32_t *texel, VkFormat format, const uint32_t value[4])
{
    static const uint32_t missing[4] = { 0, 0, 0, 1 };
    const uint32_t count = channels_of(format).count;
    const bool has_stencil = format == VK_FORMAT_D32_SFLOAT_S8_UINT;
    for (uint32_t i = 0; i < 4; i++)
        texel[i] = i < count ? value[i] & interpret_format_mask(format) : missing[i];
    if (has_stencil)
        texel[1] = value[1] & 0xff;
}

void interpret_format_decode(uint32_t *texel, VkFormat format, const unsigned char *bytes)
{
    const struct channels channels = channels_of(format);
    uint32_t value[4] = { 0 };
    for (uint32_t i = 0; i < channels.count * channels.bits / 8; i++)
        value[i * 8 / channels.bits] |= (uint32_t)bytes[i] << i * 8 % channels.bits;
    interpret_format_store(texel, format, value);
}

void interpret_format_encode(unsigned char *bytes, VkFormat format, const uint32_t *texel)
{
    const struct channels channels = channels_of(format);
    for (uint32_t i = 0; i < channels.count * channels.bits / 8; i++)
        bytes[i] = (unsigned char)(texel[i * 8 / channels.bits] >> i * 8 % channels.bits);
}
