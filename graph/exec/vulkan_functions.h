/* vulkan_functions.h: table of the Vulkan functions that the executor calls. Each executor loads
 * its own table. No loader is linked, and no global names can collide. Private to graph/. */
#ifndef RG_EXEC_VULKAN_FUNCTIONS_H
#define RG_EXEC_VULKAN_FUNCTIONS_H

#include <vulkan/vulkan_core.h>

/* clang-format off */
#define RG_FUNCTIONS(row) \
    row(AllocateCommandBuffers) row(AllocateDescriptorSets) row(AllocateMemory) \
    row(BeginCommandBuffer) row(BindBufferMemory) row(BindImageMemory) row(CmdBeginQuery) \
    row(CmdBeginRenderPass) row(CmdBeginRendering) row(CmdBindDescriptorSets) \
    row(CmdBindIndexBuffer) row(CmdBindPipeline) row(CmdBindVertexBuffers) \
    row(CmdClearColorImage) row(CmdClearDepthStencilImage) row(CmdCopyBufferToImage) \
    row(CmdCopyImageToBuffer) row(CmdDispatch) row(CmdDispatchIndirect) row(CmdDraw) \
    row(CmdDrawIndexed) row(CmdDrawIndexedIndirect) row(CmdDrawIndexedIndirectCount) \
    row(CmdDrawIndirect) row(CmdDrawIndirectCount) row(CmdEndQuery) \
    row(CmdEndRenderPass) row(CmdEndRendering) row(CmdExecuteCommands) row(CmdFillBuffer) \
    row(CmdPipelineBarrier2) row(CmdPushConstants) row(CmdResetQueryPool) row(CmdSetScissor) \
    row(CmdSetViewport) \
    row(CmdWriteTimestamp2) row(CreateBuffer) row(CreateBufferView) row(CreateCommandPool) \
    row(CreateComputePipelines) row(CreateDescriptorPool) row(CreateDescriptorSetLayout) \
    row(CreateFence) row(CreateFramebuffer) row(CreateGraphicsPipelines) row(CreateImage) \
    row(CreateImageView) row(CreatePipelineLayout) row(CreateQueryPool) row(CreateRenderPass) \
    row(CreateSampler) row(CreateSemaphore) row(CreateShaderModule) row(DestroyBuffer) \
    row(DestroyBufferView) \
    row(DestroyCommandPool) row(DestroyDescriptorPool) row(DestroyDescriptorSetLayout) \
    row(DestroyFence) row(DestroyFramebuffer) row(DestroyImage) row(DestroyImageView) \
    row(DestroyPipeline) row(DestroyPipelineLayout) row(DestroyQueryPool) row(DestroyRenderPass) \
    row(DestroySampler) row(DestroySemaphore) row(DestroyShaderModule) row(EndCommandBuffer) \
    row(FlushMappedMemoryRanges) row(FreeMemory) row(GetBufferMemoryRequirements) \
    row(GetImageMemoryRequirements) row(GetPhysicalDeviceFeatures2) \
    row(GetPhysicalDeviceMemoryProperties) row(GetPhysicalDeviceProperties) \
    row(GetPhysicalDeviceQueueFamilyProperties) row(GetQueryPoolResults) \
    row(InvalidateMappedMemoryRanges) row(MapMemory) row(QueueSubmit2) row(QueueWaitIdle) \
    row(ResetFences) row(UnmapMemory) row(UpdateDescriptorSets) \
    row(WaitForFences)

/* Functions that are NULL without VK_EXT_debug_utils. */
#define RG_FUNCTIONS_OPTIONAL(row) \
    row(CmdBeginDebugUtilsLabelEXT) row(CmdEndDebugUtilsLabelEXT) row(SetDebugUtilsObjectNameEXT)

/* clang-format on */

struct rg_functions {
#define MEMBER(name) PFN_vk##name name;
    RG_FUNCTIONS(MEMBER)
    RG_FUNCTIONS_OPTIONAL(MEMBER)
#undef MEMBER
};

#endif
