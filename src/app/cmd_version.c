/* cmd_version.c: firn --version: the version; with --verbose also the build, its libraries and the
 * folders in use. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/base/program.h"
#include "src/scene/bundled_assets.h"
#include "src/version.h"

/* Prints where assets are found, or that they are missing. */
static void print_assets(void)
{
    char *path = NULL;
    const struct asset *asset = &assets[0];
    if (!asset_exists(asset)) {
        printf("  assets        not found\n");
        return;
    }
    if (asset_locate(asset, &path) == STATUS_OK)
        printf("  assets        %.*s\n", (int)(strrchr(path, '/') - path), path);
    free(path);
}

enum status app_version(const char *option)
{
    char program[PROGRAM_PATH_SIZE];
    const bool is_verbose = option && !strcmp(option, "--verbose");
    if (option && !is_verbose) {
        log_error("--version: expected --verbose or nothing, got '%s'", option);
        return STATUS_USAGE;
    }
    printf("firn %s\n", FIRN_VERSION);
    if (!is_verbose)
        return STATUS_OK;
    printf("  compiler      %s\n  build         %s\n  libraries     %s\n  without       %s\n",
           FIRN_COMPILER, FIRN_BUILD, FIRN_LIBRARIES, FIRN_WITHOUT);
    if (program_path(program, NULL))
        printf("  program       %s\n", program);
    print_assets();
    return STATUS_OK;
}
