/* xdg_folders.c: the viewer's XDG folders, and enumeration of the files in a folder. */
#define _GNU_SOURCE /* for asprintf */
#include "src/view/session/xdg_folders.h"
#include <dirent.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/base/path.h"
#include "src/scene/scene.h"

enum {
    NUMBER_MAX = 9999,
};

static const char *const models[] = { ".obj", ".ply", ".stl", ".gltf", ".glb", NULL };

__attribute__((format(printf, 1, 2))) static char *print(const char *format, ...)
{
    va_list arguments;
    char *text = NULL;
    va_start(arguments, format);
    if (vasprintf(&text, format, arguments) < 0)
        text = NULL;
    va_end(arguments);
    return text;
}

/* Creates a folder and its missing parents. */
static bool make_folder(char *path)
{
    for (char *slash = path + 1; *slash; slash++) {
        if (*slash != '/')
            continue;
        *slash = '\0';
        const bool made = mkdir(path, 0700) == 0 || errno == EEXIST;
        *slash = '/';
        if (!made)
            return false;
    }
    return mkdir(path, 0700) == 0 || errno == EEXIST;
}

/* Returns $variable/name, or $HOME/below_home/name if unset. With `make`, creates the folder. */
static char *firn_folder(const char *variable, const char *below_home, const char *name, bool make)
{
    const char *given = getenv(variable);
    const char *home = getenv("HOME");
    char *path = NULL;
    if (given && given[0] == '/') /* XDG: relative paths are invalid */
        path = print("%s/%s", given, name);
    else if (home && home[0] == '/')
        path = print("%s/%s/%s", home, below_home, name);
    if (path && make && !make_folder(path)) {
        free(path);
        path = NULL;
    }
    return path;
}

char *user_files_data(const char *what, bool make)
{
    char *name = print("firn/%ss", what);
    char *path = name ? firn_folder("XDG_DATA_HOME", ".local/share", name, make) : NULL;
    free(name);
    return path;
}

char *user_files_state(bool make)
{
    return firn_folder("XDG_STATE_HOME", ".local/state", "firn", make);
}

char *user_files_new(const char *folder, const char *stem, const char *ending)
{
    for (unsigned i = 1; i <= NUMBER_MAX; i++) {
        char *path = print("%s/%s-%04u%s", folder, stem, i, ending);
        if (!path || access(path, F_OK) != 0)
            return path;
        free(path);
    }
    return NULL;
}

static bool has_ending(const char *name, const char *const *endings)
{
    for (; *endings; endings++) {
        if (path_ends_in(name, *endings))
            return name[0] != '.';
    }
    return false;
}

/* Lists the entries of a folder in alphabetical order. The caller frees `entries`. */
static int list(const char *folder, struct dirent ***entries)
{
    const int count = scandir(folder, entries, NULL, alphasort);
    return count < 0 ? 0 : count;
}

static void forget(struct dirent **entries, int count)
{
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
}

char *user_files_at(const char *folder, const char *const *endings, unsigned i)
{
    struct dirent **entries = NULL;
    const int count = list(folder, &entries);
    char *path = NULL;
    for (int e = 0; e < count && !path; e++) {
        if (has_ending(entries[e]->d_name, endings) && !i--)
            path = print("%s/%s", folder, entries[e]->d_name);
    }
    forget(entries, count);
    return path;
}

static char *next_scene(const char *name, int step)
{
    uint32_t count = 0;
    uint32_t at = 0;
    const char *other;
    for (; (other = scene_name(count)); count++) {
        if (!strcmp(other, name))
            at = count;
    }
    return count ? strdup(scene_name((at + count + (uint32_t)step) % count)) : NULL;
}

char *user_files_next_model(const char *path, int step)
{
    if (scene_is_known(path))
        return next_scene(path, step);
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup("./");
    struct dirent **entries = NULL;
    const int count = folder ? list(folder, &entries) : 0;
    char *found = NULL;
    int at = 0;
    while (at < count && strcmp(entries[at]->d_name, name) != 0)
        at++;
    for (int i = 1; i < count && at < count && !found; i++) {
        const char *next = entries[(at + step * i + count * i) % count]->d_name;
        if (has_ending(next, models))
            found = print("%s%s", slash ? folder : "", next);
    }
    forget(entries, count);
    free(folder);
    return found;
}
