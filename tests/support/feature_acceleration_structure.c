/* feature_acceleration_structure.c: feature graph of ray tracing: BLAS of a triangle, TLAS of one
 * instance. */
#include "tests/support/feature_graphs.h"

static const struct rg_buffer lower = { .name = "lower", .size = STRUCTURE_SIZE };
static const struct rg_buffer upper = { .name = "upper", .size = STRUCTURE_SIZE };
static const struct rg_buffer scratch = {
    .name = "scratch",
    .size = STRUCTURE_SIZE + STRUCTURE_ALIGNMENT,
};
static const struct rg_buffer instances = {
    .name = "instances",
    .size = sizeof(VkAccelerationStructureInstanceKHR),
};
static const struct rg_buffer hits = { .name = "hits", .size_per_texel = sizeof(uint32_t) };
static const struct rg_buffer hits_out = FEATURE_NUMBERS("hits out");

const struct rg_buffer feature_structure_triangle = {
    .name = "triangle",
    .size = 3 * sizeof(vec3s),
    .memory = RG_MEMORY_UPLOAD,
};

static void build(struct rg_cmd *cmd, VkAccelerationStructureTypeKHR type,
                  const VkAccelerationStructureGeometryKHR *geometry, const struct rg_buffer *to)
{
    const VkDeviceAddress start = rg_cmd_address(cmd, &scratch);
    const VkAccelerationStructureBuildGeometryInfoKHR info = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
        .type = type,
        .mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR,
        .dstAccelerationStructure = rg_cmd_acceleration(cmd, to),
        .geometryCount = 1,
        .pGeometries = geometry,
        .scratchData.deviceAddress =
            (start + STRUCTURE_ALIGNMENT - 1) / STRUCTURE_ALIGNMENT * STRUCTURE_ALIGNMENT,
    };
    const VkAccelerationStructureBuildRangeInfoKHR one = { .primitiveCount = 1 };
    const VkAccelerationStructureBuildRangeInfoKHR *ranges = &one;
    vkCmdBuildAccelerationStructuresKHR(rg_cmd_vulkan(cmd), 1, &info, &ranges);
}

static void record_lower(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const VkAccelerationStructureGeometryKHR geometry = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR,
        .geometry.triangles = {
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
            .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
            .vertexData.deviceAddress = rg_cmd_address(cmd, &feature_structure_triangle),
            .vertexStride = sizeof(vec3s),
            .maxVertex = 2,
            .indexType = VK_INDEX_TYPE_NONE_KHR,
        },
        .flags = VK_GEOMETRY_OPAQUE_BIT_KHR,
    };
    (void)frame;
    build(cmd, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, &geometry, &lower);
}

static void record_instances(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const VkAccelerationStructureInstanceKHR instance = {
        .transform = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } },
        .mask = 0xff,
        .flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR,
        .accelerationStructureReference = rg_cmd_address(cmd, &lower),
    };
    (void)frame;
    vkCmdUpdateBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, &instances), 0, sizeof(instance),
                      &instance);
}

static void record_upper(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const VkAccelerationStructureGeometryKHR geometry = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR,
        .geometry.instances = {
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
            .data.deviceAddress = rg_cmd_address(cmd, &instances),
        },
    };
    (void)frame;
    build(cmd, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, &geometry, &upper);
}

static const struct rg_pass structure_rows[] = {
    {
        .name = "build lower",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &feature_structure_triangle, .access = RG_BUILD_INPUT },
                        { .buffer = &scratch, .access = RG_BUILD_SCRATCH },
                        { .buffer = &lower, .access = RG_BUILD }),
        .record = record_lower,
    },
    {
        .name = "instances",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &lower, .access = RG_BUILD_SOURCE },
                        { .buffer = &instances, .access = RG_COPY_DST }),
        .record = record_instances,
    },
    {
        .name = "build upper",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &lower, .access = RG_BUILD_SOURCE },
                        { .buffer = &instances, .access = RG_BUILD_INPUT },
                        { .buffer = &scratch, .access = RG_BUILD_SCRATCH },
                        { .buffer = &upper, .access = RG_BUILD }),
        .record = record_upper,
    },
    {
        .name = "trace",
        .kind = RG_COMPUTE,
        .uses = RG_USES({ .buffer = &hits, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS },
                        { .buffer = &upper, .access = RG_TRACE, .binding = DATA_IMAGE }),
        .comp = &trace_comp,
        .record = feature_record_texels,
    },
    FEATURE_COPY("copy", hits, hits_out),
};

const struct feature feature_structure = {
    .name = "feature_structure",
    .params = {
        .technique = RG_TECHNIQUE("structure", structure_rows),
        .outputs = { &hits_out },
    },
};
