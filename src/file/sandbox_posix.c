/* sandbox_posix.c: sandbox of reader processes: Landlock, seccomp filter, dropped capabilities. */
#define _GNU_SOURCE /* O_PATH, O_TMPFILE, syscall() */
#include <errno.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#include "src/file/sandbox.h"

static int landlock_version(void)
{
    const long version =
        syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION);
    return version > 0 ? (int)version : 0;
}

/* Returns all file system rights that a version of the Landlock ABI can deny, as a bit mask. The
 * seccomp filter blocks the operations that this version cannot deny. */
static uint64_t known_rights(int version)
{
    static const int bits[] = { 0, 13, 14, 15, 15, 16 };
    const int last = (int)(sizeof(bits) / sizeof(bits[0])) - 1;
    return ((uint64_t)1 << bits[version < last ? version : last]) - 1;
}

/* Allows reading a file, or all files below a folder. A `path` that does not exist is ignored. */
static void allow_reading(int rules, const char *path)
{
    struct landlock_path_beneath_attr rule = {
        .allowed_access = LANDLOCK_ACCESS_FS_READ_FILE,
        .parent_fd = open(path, O_PATH | O_CLOEXEC),
    };
    if (rule.parent_fd < 0)
        return;
    syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
    close(rule.parent_fd);
}

static void allow_folder(int rules, const char *path)
{
    char folder[4096];
    const char *slash = strrchr(path, '/');
    const size_t size = slash ? (size_t)(slash - path) + 1 : 0;
    if (size >= sizeof(folder))
        return;
    snprintf(folder, sizeof(folder), "%.*s", (int)size, path);
    allow_reading(rules, slash ? folder : ".");
}

static bool restrict_files(const char *path, bool with_folder)
{
    const int version = landlock_version();
    const struct landlock_ruleset_attr handled = { .handled_access_fs = known_rights(version) };
    if (version == 0)
        return true;
    const int rules =
        (int)syscall(SYS_landlock_create_ruleset, &handled, sizeof(handled.handled_access_fs), 0);
    if (rules < 0)
        return false;
    allow_reading(rules, path);
    if (with_folder)
        allow_folder(rules, path);
    const bool done = syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    close(rules);
    return done;
}

/* Drops all capabilities except those that let root read other users' files. Other capabilities
 * would allow tracing other processes, for example. */
static void drop_capabilities(void)
{
    struct __user_cap_header_struct header = { .version = _LINUX_CAPABILITY_VERSION_3 };
    struct __user_cap_data_struct sets[_LINUX_CAPABILITY_U32S_3] = { 0 };
    if (syscall(SYS_capget, &header, sets) != 0)
        return;
    const uint32_t allowed = 1u << CAP_DAC_OVERRIDE | 1u << CAP_DAC_READ_SEARCH;
    sets[0].permitted &= allowed;
    sets[0].effective &= allowed;
    sets[0].inheritable = 0;
    sets[1] = (struct __user_cap_data_struct){ 0 };
    syscall(SYS_capset, &header, sets);
}

/* System calls allowed with any arguments. They change nothing outside this process. */
static const int unrestricted_calls[] = {
    SCMP_SYS(access),         SCMP_SYS(brk),          SCMP_SYS(clock_getres),
    SCMP_SYS(clock_gettime),  SCMP_SYS(close),        SCMP_SYS(exit),
    SCMP_SYS(exit_group),     SCMP_SYS(faccessat),    SCMP_SYS(faccessat2),
    SCMP_SYS(fstat),          SCMP_SYS(fstatfs),      SCMP_SYS(futex),
    SCMP_SYS(getcwd),         SCMP_SYS(getpid),       SCMP_SYS(getrandom),
    SCMP_SYS(gettid),         SCMP_SYS(gettimeofday), SCMP_SYS(lseek),
    SCMP_SYS(lstat),          SCMP_SYS(madvise),      SCMP_SYS(mremap),
    SCMP_SYS(munmap),         SCMP_SYS(newfstatat),   SCMP_SYS(pread64),
    SCMP_SYS(read),           SCMP_SYS(readv),        SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sched_getaffinity),
    SCMP_SYS(sched_yield),    SCMP_SYS(sigaltstack),  SCMP_SYS(stat),
    SCMP_SYS(statx),          SCMP_SYS(sysinfo),
};

/* System call that is allowed only if (argument & mask) equals `value`. */
struct restricted_call {
    int call;
    unsigned argument;
    uint64_t mask, value;
};

static bool add_rules(scmp_filter_ctx filter)
{
    const uint64_t to_write = O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND | (O_TMPFILE & ~O_DIRECTORY);
    const struct restricted_call restricted_calls[] = {
        { SCMP_SYS(open), 1, to_write, O_RDONLY },
        { SCMP_SYS(openat), 2, to_write, O_RDONLY },
        { SCMP_SYS(mmap), 2, PROT_EXEC, 0 },
        { SCMP_SYS(mprotect), 2, PROT_EXEC, 0 },
        { SCMP_SYS(write), 0, UINT64_MAX, STDOUT_FILENO },
        { SCMP_SYS(write), 0, UINT64_MAX, STDERR_FILENO },
        { SCMP_SYS(writev), 0, UINT64_MAX, STDERR_FILENO },
        { SCMP_SYS(fcntl), 1, UINT64_MAX, F_GETFL },
        { SCMP_SYS(tgkill), 0, UINT64_MAX, (uint64_t)getpid() }, /* for abort() */
    };
    bool done = true;
    for (size_t i = 0; i < sizeof(unrestricted_calls) / sizeof(unrestricted_calls[0]); i++)
        done = done && seccomp_rule_add(filter, SCMP_ACT_ALLOW, unrestricted_calls[i], 0) == 0;
    for (size_t i = 0; i < sizeof(restricted_calls) / sizeof(restricted_calls[0]); i++) {
        const struct restricted_call *b = &restricted_calls[i];
        const struct scmp_arg_cmp compare = { b->argument, SCMP_CMP_MASKED_EQ, b->mask, b->value };
        done = done && seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, b->call, 1, &compare) == 0;
    }
    return done;
}

/* Returns true if the kernel has seccomp filters and thus rejects a NULL filter with EFAULT. */
static bool has_seccomp(void)
{
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, NULL) != 0 && errno == EFAULT;
}

static bool filter_calls(void)
{
    if (!has_seccomp())
        return true;
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    const bool done = filter && add_rules(filter) && seccomp_load(filter) == 0;
    seccomp_release(filter);
    return done;
}

bool sandbox_enter(const char *path, bool with_folder)
{
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || !restrict_files(path, with_folder))
        return false;
    drop_capabilities();
    return filter_calls();
}

struct sandbox_support sandbox_query(void)
{
    return (struct sandbox_support){
        .landlock = landlock_version(),
        .seccomp = has_seccomp(),
    };
}
