/* vulkan_functions.c: loads the Vulkan functions of an executor. */
#include "graph/exec/vulkan_functions.h"
#include <stddef.h>

const char *rg_functions_find(struct rg_functions *functions, PFN_vkGetInstanceProcAddr find,
                              VkInstance instance)
{
    const char *missing = NULL;
#define FIND(function) functions->function = (PFN_vk##function)find(instance, "vk" #function);
#define FIND_OR_MISS(function) \
    FIND(function) \
    if (!functions->function) \
        missing = "vk" #function;
    RG_FUNCTIONS(FIND_OR_MISS)
    RG_FUNCTIONS_OPTIONAL(FIND)
    return missing;
}
