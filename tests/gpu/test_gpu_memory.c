/* test_gpu_memory.c: upload and readback of buffers and images on lavapipe. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/gpu/gpu_internal.h"
#include "tests/support/lavapipe.h"

/* --- reading back --- */

static void *map(struct gpu *gpu, const struct gpu_buffer *buffer)
{
    void *data = NULL;
    assert_int_equal(vkMapMemory(gpu->device, buffer->memory, 0, VK_WHOLE_SIZE, 0, &data),
                     VK_SUCCESS);
    return data;
}

static void record_host_read(VkCommandBuffer commands)
{
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
        .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT,
    };
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = 1,
        .pMemoryBarriers = &barrier,
    };
    vkCmdPipelineBarrier2(commands, &dependency);
}

static void check_buffer(struct gpu *gpu, const struct gpu_buffer *buffer, const void *expected)
{
    struct gpu_buffer host;
    struct gpu_upload upload;
    const VkBufferCopy copy = { .size = buffer->size };
    assert_int_equal(gpu_memory_buffer(gpu, &host, VK_BUFFER_USAGE_TRANSFER_DST_BIT, buffer->size,
                                       true, "read back"),
                     STATUS_OK);
    assert_int_equal(gpu_upload_begin(gpu, &upload, 4, "test"), STATUS_OK);
    vkCmdCopyBuffer(upload.commands, buffer->buffer, host.buffer, 1, &copy);
    record_host_read(upload.commands);
    assert_int_equal(gpu_upload_flush(gpu, &upload), STATUS_OK);
    gpu_upload_finish(gpu, &upload);
    assert_memory_equal(map(gpu, &host), expected, buffer->size);
    gpu_buffer_destroy(gpu, &host);
}

/* One mip level of one layer, rows tight, into *texels. */
static void read_image(struct gpu *gpu, const struct gpu_image *image, uint32_t mip, uint32_t layer,
                       void *texels, size_t size)
{
    struct gpu_buffer host;
    struct gpu_upload upload;
    const uint32_t width = image->extent.width >> mip;
    const uint32_t height = image->extent.height >> mip;
    const VkBufferImageCopy copy = {
        .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, mip, layer, 1 },
        .imageExtent = { width ? width : 1, height ? height : 1, 1 },
    };
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
        .dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT,
        .oldLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        .newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
        .image = image->image,
        .subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, mip, 1, layer, 1 },
    };
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = 1,
        .pImageMemoryBarriers = &barrier,
    };
    assert_int_equal(
        gpu_memory_buffer(gpu, &host, VK_BUFFER_USAGE_TRANSFER_DST_BIT, size, true, "read back"),
        STATUS_OK);
    assert_int_equal(gpu_upload_begin(gpu, &upload, 4, "test"), STATUS_OK);
    vkCmdPipelineBarrier2(upload.commands, &dependency);
    vkCmdCopyImageToBuffer(upload.commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           host.buffer, 1, &copy);
    record_host_read(upload.commands);
    assert_int_equal(gpu_upload_flush(gpu, &upload), STATUS_OK);
    gpu_upload_finish(gpu, &upload);
    memcpy(texels, map(gpu, &host), size);
    gpu_buffer_destroy(gpu, &host);
}

/* Bytes without a short period, so that a piece in the wrong place shows. */
static unsigned char *make_bytes(size_t size)
{
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    for (size_t i = 0; i < size; i++)
        bytes[i] = (unsigned char)((i * 2654435761U) >> 13);
    return bytes;
}

/* --- memory --- */

static void buffer_comes_back(void **state)
{
    static const size_t sizes[] = {
        1, 7, 4096, GPU_STAGING_SIZE, GPU_STAGING_SIZE + 5, 2 * GPU_STAGING_SIZE + 3
    };
    struct gpu *gpu = *state;
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
        struct gpu_buffer buffer;
        unsigned char *bytes = make_bytes(sizes[i]);
        const VkBufferUsageFlags usage =
            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
        assert_int_equal(gpu_buffer_create(gpu, &buffer, usage, bytes, sizes[i], "bytes"),
                         STATUS_OK);
        assert_int_equal(buffer.size, sizes[i]);
        check_buffer(gpu, &buffer, bytes);
        gpu_buffer_destroy(gpu, &buffer);
        free(bytes);
    }
}

static void empty_buffer_is_nothing(void **state)
{
    struct gpu_buffer buffer;
    assert_int_equal(
        gpu_buffer_create(*state, &buffer, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, NULL, 0, "nothing"),
        STATUS_OK);
    assert_null(buffer.buffer);
    gpu_buffer_destroy(*state, &buffer);
}

static void too_large_buffer_is_refused(void **state)
{
    static const VkDeviceSize sizes[] = { 1ULL << 40, UINT64_MAX };
    struct gpu *gpu = *state;
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
        struct gpu_buffer buffer;
        assert_int_equal(gpu_buffer_create(gpu, &buffer, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "",
                                           sizes[i], "too large"),
                         STATUS_TRY_AGAIN);
        assert_null(buffer.buffer);
    }
}

/* The heap is smaller than what this driver would grant. */
static void more_than_the_heap_is_refused(void **state)
{
    struct gpu *gpu = *state;
    const VkMemoryRequirements needs = {
        .size = gpu->memory.memoryHeaps[0].size + 1,
        .memoryTypeBits = UINT32_MAX,
    };
    VkDeviceMemory memory = VK_NULL_HANDLE;
    assert_int_equal(gpu_memory_allocate(gpu, &needs, false, "all", &memory), STATUS_TRY_AGAIN);
    assert_null(memory);
}

static void memory_type_fits(void **state)
{
    (void)state;
    const VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    const VkMemoryPropertyFlags coherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkPhysicalDeviceMemoryProperties memory = {
        .memoryTypeCount = 4,
        .memoryTypes = { { 0, 0 }, { visible, 0 }, { visible | coherent, 0 }, { local, 1 } },
    };
    assert_int_equal(gpu_memory_type(&memory, 0xf, 0, local), 3);
    assert_int_equal(gpu_memory_type(&memory, 0x7, 0, local), 0);
    assert_int_equal(gpu_memory_type(&memory, 0xf, visible, coherent), 2);
    assert_int_equal(gpu_memory_type(&memory, 0xb, visible, coherent), 1);
    assert_int_equal(gpu_memory_type(&memory, 0x9, visible, coherent), UINT32_MAX);
}

/* --- images --- */

static void layers_come_back(void **state)
{
    enum {
        WIDTH = 37,
        HEIGHT = 5,
        LAYERS = 3,
        LAYER_SIZE = WIDTH * HEIGHT * 4,
    };
    struct gpu *gpu = *state;
    struct gpu_image image;
    unsigned char back[LAYER_SIZE];
    unsigned char *texels = make_bytes((size_t)LAYERS * LAYER_SIZE);
    const struct gpu_image_params params = {
        .name = "layers",
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .width = WIDTH,
        .height = HEIGHT,
        .layers = LAYERS,
        .texels = texels,
        .texels_size = (size_t)LAYERS * LAYER_SIZE,
    };
    assert_int_equal(gpu_image_create(gpu, &image, &params), STATUS_OK);
    assert_int_equal(image.mips, 1);
    for (uint32_t layer = 0; layer < LAYERS; layer++) {
        read_image(gpu, &image, 0, layer, back, LAYER_SIZE);
        assert_memory_equal(back, texels + (size_t)layer * LAYER_SIZE, LAYER_SIZE);
    }
    gpu_image_destroy(gpu, &image);
    free(texels);
}

/* Rows go in several pieces, and the second layer begins with a new one. */
static void large_image_comes_back(void **state)
{
    enum {
        WIDTH = 1531,
        HEIGHT = 3000,
        LAYER_SIZE = WIDTH * HEIGHT * 4,
    };

    _Static_assert(LAYER_SIZE > (int)GPU_STAGING_SIZE, "more than one piece");
    struct gpu *gpu = *state;
    struct gpu_image image;
    unsigned char *texels = make_bytes(2 * (size_t)LAYER_SIZE);
    unsigned char *back = malloc(LAYER_SIZE);
    const struct gpu_image_params params = {
        .name = "large",
        .format = VK_FORMAT_R32_SFLOAT,
        .width = WIDTH,
        .height = HEIGHT,
        .layers = 2,
        .texels = texels,
        .texels_size = 2 * (size_t)LAYER_SIZE,
    };
    assert_non_null(back);
    assert_int_equal(gpu_image_create(gpu, &image, &params), STATUS_OK);
    for (uint32_t layer = 0; layer < 2; layer++) {
        read_image(gpu, &image, 0, layer, back, LAYER_SIZE);
        assert_memory_equal(back, texels + (size_t)layer * LAYER_SIZE, LAYER_SIZE);
    }
    gpu_image_destroy(gpu, &image);
    free(texels);
    free(back);
}

/* A mip texel is the mean of the four above it, in each layer by itself. */
static void mips_are_means(void **state)
{
    enum {
        SIZE = 8,
        TEXELS = SIZE * SIZE,
    };
    struct gpu *gpu = *state;
    struct gpu_image image;
    float texels[2 * TEXELS];
    float back[TEXELS];
    for (int i = 0; i < 2 * TEXELS; i++)
        texels[i] = (float)(i * i % 101);
    const struct gpu_image_params params = {
        .name = "mips",
        .format = VK_FORMAT_R32_SFLOAT,
        .width = SIZE,
        .height = SIZE,
        .layers = 2,
        .mipmaps = true,
        .texels = texels,
        .texels_size = sizeof(texels),
    };
    assert_int_equal(gpu_image_create(gpu, &image, &params), STATUS_OK);
    assert_int_equal(image.mips, 4);
    for (uint32_t layer = 0; layer < 2; layer++) {
        const float *top = texels + (size_t)layer * TEXELS;
        double sum = 0;
        read_image(gpu, &image, 1, layer, back, TEXELS / 4 * sizeof(float));
        for (int y = 0; y < SIZE / 2; y++) {
            for (int x = 0; x < SIZE / 2; x++) {
                const float *block = top + (ptrdiff_t)2 * y * SIZE + (ptrdiff_t)2 * x;
                const float mean = (block[0] + block[1] + block[SIZE] + block[SIZE + 1]) / 4;
                CHECK_NEAR(back[y * SIZE / 2 + x], mean, 1e-3);
            }
        }
        for (int i = 0; i < TEXELS; i++)
            sum += (double)top[i];
        read_image(gpu, &image, 3, layer, back, sizeof(float));
        CHECK_NEAR(back[0], sum / TEXELS, 1e-3);
    }
    gpu_image_destroy(gpu, &image);
}

/* Black and white in sRGB: the mean of the light is code 188, that of the codes would be 128. */
static void srgb_mips_are_linear(void **state)
{
    static const unsigned char texels[2 * 2 * 4] = {
        0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 255,
    };
    struct gpu *gpu = *state;
    struct gpu_image image;
    unsigned char back[4];
    const struct gpu_image_params params = {
        .name = "srgb",
        .format = VK_FORMAT_R8G8B8A8_SRGB,
        .width = 2,
        .height = 2,
        .mipmaps = true,
        .texels = texels,
        .texels_size = sizeof(texels),
    };
    assert_int_equal(gpu_image_create(gpu, &image, &params), STATUS_OK);
    assert_int_equal(image.mips, 2);
    read_image(gpu, &image, 1, 0, back, sizeof(back));
    for (int i = 0; i < 3; i++)
        CHECK_NEAR(back[i], 188, 1);
    assert_int_equal(back[3], 255);
    gpu_image_destroy(gpu, &image);
}

/* 1 over 3 in half floats, 5 x 2 texels: 2 x 1, then 1 x 1. */
static void half_float_mips(void **state)
{
    enum {
        ONE = 0x3c00,
        TWO = 0x4000,
        THREE = 0x4200,
    };
    struct gpu *gpu = *state;
    struct gpu_image image;
    uint16_t texels[2][5][4];
    uint16_t back[2 * 4];
    for (int x = 0; x < 5; x++) {
        for (int i = 0; i < 4; i++) {
            texels[0][x][i] = ONE;
            texels[1][x][i] = THREE;
        }
    }
    const struct gpu_image_params params = {
        .name = "half",
        .format = VK_FORMAT_R16G16B16A16_SFLOAT,
        .width = 5,
        .height = 2,
        .mipmaps = true,
        .texels = texels,
        .texels_size = sizeof(texels),
    };
    assert_int_equal(gpu_image_create(gpu, &image, &params), STATUS_OK);
    assert_int_equal(image.mips, 3);
    for (uint32_t mip = 1; mip < 3; mip++) {
        const size_t count = mip == 1 ? 8 : 4;
        read_image(gpu, &image, mip, 0, back, count * sizeof(back[0]));
        for (size_t i = 0; i < count; i++)
            CHECK_NEAR(back[i], TWO, 1); /* one unit in the last place */
    }
    gpu_image_destroy(gpu, &image);
}

/* 5 x 2 texels in two layers, then 2 x 1, then 1 x 1: as they came. */
static void given_levels_stay(void **state)
{
    struct gpu *gpu = *state;
    struct gpu_image image;
    unsigned char texels[2 * (10 + 2 + 1)];
    unsigned char back[10];
    for (size_t i = 0; i < sizeof(texels); i++)
        texels[i] = (unsigned char)(7 * i + 1);
    const struct gpu_image_params params = {
        .name = "levels",
        .format = VK_FORMAT_R8_UNORM,
        .width = 5,
        .height = 2,
        .layers = 2,
        .levels = true,
        .texels = texels,
        .texels_size = sizeof(texels),
    };
    assert_int_equal(gpu_image_create(gpu, &image, &params), STATUS_OK);
    assert_int_equal(image.mips, 3);
    const unsigned char *next = texels;
    for (uint32_t mip = 0; mip < 3; mip++) {
        static const size_t sizes[3] = { 10, 2, 1 };
        for (uint32_t layer = 0; layer < 2; layer++, next += sizes[mip]) {
            read_image(gpu, &image, mip, layer, back, sizes[mip]);
            assert_memory_equal(back, next, sizes[mip]);
        }
    }
    gpu_image_destroy(gpu, &image);
}

static void wrong_images_are_refused(void **state)
{
    static const unsigned char texels[64] = { 0 };

    static const struct {
        struct gpu_image_params params;
        enum status status;
    } rows[] = {
        /* a byte short, a byte long, no width, no height, over the limits, overflowing */
        { { .width = 4, .height = 4, .texels_size = 63 }, STATUS_DATA },
        { { .width = 4, .height = 4, .texels_size = 65 }, STATUS_DATA },
        { { .width = 4, .height = 4, .levels = true, .texels_size = 64 }, STATUS_DATA },
        { { .width = 0, .height = 4, .texels_size = 0 }, STATUS_DATA },
        { { .width = 4, .height = 0, .texels_size = 0 }, STATUS_DATA },
        { { .width = 1 << 20, .height = 1, .texels_size = 1 << 22 }, STATUS_DATA },
        { { .width = 1, .height = 1, .layers = 1 << 20, .texels_size = 1 << 22 }, STATUS_DATA },
        { { .width = 1U << 31, .height = 1U << 31, .texels_size = 0 }, STATUS_DATA },
        /* no device samples a format of one's own invention; none is blitted to */
        { { .format = VK_FORMAT_R64_SFLOAT, .width = 4, .height = 2, .texels_size = 64 },
          STATUS_NO_DEVICE },
        { { .format = VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
            .width = 4,
            .height = 4,
            .mipmaps = true,
            .texels_size = 64 },
          STATUS_NO_DEVICE },
    };
    struct gpu *gpu = *state;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct gpu_image image;
        struct gpu_image_params params = rows[i].params;
        params.name = "wrong";
        params.texels = texels;
        if (!params.format)
            params.format = VK_FORMAT_R8G8B8A8_UNORM;
        assert_int_equal(gpu_image_create(gpu, &image, &params), rows[i].status);
        assert_null(image.image);
        assert_int_equal(image.mips, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_type_fits),
        ON_DEVICE(buffer_comes_back),
        ON_DEVICE(empty_buffer_is_nothing),
        ON_DEVICE(too_large_buffer_is_refused),
        ON_DEVICE(more_than_the_heap_is_refused),
        ON_DEVICE(layers_come_back),
        ON_DEVICE(large_image_comes_back),
        ON_DEVICE(mips_are_means),
        ON_DEVICE(srgb_mips_are_linear),
        ON_DEVICE(half_float_mips),
        ON_DEVICE(given_levels_stay),
        ON_DEVICE(wrong_images_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
