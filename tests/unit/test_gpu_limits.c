/* test_gpu_limits.c: images that exceed the device's limits are refused before any allocation. */
#include <sys/resource.h>
#include "src/gpu/gpu.h"
#include "tests/support/assertions.h"

static const VkDeviceSize mib = 1 << 20;

/* 8 MiB of its own and 4 MiB that the host sees. */
static struct gpu make_gpu(VkPhysicalDeviceType type)
{
    return (struct gpu){
        .properties = {
            .deviceType = type,
            .deviceName = "made up",
            .limits = {
                .maxImageDimension2D = 4096,
                .maxImageArrayLayers = 16,
                .maxImageDimensionCube = 512,
                .maxFramebufferWidth = 2048,
                .maxFramebufferHeight = 8192,
                .maxViewportDimensions = { 8192, 1024 },
            },
        },
        .memory = {
            .memoryTypeCount = 2,
            .memoryTypes = {
                { VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0 },
                { VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT, 1 },
            },
            .memoryHeapCount = 2,
            .memoryHeaps = { { 8 * mib, 0 }, { 4 * mib, 0 } },
        },
    };
}

static void sizes(void **state)
{
    (void)state;
    const struct gpu gpu = make_gpu(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU);
    assert_int_equal(gpu_check_size(&gpu, 2048, 1024), STATUS_OK);
    assert_int_equal(gpu_check_size(&gpu, 2049, 1), STATUS_USAGE);
    assert_int_equal(gpu_check_size(&gpu, 1, 1025), STATUS_USAGE);
    assert_int_equal(gpu_check_size(&gpu, UINT32_MAX, 2), STATUS_USAGE);
}

static void texels(void **state)
{
    (void)state;
    const struct gpu gpu = make_gpu(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU);
    const VkExtent3D wide = { 4097, 1, 0 }, high = { 1, 4097, 0 }, deep = { 1, 1, 17 };
    assert_int_equal(gpu_check_texels(&gpu, "a", (VkExtent3D){ 4096, 4096, 16 }), STATUS_OK);
    assert_int_equal(gpu_check_texels(&gpu, "a", wide), STATUS_DATA);
    assert_int_equal(gpu_check_texels(&gpu, "a", high), STATUS_DATA);
    assert_int_equal(gpu_check_texels(&gpu, "a", deep), STATUS_DATA);
}

static void heaps(void **state)
{
    (void)state;
    const VkExtent2D view = { 64, 48 };
    struct gpu gpu = make_gpu(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU);
    assert_int_equal(gpu_check_memory(&gpu, view, 8 * mib, 4 * mib), STATUS_OK);
    assert_int_equal(gpu_check_memory(&gpu, view, 8 * mib + 1, 0), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_check_memory(&gpu, view, 0, 4 * mib + 1), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_check_acceleration_memory(&gpu, 8 * mib), STATUS_OK);
    assert_int_equal(gpu_check_acceleration_memory(&gpu, 8 * mib + 1), STATUS_TRY_AGAIN);
    gpu.memory.memoryTypes[1].heapIndex = 0; /* both in one */
    assert_int_equal(gpu_check_memory(&gpu, view, 5 * mib, 3 * mib), STATUS_OK);
    assert_int_equal(gpu_check_memory(&gpu, view, 5 * mib, 3 * mib + 1), STATUS_TRY_AGAIN);
}

/* Its memory is the machine's, whatever it says. */
static void processors(void **state)
{
    (void)state;
    const VkExtent2D view = { 64, 48 };
    const struct gpu gpu = make_gpu(VK_PHYSICAL_DEVICE_TYPE_CPU);
    assert_int_equal(gpu_check_memory(&gpu, view, 64 * mib, 64 * mib), STATUS_OK);
    assert_int_equal(gpu_check_memory(&gpu, view, mib << 40, 0), STATUS_TRY_AGAIN);
}

/* What drivers say when they reach a limit of memory. */
static void unknown_errors(void **state)
{
    struct rlimit kept;
    (void)state;
    assert_int_equal(getrlimit(RLIMIT_AS, &kept), 0);
    const struct rlimit none = { RLIM_INFINITY, kept.rlim_max };
    const struct rlimit large = { (rlim_t)1 << 46, kept.rlim_max };
    if (kept.rlim_max == RLIM_INFINITY) {
        assert_int_equal(setrlimit(RLIMIT_AS, &none), 0);
        assert_int_equal(gpu_status(VK_ERROR_UNKNOWN), STATUS_FAILED);
        assert_int_equal(setrlimit(RLIMIT_AS, &large), 0);
    }
    assert_int_equal(gpu_status(VK_ERROR_UNKNOWN), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_failed("vkCreateDevice", VK_ERROR_UNKNOWN), STATUS_TRY_AGAIN);
    assert_int_equal(gpu_status(VK_ERROR_FEATURE_NOT_PRESENT), STATUS_FAILED);
    assert_int_equal(setrlimit(RLIMIT_AS, &kept), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes),      cmocka_unit_test(texels),         cmocka_unit_test(heaps),
        cmocka_unit_test(processors), cmocka_unit_test(unknown_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
