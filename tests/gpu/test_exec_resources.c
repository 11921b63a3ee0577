/*
 * test_exec_resources.c: images of three dimensions, arrays of descriptors, descriptor sets of the
 * program's own, draws that the device counts.
 *
 * They run on a device that has every feature enabled, since firn's enables only what it needs.
 */
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/support/all_features_device.h"
#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    SEED = 20,
};

/* Runs a frame of a feature whose rows read the seed. */
static void run_seeded(struct run *run, const struct rg_frame *frame)
{
    assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ SEED };
    assert_int_equal(rg_exec_submit(run->exec, frame), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run->exec, run->slot), VK_SUCCESS);
}

/* ---- three dimensions ---- */

enum {
    VOLUME_TEXELS = FEATURE_TEXELS * VOLUME_DEPTH,
    HALF = FEATURE_SIZE / 2,
    HALF_TEXELS = VOLUME_TEXELS / 8,
};

static void check_volume(struct run *run)
{
    const uint32_t *texels = run_data(run, run->params.outputs[VOLUME_TEXELS_OUT]);
    const uint32_t *seen = run_data(run, run->params.outputs[VOLUME_LOOK_OUT]);
    for (uint32_t i = 0; i < VOLUME_TEXELS; i++) {
        const uint32_t x = i % FEATURE_SIZE;
        const uint32_t y = i / FEATURE_SIZE % FEATURE_SIZE;
        const uint32_t z = i / FEATURE_TEXELS;
        const uint32_t half = (z % (VOLUME_DEPTH / 2) * HALF + y % HALF) * HALF + x % HALF;
        assert_int_equal(texels[i], SEED + i);
        assert_int_equal(seen[i],
                         SEED + VOLUME_TEXELS - 1 - i + 1000 * (SEED + HALF_TEXELS - 1 - half));
    }
}

static void volume_is_stored_and_sampled(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&feature_volume.params, way);
        struct run run;
        run_open(&run, *state, &params);
        run_seeded(&run, NULL);
        check_volume(&run);
        run_update(&run, &params);
        run_seeded(&run, NULL);
        check_volume(&run);
        run_close(&run);
    }
}

/* ---- an array, and a set of the program's own ---- */

static const uint32_t factors[] = { 5, 1, 100, 10000 };

static void check_sums(struct run *run)
{
    const uint32_t *sums = run_data(run, run->params.outputs[0]);
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++)
        assert_int_equal(sums[i],
                         5 + (SEED + i) + 100 * (SEED + i + SEED) + 10000 * ARRAY_FALLBACK);
}

static const struct paint_push everywhere[] = { { ALL }, { ALL }, { ALL }, { ALL } };

static void array_is_read_and_own_set_bound(void **state)
{
    struct gpu gpu;
    struct own_set own;
    all_features_device_open(&gpu, *state);
    own_set_create(&own, &gpu, factors, sizeof(factors));
    const struct rg_exec_set sets[] = { { &feature_array_set, own.layout } };
    const struct rg_frame frame = {
        .rows = feature_array.params.technique.passes,
        .paints = everywhere,
        .set = own.set,
    };
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        struct run_params params = run_variant(&feature_array.params, way);
        struct run run;
        params.sets = sets;
        run_open(&run, &gpu, &params);
        run_seeded(&run, &frame);
        check_sums(&run);
        run_update(&run, &params);
        run_seeded(&run, &frame);
        check_sums(&run);
        run_close(&run);
    }
    own_set_destroy(&own, &gpu);
    all_features_device_close(&gpu);
}

static void layout_of_a_set_is_missed(void **state)
{
    struct run run;
    run_compile(&run, *state, &feature_array.params);
    assert_int_equal(run_create(&run, run.plan), VK_ERROR_INITIALIZATION_FAILED);
    assert_int_equal(run.line_count, 1);
    assert_non_null(strstr(run.line, "rg_exec_params.sets: the layout of factors"));
    run_close(&run);
}

/* ---- counted draws ---- */

static struct rg_mesh square(struct gpu *gpu, struct gpu_buffer buffers[2])
{
    static const vec2s vertices[] = { { { -1, -1 } }, { { -1, 1 } }, { { 1, 1 } }, { { 1, -1 } } };
    static const uint32_t indices[] = { 0, 1, 2, 0, 2, 3 };
    assert_int_equal(gpu_buffer_create(gpu, &buffers[0], VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                                       vertices, sizeof(vertices), "vertices"),
                     STATUS_OK);
    assert_int_equal(gpu_buffer_create(gpu, &buffers[1], VK_BUFFER_USAGE_INDEX_BUFFER_BIT, indices,
                                       sizeof(indices), "indices"),
                     STATUS_OK);
    return (struct rg_mesh){ buffers[0].buffer, buffers[1].buffer, 6 };
}

static void begin_count(struct run *run, uint32_t count)
{
    struct count_commands commands = { .count = count };
    for (uint32_t i = 0; i < COUNT_MAX; i++) {
        commands.draws[i] = (VkDrawIndirectCommand){ 6, 1, 0, 0 };
        commands.meshes[i] = (VkDrawIndexedIndirectCommand){ 6, 1, 0, 0, 0 };
    }
    assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
    memcpy(run_data(run, &feature_count_commands), &commands, sizeof(commands));
}

/* At most COUNT_MAX, and of the mesh at most one. */
static void check_count(struct run *run, uint32_t count)
{
    const float drawn = (float)(count < COUNT_MAX ? count : COUNT_MAX);
    const float meshes = count ? 1 : 0;
    painted_check_all(run, run->params.outputs[COUNT_DRAWN_OUT], FEATURE_TEXELS,
                      painted_color(drawn, drawn, drawn, drawn));
    painted_check_all(run, run->params.outputs[COUNT_MESH_OUT], FEATURE_TEXELS,
                      painted_color(meshes, meshes, meshes, meshes));
}

static void draws_are_counted(void **state)
{
    struct gpu gpu;
    struct gpu_buffer buffers[2];
    all_features_device_open(&gpu, *state);
    const struct rg_frame frame = { .mesh = square(&gpu, buffers) };
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&feature_count.params, way);
        struct run run;
        run_open(&run, &gpu, &params);
        for (uint32_t count = 0; count < COUNT_MAX + 2; count++) {
            begin_count(&run, count);
            assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
            assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
            check_count(&run, count);
        }
        run_close(&run);
    }
    gpu_buffer_destroy(&gpu, &buffers[0]);
    gpu_buffer_destroy(&gpu, &buffers[1]);
    all_features_device_close(&gpu);
}

/* ---- acceleration structures ---- */

/* Without a device the plan is the same, so it can be compiled here. */
static void devices_without_rays_are_told(void **state)
{
    struct run_params params = feature_structure.params;
    struct run run;
    params.no_device = true;
    params.objects = &(struct rg_exec_import){ 0 };
    if (all_features_device_has_rays(*state))
        skip();
    run_compile(&run, *state, &params);
    assert_int_equal(run_create(&run, run.plan), VK_ERROR_FEATURE_NOT_PRESENT);
    assert_true(run.line_count >= 1); /* of the shader, or of the device, too */
    run_close(&run);
}

/* ---- features that the device lacks ---- */

static PFN_vkGetPhysicalDeviceFeatures2 real_features;

static VKAPI_ATTR void VKAPI_CALL few_features(VkPhysicalDevice physical,
                                               VkPhysicalDeviceFeatures2 *features)
{
    real_features(physical, features);
    for (VkBaseOutStructure *s = features->pNext; s; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
            ((VkPhysicalDeviceVulkan12Features *)s)->drawIndirectCount = VK_FALSE;
    }
}

static VkResult create_with_few(struct run *run)
{
    real_features = vkGetPhysicalDeviceFeatures2;
    vkGetPhysicalDeviceFeatures2 = few_features;
    const VkResult result = run_create(run, run->plan);
    vkGetPhysicalDeviceFeatures2 = real_features;
    return result;
}

static void counted_draws_are_refused(void **state)
{
    struct run run;
    struct gpu_buffer buffers[2];
    const struct rg_frame frame = { .mesh = square(*state, buffers) };
    run_compile(&run, *state, &feature_count.params);
    assert_int_equal(create_with_few(&run), VK_SUCCESS);
    begin_count(&run, 1);
    assert_int_equal(rg_exec_submit(run.exec, &frame), VK_ERROR_FEATURE_NOT_PRESENT);
    assert_int_equal(run.line_count, 1);
    assert_non_null(strstr(run.line, "the feature drawIndirectCount of draw"));
    run_close(&run);
    gpu_buffer_destroy(*state, &buffers[0]);
    gpu_buffer_destroy(*state, &buffers[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volume_is_stored_and_sampled),
        cmocka_unit_test(array_is_read_and_own_set_bound),
        cmocka_unit_test(layout_of_a_set_is_missed),
        cmocka_unit_test(draws_are_counted),
        cmocka_unit_test(devices_without_rays_are_told),
        cmocka_unit_test(counted_draws_are_refused),
    };
    return RUN_ON_DEVICE(tests);
}
