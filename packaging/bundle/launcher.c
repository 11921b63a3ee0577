/*
 * launcher.c: bin/firn of a bundle: starts libexec/firn.
 *
 * Linked statically, so that it also runs on systems too old for the bundle: it prints one line if
 * glibc is missing or too old. Libraries that device drivers and desktops bring are used from the
 * bundle only if the system has none, or older ones, because drivers of the system need those of
 * the system.
 */
#define _GNU_SOURCE /* memmem() */
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    PATH_SIZE = 4096,
    NO_DEVICE = 69, /* exit code on a machine that cannot run firn */
    CLASS_64 = 2,   /* byte 4 of an ELF file for 64-bit machines */
};

static const char needed_glibc[] = "GLIBC_2.36";

/* Libraries with the symbol versions that the bundle needs, and folders of the bundle. */
static const struct {
    const char *name, *version, *folder;
} shared[] = {
    { "libstdc++.so.6", "GLIBCXX_3.4.30", "lib/c++" },
    { "libX11.so.6", "XOpenDisplay", "lib/window" },
    { "libfontconfig.so.1", "FcInitLoadConfig", "lib/window" },
};

/* Returns true if a 64-bit ELF file contains a string. */
static bool contains(const char *path, const char *text)
{
    struct stat info;
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    bool found = false;
    if (file < 0)
        return false;
    if (fstat(file, &info) == 0 && info.st_size > 16) {
        const size_t size = (size_t)info.st_size;
        char *data = mmap(NULL, size, PROT_READ, MAP_PRIVATE, file, 0);
        if (data != MAP_FAILED) {
            found = memcmp(data, "\177ELF", 4) == 0 && data[4] == CLASS_64 &&
                    memmem(data, size, text, strlen(text) + 1);
            munmap(data, size);
        }
    }
    close(file);
    return found;
}

/* Returns true if the system has a library with a symbol version. */
static bool system_has(const char *library, const char *version)
{
    static const char *const folders[] = { "/lib/x86_64-linux-gnu",
                                           "/usr/lib/x86_64-linux-gnu",
                                           "/lib64",
                                           "/usr/lib64",
                                           "/lib",
                                           "/usr/lib" };
    char path[PATH_SIZE];
    for (size_t i = 0; i < sizeof(folders) / sizeof(folders[0]); i++) {
        snprintf(path, sizeof(path), "%s/%s", folders[i], library);
        if (contains(path, version))
            return true;
    }
    return false;
}

/* Appends a folder of the bundle to LD_LIBRARY_PATH. */
static void add_folder(const char *root, const char *folder)
{
    const char *before = getenv("LD_LIBRARY_PATH");
    char value[2 * PATH_SIZE];
    if (before && strlen(before) >= PATH_SIZE)
        return;
    snprintf(value, sizeof(value), "%s%s%s/%s", before ? before : "", before && *before ? ":" : "",
             root, folder);
    setenv("LD_LIBRARY_PATH", value, 1);
}

/* Writes the bundle's folder, two levels above this program. Returns false if it is unknown. */
static bool find_root(char root[static PATH_SIZE])
{
    const ssize_t length = readlink("/proc/self/exe", root, PATH_SIZE - 1);
    root[length > 0 ? length : 0] = '\0';
    for (int i = 0; i < 2; i++) {
        char *slash = strrchr(root, '/');
        if (!slash)
            return false;
        *slash = '\0';
    }
    return true;
}

int main(int argc, char **argv)
{
    char root[PATH_SIZE], program[PATH_SIZE + sizeof("/libexec/firn")], called[sizeof(program)];
    if (!find_root(root)) {
        fprintf(stderr, "firn: cannot read /proc/self/exe: mount /proc\n");
        return NO_DEVICE;
    }
    if (!system_has("libc.so.6", needed_glibc)) {
        fprintf(stderr, "firn: needs glibc 2.36 or later, which this system does not have\n");
        return NO_DEVICE;
    }
    for (size_t i = 0; i < sizeof(shared) / sizeof(shared[0]); i++) {
        if (!system_has(shared[i].name, shared[i].version))
            add_folder(root, shared[i].folder);
    }
    snprintf(program, sizeof(program), "%s/libexec/firn", root);
    snprintf(called, sizeof(called), "%s/bin/firn", root);
    if (argc > 0)
        argv[0] = called;
    execv(program, argv);
    fprintf(stderr, "firn: cannot start %s: %s\n", program, strerror(errno));
    return NO_DEVICE;
}
