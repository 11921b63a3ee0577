/* format_table.c: properties of the formats that passes can draw to, sample or store. */
#include "graph/rg.h"

#define FORMAT(format, bytes, aspects, ...) \
    [VK_FORMAT_##format] = { VK_FORMAT_##format, #format, bytes, aspects, __VA_ARGS__ }
#define COLOR(format, bytes)      FORMAT(format, bytes, VK_IMAGE_ASPECT_COLOR_BIT, false, false)
#define COLOR_UINT(format, bytes) FORMAT(format, bytes, VK_IMAGE_ASPECT_COLOR_BIT, true, false)
#define COLOR_SINT(format, bytes) FORMAT(format, bytes, VK_IMAGE_ASPECT_COLOR_BIT, false, true)
#define DEPTH(format, bytes)      FORMAT(format, bytes, VK_IMAGE_ASPECT_DEPTH_BIT, false, false)
#define DEPTH_STENCIL(format, bytes) \
    FORMAT(format, bytes, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT, false, false)

static const struct rg_format_info formats[] = {
    COLOR(R8_UNORM, 1),
    COLOR_UINT(R8_UINT, 1),
    COLOR(R8G8_UNORM, 2),
    COLOR(R8G8_SNORM, 2),
    COLOR(R8G8B8A8_UNORM, 4),
    COLOR(R8G8B8A8_SNORM, 4),
    COLOR_UINT(R8G8B8A8_UINT, 4),
    COLOR(R8G8B8A8_SRGB, 4),
    COLOR(B8G8R8A8_UNORM, 4),
    COLOR(B8G8R8A8_SRGB, 4),
    COLOR(A2B10G10R10_UNORM_PACK32, 4),
    COLOR(B10G11R11_UFLOAT_PACK32, 4),
    COLOR(E5B9G9R9_UFLOAT_PACK32, 4),
    COLOR(R16_UNORM, 2),
    COLOR_UINT(R16_UINT, 2),
    COLOR(R16_SFLOAT, 2),
    COLOR(R16G16_UNORM, 4),
    COLOR(R16G16_SNORM, 4),
    COLOR(R16G16_SFLOAT, 4),
    COLOR(R16G16B16A16_UNORM, 8),
    COLOR(R16G16B16A16_SNORM, 8),
    COLOR_UINT(R16G16B16A16_UINT, 8),
    COLOR(R16G16B16A16_SFLOAT, 8),
    COLOR_UINT(R32_UINT, 4),
    COLOR_SINT(R32_SINT, 4),
    COLOR(R32_SFLOAT, 4),
    COLOR_UINT(R32G32_UINT, 8),
    COLOR(R32G32_SFLOAT, 8),
    COLOR_UINT(R32G32B32A32_UINT, 16),
    COLOR(R32G32B32A32_SFLOAT, 16),
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
