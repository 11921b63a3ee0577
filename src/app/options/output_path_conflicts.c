/* output_path_conflicts.c: refuses command lines that would overwrite inputs or other outputs. */
#include "src/app/options/output_path_conflicts.h"
#include <stdio.h>
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/file_info.h"
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

/* Describes the folder that contains `path`. */
static struct file_info folder_of(const char *path)
{
    char folder[4096] = ".";
    const char *slash = strrchr(path, '/');
    if (!slash)
        return file_info_of(folder);
    const int length = snprintf(folder, sizeof(folder), "%.*s", (int)(slash - path) + 1, path);
    return (size_t)length < sizeof(folder) ? file_info_of(folder)
                                           : (struct file_info){ .kind = FILE_MISSING };
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Returns true if two paths lead to the same regular file, which need not exist yet. */
static bool are_same_file(const char *a, const char *b)
{
    if (!strcmp(a, "-") || !strcmp(b, "-"))
        return false; /* another check refuses two outputs on stdout */
    const struct file_info infos[2] = { file_info_of(a), file_info_of(b) };
    const bool has_a = infos[0].kind != FILE_MISSING, has_b = infos[1].kind != FILE_MISSING;
    if (has_a && has_b)
        return infos[0].kind == FILE_REGULAR && file_info_is_same(&infos[0], &infos[1]);
    const struct file_info folders[2] = { folder_of(a), folder_of(b) };
    return !has_a && !has_b && !strcmp(name_of(a), name_of(b)) &&
           file_info_is_same(&folders[0], &folders[1]);
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
