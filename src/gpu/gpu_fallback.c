/* gpu_fallback.c: makes the Vulkan loader use the bundled CPU driver. */
#define _XOPEN_SOURCE 700 /* putenv() */
#include "src/gpu/gpu_fallback.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/base/program.h"

static const char manifest[] = "../lib/lavapipe/icd.json"; /* relative to the program */
static const char name[] = "VK_ADD_DRIVER_FILES";

/* Returns true if the bundled driver exists, and writes the path of its manifest. */
static bool find_manifest(char path[static PROGRAM_PATH_SIZE])
{
    return program_path(path, manifest) && access(path, R_OK) == 0;
}

void gpu_fallback_prepare(void)
{
    const char *value = getenv(name);
    char path[PROGRAM_PATH_SIZE];
    char *variable;
    if ((value && value[0]) || !find_manifest(path))
        return;
    variable = malloc(sizeof(name) + PROGRAM_PATH_SIZE);
    if (!variable)
        return; /* without a fallback */
    snprintf(variable, sizeof(name) + PROGRAM_PATH_SIZE, "%s=", name);
    if (putenv(variable) != 0)
        free(variable);
    /* NOLINTNEXTLINE(clang-analyzer-unix.Malloc): the environment keeps it */
}

bool gpu_fallback_is_ready(void)
{
    const char *value = getenv(name);
    char path[PROGRAM_PATH_SIZE];
    return value && !value[0] && find_manifest(path);
}

/* Changes the value in place, because setenv() would race with threads that read the environment.
 * gpu_fallback_prepare() has reserved the space. */
void gpu_fallback_use(void)
{
    char *value = getenv(name);
    char path[PROGRAM_PATH_SIZE];
    if (value && program_path(path, manifest))
        memcpy(value, path, strlen(path) + 1);
}
