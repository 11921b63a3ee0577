/* gpu_image.c: creates sampled images, uploads their texels and generates mip levels. */
#include <assert.h>
#include <string.h>

#include "graph/rg.h"
#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

/* Returns the texel size in bytes; 0 for an unknown format. */
static uint32_t find_texel_size(VkFormat format)
{
    const struct rg_format_info *info = rg_format_info(format);
    return info ? info->size : 0;
}

static uint32_t count_mips(uint32_t width, uint32_t height)
{
    uint32_t count = 1;
    for (uint32_t size = width > height ? width : height; size > 1; size /= 2)
        count++;
    return count;
}

static uint32_t mip_size(uint32_t size, uint32_t mip)
{
    return size >> mip ? size >> mip : 1;
}

/* Returns the number of mip levels in params->texels. */
static uint32_t count_given_levels(const struct gpu_image *image,
                                   const struct gpu_image_params *params)
{
    return params->levels ? image->mips : 1;
}

static VkImageCreateFlags create_flags(const struct gpu_image_params *params)
{
    return params->cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
}

static const char *name_of(const struct gpu_image_params *params)
{
    return params->name ? params->name : "an image";
}

/* Checks that the device can create, fill and sample the image. Writes size limits to *limits. */
static enum status check_format(const struct gpu *gpu, const struct gpu_image_params *params,
                                VkImageUsageFlags usage, VkImageFormatProperties *limits)
{
    VkFormatFeatureFlags features =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
        VK_FORMAT_FEATURE_TRANSFER_SRC_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
    VkFormatProperties has;
    if (params->mipmaps)
        features |= VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT;
    vkGetPhysicalDeviceFormatProperties(gpu->physical, params->format, &has);
    VkResult result = VK_ERROR_FORMAT_NOT_SUPPORTED;
    if ((has.optimalTilingFeatures & features) == features)
        result = vkGetPhysicalDeviceImageFormatProperties(gpu->physical, params->format,
                                                          VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
                                                          usage, create_flags(params), limits);
    if (result == VK_SUCCESS)
        return STATUS_OK;
    if (result != VK_ERROR_FORMAT_NOT_SUPPORTED)
        return gpu_failed_for("vkGetPhysicalDeviceImageFormatProperties", name_of(params), result);
    log_error("%s: %s does not support sampling%s for VkFormat %d", name_of(params),
              gpu->properties.deviceName, params->mipmaps ? " and blitting" : "",
              (int)params->format);
    return STATUS_NO_DEVICE;
}

static enum status check_size(const struct gpu_image_params *params, const struct gpu_image *image,
                              const VkImageFormatProperties *limits)
{
    const uint32_t texel_size = find_texel_size(params->format);
    const VkExtent3D extent = image->extent;
    if (extent.width == 0 || extent.height == 0 || extent.width > limits->maxExtent.width ||
        extent.height > limits->maxExtent.height || image->layers > limits->maxArrayLayers ||
        image->mips > limits->maxMipLevels) {
        log_error("%s has %u x %u texels and %u layers; the device supports at most %u x %u texels "
                  "and %u layers",
                  name_of(params), extent.width, extent.height, image->layers,
                  limits->maxExtent.width, limits->maxExtent.height, limits->maxArrayLayers);
        return STATUS_DATA;
    }
    /* width, height and layers are within the device's limits, so this cannot overflow */
    uint64_t size = 0;
    for (uint32_t mip = 0; mip < count_given_levels(image, params); mip++)
        size += (uint64_t)mip_size(extent.width, mip) * mip_size(extent.height, mip) *
                image->layers * texel_size;
    if (size == 0 || size != params->texels_size) {
        log_error("%s has %zu bytes of texels, expected %llu", name_of(params), params->texels_size,
                  (unsigned long long)size);
        return STATUS_DATA;
    }
    return STATUS_OK;
}

static enum status create(struct gpu *gpu, struct gpu_image *image, VkImageUsageFlags usage,
                          const struct gpu_image_params *params)
{
    const char *name = params->name;
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = create_flags(params),
        .imageType = VK_IMAGE_TYPE_2D,
        .format = image->format,
        .extent = image->extent,
        .mipLevels = image->mips,
        .arrayLayers = image->layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = usage,
    };
    VkMemoryRequirements needs;
    VkResult result = vkCreateImage(gpu->device, &info, NULL, &image->image);
    if (result != VK_SUCCESS) {
        image->image = VK_NULL_HANDLE;
        return gpu_failed_for("vkCreateImage", name, result);
    }
    gpu_debug_name(gpu, VK_OBJECT_TYPE_IMAGE, (uint64_t)image->image, name);
    vkGetImageMemoryRequirements(gpu->device, image->image, &needs);
    const enum status status =
        gpu_memory_allocate(gpu, &needs, GPU_MEMORY_DEVICE, name, &image->memory);
    if (status != STATUS_OK)
        return status;
    result = vkBindImageMemory(gpu->device, image->image, image->memory, 0);
    return result == VK_SUCCESS ? STATUS_OK : gpu_failed_for("vkBindImageMemory", name, result);
}

/* Layout, stages and access of an image before or after a barrier. */
struct use {
    VkImageLayout layout;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
};

static const struct use unused = { VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE,
                                   VK_ACCESS_2_NONE };
static const struct use written = { VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                    VK_ACCESS_2_TRANSFER_WRITE_BIT };
static const struct use halved = { VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                   VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                   VK_ACCESS_2_TRANSFER_READ_BIT };
static const struct use sampled = { VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                    VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT };

/* Records a barrier between two uses of `count` mip levels of all layers. */
static void record_use(VkCommandBuffer commands, const struct gpu_image *image, uint32_t mip,
                       uint32_t count, const struct use *from, const struct use *to)
{
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = from->stages,
        .srcAccessMask = from->access,
        .dstStageMask = to->stages,
        .dstAccessMask = to->access,
        .oldLayout = from->layout,
        .newLayout = to->layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image->image,
        .subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, mip, count, 0, image->layers },
    };
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = 1,
        .pImageMemoryBarriers = &barrier,
    };
    vkCmdPipelineBarrier2(commands, &dependency);
}

/* Copies one mip level, in pieces that fit in the staging buffer. */
static enum status copy_level(struct gpu *gpu, const struct gpu_image *image,
                              struct gpu_upload *upload, const char *texels, uint32_t mip)
{
    const uint32_t width = mip_size(image->extent.width, mip);
    const uint32_t height = mip_size(image->extent.height, mip);
    const size_t row_size = (size_t)width * find_texel_size(image->format);
    assert(row_size > 0);
    const uint32_t rows_max = (uint32_t)(upload->staging.size / row_size);
    /* layers per copy */
    const uint32_t layers = rows_max / height >= image->layers ? image->layers : 1;
    enum status status = STATUS_OK;
    assert(rows_max > 0); /* a row of the widest image is much smaller than GPU_STAGING_SIZE */
    for (uint32_t layer = 0; layer < image->layers; layer += layers) {
        uint32_t rows = 0;
        for (uint32_t y = 0; y < height && status == STATUS_OK; y += rows) {
            rows = height - y < rows_max ? height - y : rows_max;
            const size_t size = row_size * rows * layers;
            const VkBufferImageCopy copy = {
                .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, mip, layer, layers },
                .imageOffset = { 0, (int32_t)y, 0 },
                .imageExtent = { width, rows, 1 },
            };
            memcpy(upload->mapped, texels, size);
            vkCmdCopyBufferToImage(upload->commands, upload->staging.buffer, image->image,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
            texels += size;
            status = gpu_upload_flush(gpu, upload);
        }
    }
    return status;
}

static enum status copy_texels(struct gpu *gpu, const struct gpu_image *image,
                               struct gpu_upload *upload, const struct gpu_image_params *params)
{
    const char *texels = params->texels;
    enum status status = STATUS_OK;
    for (uint32_t mip = 0; mip < count_given_levels(image, params) && status == STATUS_OK; mip++) {
        status = copy_level(gpu, image, upload, texels, mip);
        texels += (size_t)mip_size(image->extent.width, mip) * mip_size(image->extent.height, mip) *
                  image->layers * find_texel_size(image->format);
    }
    return status;
}

/* Records blits that generate each mip level from the previous, larger level. */
static void record_mips(VkCommandBuffer commands, const struct gpu_image *image)
{
    const VkExtent3D size = image->extent;
    for (uint32_t mip = 1; mip < image->mips; mip++) {
        const VkImageBlit blit = {
            .srcSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, mip - 1, 0, image->layers },
            .srcOffsets[1] = { (int32_t)mip_size(size.width, mip - 1),
                               (int32_t)mip_size(size.height, mip - 1), 1 },
            .dstSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, image->layers },
            .dstOffsets[1] = { (int32_t)mip_size(size.width, mip),
                               (int32_t)mip_size(size.height, mip), 1 },
        };
        record_use(commands, image, mip - 1, 1, &written, &halved);
        vkCmdBlitImage(commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image->image,
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
    }
}

static enum status fill(struct gpu *gpu, const struct gpu_image *image,
                        const struct gpu_image_params *params)
{
    struct gpu_upload upload = { 0 };
    enum status status = gpu_upload_begin(gpu, &upload, params->texels_size, name_of(params));
    if (status == STATUS_OK) {
        record_use(upload.commands, image, 0, image->mips, &unused, &written);
        status = copy_texels(gpu, image, &upload, params);
    }
    if (status == STATUS_OK) {
        const uint32_t halves = image->mips - count_given_levels(image, params);
        if (halves > 0) {
            record_mips(upload.commands, image);
            record_use(upload.commands, image, 0, halves, &halved, &sampled);
        }
        record_use(upload.commands, image, halves, image->mips - halves, &written, &sampled);
        status = gpu_upload_flush(gpu, &upload);
    }
    gpu_upload_finish(gpu, &upload);
    return status;
}

enum status gpu_image_create(struct gpu *gpu, struct gpu_image *image,
                             const struct gpu_image_params *params)
{
    const VkImageUsageFlags usage = params->usage | VK_IMAGE_USAGE_SAMPLED_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VkImageFormatProperties limits = { 0 };
    *image = (struct gpu_image){
        .extent = { params->width, params->height, 1 },
        .format = params->format,
        .mips = params->mipmaps || params->levels ? count_mips(params->width, params->height) : 1,
        .layers = params->layers ? params->layers : 1,
    };
    enum status status = check_format(gpu, params, usage, &limits);
    if (status == STATUS_OK)
        status = check_size(params, image, &limits);
    if (status == STATUS_OK)
        status = create(gpu, image, usage, params);
    if (status == STATUS_OK)
        status = fill(gpu, image, params);
    if (status != STATUS_OK)
        gpu_image_destroy(gpu, image);
    return status;
}

void gpu_image_destroy(struct gpu *gpu, struct gpu_image *image)
{
    if (gpu->device) {
        vkDestroyImage(gpu->device, image->image, NULL);
        vkFreeMemory(gpu->device, image->memory, NULL);
    }
    *image = (struct gpu_image){ 0 };
}
