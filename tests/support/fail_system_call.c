/*
 * fail_system_call.c: LD_PRELOAD library for fault injection into file output: it makes one system
 * call fail while an output file is written, or kills the process before that call.
 *
 * FAIL_AT: number of the call for temporary files that fails, from 1; counted are openat, write,
 * fsync, close, renameat, unlinkat, and fsync of the folder. FAIL_HOW: "full" (ENOSPC), "broken"
 * (EIO), "short" (writes one byte, then ENOSPC), "kill". It prints the failed call to stderr:
 * "fail_call: write".
 */
#define _GNU_SOURCE      /* for RTLD_NEXT and openat64 */
#undef _FILE_OFFSET_BITS /* it would make openat an alias of openat64 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int output = -1; /* file descriptor of the temporary file being written */
static int calls;
static bool full; /* "short": all further writes fail */

static bool is_temporary(const char *name)
{
    const size_t length = name ? strlen(name) : 0;
    return length > 4 && !strcmp(name + length - 4, ".tmp");
}

static const char *how(void)
{
    const char *text = getenv("FAIL_HOW");
    return text ? text : "";
}

/* Points *function to the next definition of `name`; ISO C cannot cast void * to a function. */
static void find(void *function, const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    memcpy(function, &found, sizeof(found));
}

/* Returns true and sets errno if this call must fail, or kills the process instead. */
static bool fails(const char *call)
{
    const char *at = getenv("FAIL_AT");
    if (!at || ++calls != atoi(at))
        return false;
    dprintf(STDERR_FILENO, "fail_call: %s\n", call);
    if (!strcmp(how(), "kill"))
        raise(SIGKILL);
    errno = !strcmp(how(), "broken") ? EIO : ENOSPC;
    return true;
}

/* NOLINTBEGIN(readability-inconsistent-declaration-parameter-name): libc's names are reserved */

static int open_at(const char *function, int folder, const char *name, int flags, mode_t mode)
{
    int (*next)(int, const char *, int, ...);
    find(&next, function);
    const bool is_output = flags & O_CREAT && is_temporary(name);
    if (is_output && fails("openat"))
        return -1;
    const int file = next(folder, name, flags, mode);
    if (is_output)
        output = file;
    return file;
}

int openat(int folder, const char *name, int flags, ...)
{
    va_list list;
    va_start(list, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0;
    va_end(list);
    return open_at("openat", folder, name, flags, mode);
}

int openat64(int folder, const char *name, int flags, ...)
{
    va_list list;
    va_start(list, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0;
    va_end(list);
    return open_at("openat64", folder, name, flags, mode);
}

ssize_t write(int file, const void *data, size_t size)
{
    ssize_t (*next)(int, const void *, size_t);
    find(&next, "write");
    const bool is_output = file >= 0 && file == output;
    if (is_output && full) {
        errno = ENOSPC;
        return -1;
    }
    if (!is_output || !fails("write"))
        return next(file, data, size);
    full = !strcmp(how(), "short");
    return full ? next(file, data, 1) : -1;
}

/* Counts all calls, because firn synchronises only the temporary file and its folder. */
int fsync(int file)
{
    int (*next)(int);
    find(&next, "fsync");
    return fails("fsync") ? -1 : next(file);
}

int close(int file)
{
    int (*next)(int);
    find(&next, "close");
    const bool is_output = file >= 0 && file == output;
    if (is_output)
        output = -1;
    const bool failed = is_output && fails("close");
    const int kept = errno;
    const int result = next(file);
    if (!failed)
        return result;
    errno = kept;
    return -1;
}

int renameat(int folder, const char *name, int new_folder, const char *new_name)
{
    int (*next)(int, const char *, int, const char *);
    find(&next, "renameat");
    return fails("renameat") ? -1 : next(folder, name, new_folder, new_name);
}

int unlinkat(int folder, const char *name, int flags)
{
    int (*next)(int, const char *, int);
    find(&next, "unlinkat");
    return is_temporary(name) && fails("unlinkat") ? -1 : next(folder, name, flags);
}

/* NOLINTEND(readability-inconsistent-declaration-parameter-name) */
