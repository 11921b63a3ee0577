/*
 * keep_drivers.c: linked into every program that tests on a device.
 *
 * Loader, driver and layers stay loaded to the end, because the leak sanitizer cannot name, and
 * therefore not suppress, allocations of a library that is unloaded. Programs that use no device do
 * not load them, since that takes longer than their tests.
 */
#include <dlfcn.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include "src/reader/reader.h"

static bool needs_no_device(const char *command)
{
    static const char *const commands[] = { "graph", "diff", "merge", "--version", READER_OPTION };
    for (size_t i = 0; i < sizeof(commands) / sizeof(commands[0]); i++) {
        if (!strcmp(command, commands[i]))
            return true;
    }
    return false;
}

/* The layer alone takes a tenth of a small picture's time. */
static bool validates(int argc, char **argv)
{
    bool is_asked = argc == 1; /* a test does */
    for (int i = 1; i < argc; i++)
        is_asked = is_asked || !strcmp(argv[i], "--validate");
    return is_asked;
}

/* The C library tells constructors what main() is told. */
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
