/* gpu_fallback.c: makes the Vulkan loader use the bundled CPU driver. */
#include "src/gpu/gpu_fallback.h"
#include <stdlib.h>
#include "src/base/environment.h"
#include "src/base/file_info.h"
#include "src/base/program.h"

static const char manifest[] = "../lib/lavapipe/icd.json"; /* relative to the program */
static const char name[] = "VK_ADD_DRIVER_FILES";

/* Returns true if the bundled driver exists, and writes the path of its manifest. */
static bool find_manifest(char path[static PROGRAM_PATH_SIZE])
{
    return program_path(path, manifest) && file_is_readable(path);
}

void gpu_fallback_prepare(void)
{
    const char *value = getenv(name);
    char path[PROGRAM_PATH_SIZE];
    if ((!value || !value[0]) && find_manifest(path))
        (void)environment_reserve(name, PROGRAM_PATH_SIZE); /* without a fallback on failure */
}

bool gpu_fallback_is_ready(void)
{
    const char *value = getenv(name);
    char path[PROGRAM_PATH_SIZE];
    return value && !value[0] && find_manifest(path);
}

void gpu_fallback_use(void)
{
    const char *value = getenv(name);
    char path[PROGRAM_PATH_SIZE];
    if (value && program_path(path, manifest))
        environment_fill(name, path);
}
