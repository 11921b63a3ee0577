/* gpu_acceleration.c: creates and builds acceleration structures: one BLAS per group, one TLAS. */
#include "src/gpu/gpu_acceleration.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

enum {
    OFFSET_ALIGNMENT = 256, /* required alignment of acceleration structures in a buffer, bytes */
};

static const char *const name = "acceleration structures";

/* Geometry and build info of one acceleration-structure build. */
struct build {
    VkAccelerationStructureGeometryKHR geometry;
    VkAccelerationStructureBuildGeometryInfoKHR info;
    uint32_t count; /* triangles or instances */
};

static VkDeviceAddress address_of(const struct gpu *gpu, const struct gpu_buffer *buffer)
{
    const VkBufferDeviceAddressInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
        .buffer = buffer->buffer,
    };
    return buffer->buffer ? vkGetBufferDeviceAddress(gpu->device, &info) : 0;
}

static void describe(struct build *build, VkAccelerationStructureTypeKHR type, uint32_t count)
{
    build->count = count;
    build->info = (VkAccelerationStructureBuildGeometryInfoKHR){
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
        .type = type,
        .flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR,
        .mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR,
        .geometryCount = 1,
        .pGeometries = &build->geometry,
    };
}

static void describe_blas(struct build *build, VkDeviceAddress corners, uint32_t count)
{
    build->geometry = (VkAccelerationStructureGeometryKHR){
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR,
        .geometry.triangles = {
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
            .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
            .vertexData.deviceAddress = corners,
            .vertexStride = 3 * sizeof(float),
            .maxVertex = 3 * count - 1,
            .indexType = VK_INDEX_TYPE_NONE_KHR,
        },
    };
    describe(build, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, count);
}

static void describe_tlas(struct build *build, VkDeviceAddress instances, uint32_t count)
{
    build->geometry = (VkAccelerationStructureGeometryKHR){
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR,
        .geometry.instances = {
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
            .data.deviceAddress = instances,
        },
    };
    describe(build, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, count);
}

/* Returns the size of an acceleration structure, bytes; raises rays->scratch_size if necessary. */
static VkDeviceSize size_of(const struct gpu *gpu, struct gpu_acceleration *rays,
                            const struct build *build)
{
    VkAccelerationStructureBuildSizesInfoKHR sizes = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR,
    };
    vkGetAccelerationStructureBuildSizesKHR(gpu->device,
                                            VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR,
                                            &build->info, &build->count, &sizes);
    if (rays->scratch_size < sizes.buildScratchSize)
        rays->scratch_size = sizes.buildScratchSize;
    return (sizes.accelerationStructureSize + OFFSET_ALIGNMENT - 1) / OFFSET_ALIGNMENT *
           OFFSET_ALIGNMENT;
}

/* Creates acceleration structures one after another in a buffer. */
static enum status create_structures(struct gpu *gpu, struct gpu_buffer *memory,
                                     const struct build *build, const VkDeviceSize *sizes,
                                     VkAccelerationStructureKHR *to)
{
    VkDeviceSize offset = 0;
    VkResult result = VK_SUCCESS;
    uint32_t i = 0;
    for (; i < build->count && result == VK_SUCCESS; i++) {
        const VkAccelerationStructureCreateInfoKHR info = {
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
            .buffer = memory->buffer,
            .offset = offset,
            .size = sizes[i],
            .type = build->info.type,
        };
        result = vkCreateAccelerationStructureKHR(gpu->device, &info, NULL, &to[i]);
        offset += sizes[i];
    }
    if (result == VK_SUCCESS)
        return STATUS_OK;
    to[i - 1] = VK_NULL_HANDLE;
    return gpu_failed_for("vkCreateAccelerationStructureKHR", name, result);
}

static enum status create_storage(struct gpu *gpu, struct gpu_buffer *memory, VkDeviceSize size)
{
    return gpu_memory_buffer(gpu, memory,
                             VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                                 VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                             size, false, name);
}

/* Computes the size in bytes of each group's BLAS and returns the sum. */
static VkDeviceSize blas_sizes(const struct gpu *gpu, struct gpu_acceleration *rays,
                               const struct gpu_blas_groups *groups, VkDeviceSize *sizes)
{
    VkDeviceSize sum = 0;
    for (uint32_t i = 0; i < groups->count; i++) {
        struct build build;
        describe_blas(&build, 0, groups->all[i].count);
        sizes[i] = size_of(gpu, rays, &build);
        sum += sizes[i];
    }
    return sum;
}

/* Creates all structures, without content. */
static enum status create_all(struct gpu *gpu, struct gpu_acceleration *rays,
                              const struct gpu_blas_groups *groups, VkDeviceSize *sizes)
{
    struct build lower, tlas;
    const VkDeviceSize blas_handles = blas_sizes(gpu, rays, groups, sizes);
    describe_blas(&lower, 0, 1);
    lower.count = groups->count;
    describe_tlas(&tlas, 0, groups->count);
    const VkDeviceSize last = size_of(gpu, rays, &tlas);
    tlas.count = 1;
    rays->size = blas_handles + last;
    enum status status = gpu_check_acceleration_memory(gpu, rays->size + rays->scratch_size);
    if (status == STATUS_OK && groups->count)
        status = create_storage(gpu, &rays->blas_memory, blas_handles);
    if (status == STATUS_OK && groups->count)
        status = create_structures(gpu, &rays->blas_memory, &lower, sizes, rays->blas_handles);
    if (status == STATUS_OK)
        status = create_storage(gpu, &rays->tlas_memory, last);
    return status == STATUS_OK
               ? create_structures(gpu, &rays->tlas_memory, &tlas, &last, &rays->tlas)
               : status;
}

enum status gpu_acceleration_create(struct gpu *gpu, struct gpu_acceleration **rays,
                                    const struct gpu_blas_groups *groups)
{
    struct gpu_acceleration *made = calloc(1, sizeof(*made));
    *rays = NULL;
    if (!made)
        return log_out_of_memory(name);
    VkDeviceSize *sizes = calloc(groups->count + (size_t)1, sizeof(*sizes));
    made->count = groups->count;
    made->blas_handles = calloc(groups->count + (size_t)1, sizeof(VkAccelerationStructureKHR));
    const enum status status = sizes && made->blas_handles ? create_all(gpu, made, groups, sizes)
                                                           : log_out_of_memory(name);
    free(sizes);
    if (status == STATUS_OK)
        *rays = made;
    else
        gpu_acceleration_destroy(gpu, made);
    return status;
}

void gpu_blas_groups_finish(struct gpu_blas_groups *groups)
{
    free(groups->all);
    free(groups->corners);
    *groups = (struct gpu_blas_groups){ 0 };
}

void gpu_acceleration_destroy(struct gpu *gpu, struct gpu_acceleration *rays)
{
    if (!rays)
        return;
    for (uint32_t i = 0; rays->blas_handles && i < rays->count; i++) {
        if (rays->blas_handles[i])
            vkDestroyAccelerationStructureKHR(gpu->device, rays->blas_handles[i], NULL);
    }
    if (rays->tlas)
        vkDestroyAccelerationStructureKHR(gpu->device, rays->tlas, NULL);
    gpu_buffer_destroy(gpu, &rays->blas_memory);
    gpu_buffer_destroy(gpu, &rays->tlas_memory);
    gpu_blas_groups_finish(&rays->built);
    free(rays->blas_handles);
    free(rays);
}

/* Input buffers and scratch memory of acceleration-structure builds. */
struct inputs {
    struct gpu_buffer corners, instances, scratch;
    VkDeviceAddress scratch_address;
};

static enum status upload_input(struct gpu *gpu, struct gpu_buffer *buffer, const void *data,
                                VkDeviceSize size)
{
    return gpu_buffer_create(gpu, buffer,
                             VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                                 VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                             data, size, name);
}

static enum status upload_vertices(struct gpu *gpu, struct inputs *inputs,
                                   const struct gpu_blas_groups *groups)
{
    size_t count = 0;
    for (uint32_t i = 0; i < groups->count; i++)
        count += groups->all[i].is_kept ? 0 : groups->all[i].count;
    float(*built)[3][3] = malloc((count + 1) * sizeof(*built));
    if (!built)
        return log_out_of_memory(name);
    count = 0;
    for (uint32_t i = 0; i < groups->count; i++) {
        const struct gpu_blas_group *group = &groups->all[i];
        if (group->is_kept)
            continue;
        memcpy(built[count], groups->corners[group->first], group->count * sizeof(*built));
        count += group->count;
    }
    const enum status status = upload_input(gpu, &inputs->corners, built, count * sizeof(*built));
    free(built);
    return status;
}

static enum status upload_instances(struct gpu *gpu, struct inputs *inputs,
                                    const struct gpu_acceleration *rays,
                                    const struct gpu_blas_groups *groups)
{
    VkAccelerationStructureInstanceKHR *instances =
        calloc(rays->count + (size_t)1, sizeof(*instances));
    if (!instances)
        return log_out_of_memory(name);
    for (uint32_t i = 0; i < rays->count; i++) {
        const VkAccelerationStructureDeviceAddressInfoKHR info = {
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
            .accelerationStructure = rays->blas_handles[i],
        };
        instances[i] = (VkAccelerationStructureInstanceKHR){
            .transform = groups->all[i].transform,
            .instanceShaderBindingTableRecordOffset = groups->all[i].first & 0xffffffu,
            .mask = groups->all[i].mask,
            .flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR,
            .accelerationStructureReference =
                vkGetAccelerationStructureDeviceAddressKHR(gpu->device, &info),
        };
    }
    /* one more instance than needed, because a buffer must not be empty */
    const enum status status =
        upload_input(gpu, &inputs->instances, instances, (rays->count + 1ull) * sizeof(*instances));
    free(instances);
    return status;
}

static enum status allocate_scratch(struct gpu *gpu, struct inputs *inputs,
                                    const struct gpu_acceleration *rays)
{
    VkPhysicalDeviceAccelerationStructurePropertiesKHR limits = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR,
    };
    VkPhysicalDeviceProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
        .pNext = &limits,
    };
    vkGetPhysicalDeviceProperties2(gpu->physical, &properties);
    const VkDeviceSize alignment = limits.minAccelerationStructureScratchOffsetAlignment;
    const enum status status = gpu_memory_buffer(gpu, &inputs->scratch,
                                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                                 rays->scratch_size + alignment, false, name);
    inputs->scratch_address =
        (address_of(gpu, &inputs->scratch) + alignment - 1) / alignment * alignment;
    return status;
}

/* Records a build and a barrier, so that the next build and later commands can use the result. */
static void record(VkCommandBuffer commands, struct build *build, VkAccelerationStructureKHR to,
                   VkDeviceAddress scratch)
{
    const VkAccelerationStructureBuildRangeInfoKHR range = { .primitiveCount = build->count };
    const VkAccelerationStructureBuildRangeInfoKHR *ranges = &range;
    build->info.dstAccelerationStructure = to;
    build->info.scratchData.deviceAddress = scratch;
    vkCmdBuildAccelerationStructuresKHR(commands, 1, &build->info, &ranges);
    gpu_record_visible(commands, VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                       VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR |
                           VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR);
}

static enum status run(struct gpu *gpu, const struct gpu_acceleration *rays,
                       const struct gpu_blas_groups *groups, const struct inputs *inputs)
{
    struct build build;
    struct gpu_upload upload = { 0 };
    VkDeviceAddress corners = address_of(gpu, &inputs->corners);
    /* the staging buffer is not used */
    enum status status = gpu_upload_begin(gpu, &upload, 1, name);
    for (uint32_t i = 0; i < groups->count && status == STATUS_OK; i++) {
        if (groups->all[i].is_kept)
            continue;
        describe_blas(&build, corners, groups->all[i].count);
        record(upload.commands, &build, rays->blas_handles[i], inputs->scratch_address);
        corners += groups->all[i].count * sizeof(float[3][3]);
    }
    if (status == STATUS_OK) {
        describe_tlas(&build, address_of(gpu, &inputs->instances), groups->count);
        record(upload.commands, &build, rays->tlas, inputs->scratch_address);
        status = gpu_upload_flush(gpu, &upload);
    }
    gpu_upload_finish(gpu, &upload);
    return status;
}

enum status gpu_acceleration_build(struct gpu *gpu, struct gpu_acceleration *rays,
                                   struct gpu_blas_groups *groups)
{
    struct inputs inputs = { 0 };
    enum status status = upload_vertices(gpu, &inputs, groups);
    if (status == STATUS_OK)
        status = upload_instances(gpu, &inputs, rays, groups);
    if (status == STATUS_OK)
        status = allocate_scratch(gpu, &inputs, rays);
    if (status == STATUS_OK)
        status = run(gpu, rays, groups, &inputs);
    gpu_buffer_destroy(gpu, &inputs.corners);
    gpu_buffer_destroy(gpu, &inputs.instances);
    gpu_buffer_destroy(gpu, &inputs.scratch);
    if (status == STATUS_OK) {
        gpu_blas_groups_finish(&rays->built);
        rays->built = *groups;
        *groups = (struct gpu_blas_groups){ 0 };
    }
    return status;
}
