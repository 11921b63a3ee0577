/* functions.c: finds the Vulkan functions of an executor. */
#include "graph/exec/exec.h"

VkResult rg_exec_find_functions(struct rg_exec *exec)
{
    const PFN_vkGetInstanceProcAddr find = exec->params.get_proc_addr;
    const char *missing = NULL;
#define FIND(function) \
    exec->vk.function = (PFN_vk##function)find(exec->params.instance, "vk" #function);
#define FIND_OR_MISS(function) \
    FIND(function) \
    if (!exec->vk.function) \
        missing = "vk" #function;
    RG_FUNCTIONS(FIND_OR_MISS)
    RG_FUNCTIONS_DEBUG(FIND)
    return missing
               ? rg_exec_check(exec, VK_ERROR_INCOMPATIBLE_DRIVER, "vkGetInstanceProcAddr", missing)
               : VK_SUCCESS;
}
