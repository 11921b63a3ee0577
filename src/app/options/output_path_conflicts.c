/* output_path_conflicts.c: refuses command lines that would overwrite inputs or other outputs. */
#include "src/app/options/output_path_conflicts.h"
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include "src/app/options/option_values.h"
#include "src/base/log.h"
#include "src/base/path.h"

enum status option_input(const struct option *option, void *at, const char *value)
{
    return option_text(option, at, value);
}

enum status option_report(const struct option *option, void *at, const char *value)
{
    return option_text(option, at, value);
}

/* Calls stat() for the folder that contains `path`. Returns false if the folder does not exist. */
static bool stat_folder(const char *path, struct stat *info)
{
    char folder[4096] = ".";
    const char *slash = strrchr(path, '/');
    if (!slash)
        return stat(folder, info) == 0;
    const int length = snprintf(folder, sizeof(folder), "%.*s", (int)(slash - path) + 1, path);
    return (size_t)length < sizeof(folder) && stat(folder, info) == 0;
}

static bool is_same(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Returns true if two paths lead to the same regular file, which need not exist yet. */
static bool are_same_file(const char *a, const char *b)
{
    struct stat infos[2];
    if (!strcmp(a, "-") || !strcmp(b, "-"))
        return false; /* another check refuses two outputs on stdout */
    const bool has_a = stat(a, &infos[0]) == 0, has_b = stat(b, &infos[1]) == 0;
    if (has_a && has_b)
        return S_ISREG(infos[0].st_mode) && is_same(&infos[0], &infos[1]);
    return !has_a && !has_b && !strcmp(name_of(a), name_of(b)) && stat_folder(a, &infos[0]) &&
           stat_folder(b, &infos[1]) && is_same(&infos[0], &infos[1]);
}

static enum status refuse(const struct option_file *written, const struct option_file *other)
{
    if (other->is_written)
        log_error("%s: --%s and --%s write the same file; choose another name for one of them",
                  written->path, written->option, other->option);
    else if (other->option)
        log_error("%s: --%s would overwrite the file that --%s reads; choose another name",
                  written->path, written->option, other->option);
    else
        log_error("%s: --%s would overwrite the input '%s'; choose another name", written->path,
                  written->option, other->path);
    return STATUS_USAGE;
}

enum status option_check_files(const struct option_file *files, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; files[i].is_written && j < count; j++) {
            const bool is_pair = files[j].is_written ? j > i : true;
            if (is_pair && are_same_file(files[i].path, files[j].path))
                return refuse(&files[i], &files[j]);
        }
    }
    return STATUS_OK;
}
