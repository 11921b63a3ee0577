/* format.c: names, sizes and aspects of formats a pass can draw to, sample or store. */
#include "graph/rg.h"

#define COLOR(format, bytes) \
    [VK_FORMAT_##format] = { \
        VK_FORMAT_##format, \
        #format, \
        bytes, \
        VK_IMAGE_ASPECT_COLOR_BIT, \
    }

static const struct rg_format_info formats[] = {
    COLOR(R8_UNORM, 1),
    COLOR(R8_UINT, 1),
    COLOR(R8G8_UNORM, 2),
    COLOR(R8G8_SNORM, 2),
    COLOR(R8G8B8A8_UNORM, 4),
    COLOR(R8G8B8A8_SNORM, 4),
    COLOR(R8G8B8A8_UINT, 4),
    COLOR(R8G8B8A8_SRGB, 4),
    COLOR(B8G8R8A8_UNORM, 4),
    COLOR(B8G8R8A8_SRGB, 4),
    COLOR(A2B10G10R10_UNORM_PACK32, 4),
    COLOR(B10G11R11_UFLOAT_PACK32, 4),
    COLOR(E5B9G9R9_UFLOAT_PACK32, 4),
    COLOR(R16_UNORM, 2),
    COLOR(R16_UINT, 2),
    COLOR(R16_SFLOAT, 2),
    COLOR(R16G16_UNORM, 4),
    COLOR(R16G16_SNORM, 4),
    COLOR(R16G16_SFLOAT, 4),
    COLOR(R16G16B16A16_UNORM, 8),
    COLOR(R16G16B16A16_SNORM, 8),
    COLOR(R16G16B16A16_UINT, 8),
    COLOR(R16G16B16A16_SFLOAT, 8),
    COLOR(R32_UINT, 4),
    COLOR(R32_SINT, 4),
    COLOR(R32_SFLOAT, 4),
    COLOR(R32G32_UINT, 8),
    COLOR(R32G32_SFLOAT, 8),
    COLOR(R32G32B32A32_UINT, 16),
    COLOR(R32G32B32A32_SFLOAT, 16),
    [VK_FORMAT_D16_UNORM] = { VK_FORMAT_D16_UNORM, "D16_UNORM", 2, VK_IMAGE_ASPECT_DEPTH_BIT },
    [VK_FORMAT_X8_D24_UNORM_PACK32] = { VK_FORMAT_X8_D24_UNORM_PACK32, "X8_D24_UNORM_PACK32", 4,
                                        VK_IMAGE_ASPECT_DEPTH_BIT },
    [VK_FORMAT_D32_SFLOAT] = { VK_FORMAT_D32_SFLOAT, "D32_SFLOAT", 4, VK_IMAGE_ASPECT_DEPTH_BIT },
    [VK_FORMAT_D24_UNORM_S8_UINT] = { VK_FORMAT_D24_UNORM_S8_UINT, "D24_UNORM_S8_UINT", 4,
                                      VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT },
    [VK_FORMAT_D32_SFLOAT_S8_UINT] = { VK_FORMAT_D32_SFLOAT_S8_UINT, "D32_SFLOAT_S8_UINT", 8,
                                       VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT },
};

const struct rg_format_info *rg_format_info(VkFormat format)
{
    size_t index = (size_t)format; /* a negative one is beyond the table, too */
    if (index >= sizeof(formats) / sizeof(formats[0]) || !formats[index].name)
        return NULL;
    return &formats[index];
}
