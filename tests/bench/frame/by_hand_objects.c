/* by_hand_objects.c: images, buffers and samplers. */
#include <math.h>

#include "tests/bench/frame/by_hand_private.h"

#include "src/tech/frame_resources.h"

#define TARGET VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
#define DEPTHS VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
#define READ   VK_IMAGE_USAGE_SAMPLED_BIT

const struct image_row by_hand_images[IMAGE_COUNT] = {
    [CUBE] = { VK_FORMAT_R16G16B16A16_SFLOAT, FACE_COUNT, TARGET | READ },
    [CUBE_DEPTH] = { VK_FORMAT_D32_SFLOAT, FACE_COUNT, DEPTHS },
    [COLOR] = { VK_FORMAT_R16G16B16A16_SFLOAT, 1, TARGET | READ },
    [DEPTH] = { VK_FORMAT_D32_SFLOAT, 1, DEPTHS },
    [NORMAL] = { VK_FORMAT_R16G16B16A16_SFLOAT, 1, TARGET | READ },
    [NORMAL_DEPTH] = { VK_FORMAT_D32_SFLOAT, 1, DEPTHS },
    [HIGHLIGHT] = { VK_FORMAT_R32_SFLOAT, 1, TARGET },
    [SCREEN] = { VK_FORMAT_R8G8B8A8_UNORM, 1, TARGET | VK_IMAGE_USAGE_TRANSFER_SRC_BIT },
};

static VkDeviceMemory take_memory(const struct by_hand *h, VkMemoryRequirements need,
                                  VkMemoryPropertyFlags wanted)
{
    const VkPhysicalDeviceMemoryProperties *types = &h->params.gpu->memory;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    for (uint32_t i = 0; i < types->memoryTypeCount && !memory; i++) {
        if (!(need.memoryTypeBits & 1u << i) || ~types->memoryTypes[i].propertyFlags & wanted)
            continue;
        VK(vkAllocateMemory(h->device,
                            &(VkMemoryAllocateInfo){
                                .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                .allocationSize = need.size,
                                .memoryTypeIndex = i,
                            },
                            NULL, &memory));
    }
    assert_true(memory);
    return memory;
}

VkImageView by_hand_view(const struct by_hand *h, VkImage image, VkFormat format,
                         VkImageViewType type, uint32_t layer)
{
    const bool is_depth = format == VK_FORMAT_D32_SFLOAT;
    VkImageView view;
    VK(vkCreateImageView(
        h->device,
        &(VkImageViewCreateInfo){
            .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
            .image = image,
            .viewType = type,
            .format = format,
            .subresourceRange = { is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT,
                                  0, VK_REMAINING_MIP_LEVELS, layer,
                                  type == VK_IMAGE_VIEW_TYPE_2D ? 1 : VK_REMAINING_ARRAY_LAYERS },
        },
        NULL, &view));
    return view;
}

VkExtent2D by_hand_size(const struct by_hand *h, uint32_t i)
{
    if (i == CUBE || i == CUBE_DEPTH)
        return (VkExtent2D){ frame_env_cube.width, frame_env_cube.height };
    return (VkExtent2D){ h->params.width, h->params.height };
}

static void make_image(struct by_hand *h, uint32_t i)
{
    const struct image_row *row = &by_hand_images[i];
    const VkExtent2D size = by_hand_size(h, i);
    VkMemoryRequirements need;
    VK(vkCreateImage(h->device,
                     &(VkImageCreateInfo){
                         .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                         .flags = i == CUBE ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
                         .imageType = VK_IMAGE_TYPE_2D,
                         .format = row->format,
                         .extent = { size.width, size.height, 1 },
                         .mipLevels = 1,
                         .arrayLayers = row->layers,
                         .samples = VK_SAMPLE_COUNT_1_BIT,
                         .usage = row->usage,
                     },
                     NULL, &h->images[i]));
    vkGetImageMemoryRequirements(h->device, h->images[i], &need);
    h->memory[i] = take_memory(h, need, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    VK(vkBindImageMemory(h->device, h->images[i], h->memory[i], 0));
    h->views[i] = by_hand_view(
        h, h->images[i], row->format,
        i == CUBE ? VK_IMAGE_VIEW_TYPE_CUBE
                  : (row->layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D),
        0);
    for (uint32_t face = 0; row->layers > 1 && face < FACE_COUNT; face++)
        h->faces[i][face] = by_hand_view(h, h->images[i], row->format, VK_IMAGE_VIEW_TYPE_2D, face);
}

static void make_buffer(struct by_hand *h, uint32_t i, VkDeviceSize size, VkBufferUsageFlags usage)
{
    VkMemoryRequirements need;
    VK(vkCreateBuffer(h->device,
                      &(VkBufferCreateInfo){
                          .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                          .size = size,
                          .usage = usage,
                      },
                      NULL, &h->buffers[i]));
    vkGetBufferMemoryRequirements(h->device, h->buffers[i], &need);
    h->buffer_memory[i] = take_memory(
        h, need, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VK(vkBindBufferMemory(h->device, h->buffers[i], h->buffer_memory[i], 0));
    VK(vkMapMemory(h->device, h->buffer_memory[i], 0, VK_WHOLE_SIZE, 0, &h->mapped[i]));
}

static void make_sampler(struct by_hand *h, uint32_t i, bool linear, bool around, bool repeats)
{
    const VkSamplerAddressMode edge = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const float anisotropy = repeats ? fminf(4.0F, h->params.gpu->max_anisotropy) : 0.0F;
    VK(vkCreateSampler(
        h->device,
        &(VkSamplerCreateInfo){
            .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
            .magFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
            .minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
            .mipmapMode = around ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
            .addressModeU = around ? VK_SAMPLER_ADDRESS_MODE_REPEAT : edge,
            .addressModeV = repeats ? VK_SAMPLER_ADDRESS_MODE_REPEAT : edge,
            .addressModeW = edge,
            .maxLod = around ? VK_LOD_CLAMP_NONE : 0.0F,
            .anisotropyEnable = anisotropy >= 1.0F,
            .maxAnisotropy = anisotropy,
        },
        NULL, &h->samplers[i]));
}

void by_hand_make_objects(struct by_hand *h, VkDeviceSize globals_size)
{
    for (uint32_t i = 0; i < IMAGE_COUNT; i++)
        make_image(h, i);
    make_buffer(h, 0, globals_size, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    make_buffer(h, 1, (VkDeviceSize)h->params.width * h->params.height * 4,
                VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    make_sampler(h, NEAREST, false, false, false);
    make_sampler(h, LINEAR, true, false, false);
    make_sampler(h, AROUND, true, true, false);
    make_sampler(h, TEXTURES, true, true, true);
}

void by_hand_free_objects(struct by_hand *h)
{
    for (uint32_t i = 0; i < IMAGE_COUNT; i++) {
        vkDestroyImageView(h->device, h->views[i], NULL);
        vkDestroyImage(h->device, h->images[i], NULL);
        vkFreeMemory(h->device, h->memory[i], NULL);
    }
    for (uint32_t face = 0; face < FACE_COUNT; face++) {
        vkDestroyImageView(h->device, h->faces[CUBE][face], NULL);
        vkDestroyImageView(h->device, h->faces[CUBE_DEPTH][face], NULL);
    }
    for (uint32_t i = 0; i < 2; i++) {
        vkDestroyBuffer(h->device, h->buffers[i], NULL);
        vkFreeMemory(h->device, h->buffer_memory[i], NULL);
    }
    for (uint32_t i = 0; i < SAMPLER_COUNT; i++)
        vkDestroySampler(h->device, h->samplers[i], NULL);
}
