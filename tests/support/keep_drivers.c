/*
 * keep_drivers.c: linked into every program that tests on a device.
 *
 * Loader, driver and layers stay loaded to the end: the leak sanitizer cannot name, and hence not
 * suppress, what a library allocated that is gone by then.
 */
#include <dlfcn.h>
#include <stddef.h>

__attribute__((constructor)) static void keep_drivers(void)
{
    static const char *const names[] = {
        "libvulkan.so.1",
        "libvulkan_lvp.so",
        "libVkLayer_khronos_validation.so",
    };
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
        (void)dlopen(names[i], RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}
