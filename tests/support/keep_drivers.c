/*
 * keep_drivers.c: keeps Vulkan libraries loaded until exit; linked into every test on a device.
 *
 * LeakSanitizer cannot name, and therefore not suppress, allocations of a library that was
 * unloaded. Programs that use no device do not load the libraries, since loading takes longer
 * than their tests.
 */
#include <dlfcn.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include "src/file/reader_process.h"

static bool needs_no_device(const char *command)
{
    static const char *const commands[] = { "graph", "diff", "merge", "--version", READER_OPTION };
    for (size_t i = 0; i < sizeof(commands) / sizeof(commands[0]); i++) {
        if (!strcmp(command, commands[i]))
            return true;
    }
    return false;
}

/* Returns true if the validation layer is used; loading it costs a tenth of a small render. */
static bool validates(int argc, char **argv)
{
    bool is_asked = argc == 1; /* unit tests have no arguments and always validate */
    for (int i = 1; i < argc; i++)
        is_asked = is_asked || !strcmp(argv[i], "--validate");
    return is_asked;
}

/* glibc passes the arguments of main() to constructors. */
__attribute__((constructor)) static void keep_drivers(int argc, char **argv)
{
    if (argc > 1 && needs_no_device(argv[1]))
        return;
    static const char *const names[] = {
        "libvulkan.so.1",
        "libvulkan_lvp.so",
        "libVkLayer_khronos_validation.so",
    };
    const size_t count = sizeof(names) / sizeof(names[0]) - (validates(argc, argv) ? 0 : 1);
    for (size_t i = 0; i < count; i++)
        (void)dlopen(names[i], RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}
