/* format_table.c: properties of the formats that passes can draw to, sample, store or read as
 * vertex attributes. */
#include "graph/compile/compiler.h"

#define FORMAT(format, bytes, aspects, ...) \
    [VK_FORMAT_##format] = { VK_FORMAT_##format, #format, bytes, aspects, __VA_ARGS__ }
/* Colour formats, with SPIR-V's number of the image format, or 0. */
#define COLOR(format, bytes, number) \
    FORMAT(format, bytes, VK_IMAGE_ASPECT_COLOR_BIT, false, false, number)
#define COLOR_UINT(format, bytes, number) \
    FORMAT(format, bytes, VK_IMAGE_ASPECT_COLOR_BIT, true, false, number)
#define COLOR_SINT(format, bytes, number) \
    FORMAT(format, bytes, VK_IMAGE_ASPECT_COLOR_BIT, false, true, number)
#define DEPTH(format, bytes) FORMAT(format, bytes, VK_IMAGE_ASPECT_DEPTH_BIT, false, false)
#define DEPTH_STENCIL(format, bytes) \
    FORMAT(format, bytes, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT, false, false)

static const struct rg_format_info formats[] = {
    COLOR(R8_UNORM, 1, 15),
    COLOR_UINT(R8_UINT, 1, 39),
    COLOR(R8G8_UNORM, 2, 13),
    COLOR(R8G8_SNORM, 2, 18),
    COLOR(R8G8B8A8_UNORM, 4, 4),
    COLOR(R8G8B8A8_SNORM, 4, 5),
    COLOR_UINT(R8G8B8A8_UINT, 4, 32),
    COLOR_SINT(R8G8B8A8_SINT, 4, 23),
    COLOR(R8G8B8A8_SRGB, 4, 0),
    COLOR(B8G8R8A8_UNORM, 4, 0),
    COLOR(B8G8R8A8_SRGB, 4, 0),
    COLOR(A2B10G10R10_UNORM_PACK32, 4, 11),
    COLOR(B10G11R11_UFLOAT_PACK32, 4, 8),
    COLOR(E5B9G9R9_UFLOAT_PACK32, 4, 0),
    COLOR(R16_UNORM, 2, 14),
    COLOR_UINT(R16_UINT, 2, 38),
    COLOR(R16_SFLOAT, 2, 9),
    COLOR(R16G16_UNORM, 4, 12),
    COLOR(R16G16_SNORM, 4, 17),
    COLOR(R16G16_SFLOAT, 4, 7),
    COLOR(R16G16B16A16_UNORM, 8, 10),
    COLOR(R16G16B16A16_SNORM, 8, 16),
    COLOR_UINT(R16G16B16A16_UINT, 8, 31),
    COLOR_SINT(R16G16B16A16_SINT, 8, 22),
    COLOR(R16G16B16A16_SFLOAT, 8, 2),
    COLOR_UINT(R32_UINT, 4, 33),
    COLOR_SINT(R32_SINT, 4, 24),
    COLOR(R32_SFLOAT, 4, 3),
    COLOR_UINT(R32G32_UINT, 8, 35),
    COLOR_SINT(R32G32_SINT, 8, 25),
    COLOR(R32G32_SFLOAT, 8, 6),
    COLOR_UINT(R32G32B32_UINT, 12, 0),
    COLOR_SINT(R32G32B32_SINT, 12, 0),
    COLOR(R32G32B32_SFLOAT, 12, 0),
    COLOR_UINT(R32G32B32A32_UINT, 16, 30),
    COLOR_SINT(R32G32B32A32_SINT, 16, 21),
    COLOR(R32G32B32A32_SFLOAT, 16, 1),
    DEPTH(D16_UNORM, 2),
    DEPTH(X8_D24_UNORM_PACK32, 4),
    DEPTH(D32_SFLOAT, 4),
    DEPTH_STENCIL(D24_UNORM_S8_UINT, 4),
    DEPTH_STENCIL(D32_SFLOAT_S8_UINT, 8),
};

const struct rg_format_info *rg_format_info(VkFormat format)
{
    size_t index = (size_t)format; /* out of range if negative */
    if (index >= sizeof(formats) / sizeof(formats[0]) || !formats[index].name)
        return NULL;
    return &formats[index];
}

const struct rg_format_info *rg_storage_format(uint32_t number)
{
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
        if (number && formats[i].spirv_format == number)
            return &formats[i];
    }
    return NULL;
}
