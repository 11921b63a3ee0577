/*
 * taken_over.c: fake exploit to test the sandbox: a parser hijacked by a malicious file.
 *
 * Loaded into firn with LD_PRELOAD, it waits in the reader process for the first fopen(), attempts
 * what an exploit could want, prints to stderr that it ran and which attempts succeeded, and lets
 * the reader continue. Files are those of the working directory, which contains `victim`.
 */
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

static bool is_reader;

__attribute__((constructor)) static void look_at_arguments(int argc, char **argv)
{
    is_reader = argc > 1 && strcmp(argv[1], "--read") == 0;
}

/* ---- attempts: each returns true if it succeeded ---- */

static bool can_open(const char *path, int flags)
{
    const int file = open(path, flags, 0600);
    if (file >= 0)
        close(file);
    return file >= 0;
}

static bool can_open_of_parent(const char *name, int flags)
{
    char path[64];
    snprintf(path, sizeof(path), "/proc/%d/%s", (int)getppid(), name);
    return can_open(path, flags);
}

static bool read_victim(void)
{
    return can_open("victim", O_RDONLY);
}

static bool read_passwords(void)
{
    return can_open("/etc/passwd", O_RDONLY);
}

static bool read_parent(void)
{
    return can_open_of_parent("mem", O_RDONLY);
}

static bool write_parent(void)
{
    return can_open_of_parent("mem", O_RDWR);
}

static bool read_environment_of_parent(void)
{
    return can_open_of_parent("environ", O_RDONLY);
}

static bool read_memory_of_parent(void)
{
    char byte;
    const struct iovec here = { &byte, 1 }, there = { (void *)&is_reader, 1 };
    return process_vm_readv(getppid(), &here, 1, &there, 1, 0) == 1;
}

static bool trace_parent(void)
{
    return ptrace(PTRACE_SEIZE, getppid(), NULL, NULL) == 0;
}

static bool signal_parent(void)
{
    return kill(getppid(), 0) == 0;
}

static bool environment(void)
{
    for (char **variable = environ; variable && *variable; variable++) {
        if (strncmp(*variable, "LD_", 3) != 0 && !strstr(*variable, "SAN_OPTIONS="))
            return true;
    }
    return false;
}

static bool write_file(void)
{
    return can_open("victim", O_WRONLY);
}

static bool create_file(void)
{
    return can_open("created", O_RDWR | O_CREAT);
}

static bool create_folder(void)
{
    return mkdir("folder", 0700) == 0;
}

static bool link_file(void)
{
    return link("victim", "linked") == 0 || symlink("victim", "symlinked") == 0;
}

static bool change_mode(void)
{
    return chmod("victim", 0600) == 0;
}

static bool truncate_file(void)
{
    return truncate("victim", 1) == 0;
}

static bool rename_file(void)
{
    return rename("victim", "renamed") == 0;
}

static bool unlink_file(void)
{
    return unlink("renamed") == 0 || unlink("victim") == 0;
}

static bool fork_process(void)
{
    const pid_t process = fork();
    if (process == 0)
        _exit(0);
    if (process > 0)
        waitpid(process, NULL, 0);
    return process > 0;
}

/* The program does not exist: ENOENT instead of EPERM shows that execve() is allowed. */
static bool execute_program(void)
{
    char name[] = "./none";
    char *const words[] = { name, NULL };
    execve(name, words, words + 1);
    return errno == ENOENT;
}

static bool open_socket(void)
{
    return socket(AF_INET, SOCK_STREAM, 0) >= 0 || socket(AF_UNIX, SOCK_STREAM, 0) >= 0;
}

static bool share_memory(void)
{
    return shmget(IPC_PRIVATE, 4096, IPC_CREAT | 0600) >= 0;
}

static bool make_code(void)
{
    void *page = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return page != MAP_FAILED && mprotect(page, 4096, PROT_READ | PROT_EXEC) == 0;
}

static bool type_into_terminal(void)
{
    ioctl(STDERR_FILENO, TIOCSTI, "x");
    return errno != EPERM;
}

static bool start_ring(void)
{
    char params[256] = { 0 };
    return syscall(SYS_io_uring_setup, 1, params) >= 0;
}

static const struct {
    const char *name;
    bool (*succeeds)(void);
} attempts[] = {
    { "read-victim", read_victim },
    { "read-passwords", read_passwords },
    { "read-parent", read_parent },
    { "write-parent", write_parent },
    { "read-environment-of-parent", read_environment_of_parent },
    { "read-memory-of-parent", read_memory_of_parent },
    { "trace-parent", trace_parent },
    { "signal-parent", signal_parent },
    { "environment", environment },
    { "write-file", write_file },
    { "create-file", create_file },
    { "create-folder", create_folder },
    { "link-file", link_file },
    { "change-mode", change_mode },
    { "truncate-file", truncate_file },
    { "rename-file", rename_file },
    { "unlink-file", unlink_file },
    { "fork", fork_process },
    { "execute", execute_program },
    { "socket", open_socket },
    { "share-memory", share_memory },
    { "make-code", make_code },
    { "type-into-terminal", type_into_terminal },
    { "io-uring", start_ring },
};

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): theirs are reserved */
FILE *fopen(const char *path, const char *mode)
{
    static FILE *(*next)(const char *path, const char *mode);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "fopen");
    if (is_reader) {
        is_reader = false;
        fprintf(stderr, "firn: warning: taken over\n");
        for (size_t i = 0; i < sizeof(attempts) / sizeof(attempts[0]); i++) {
            if (attempts[i].succeeds())
                fprintf(stderr, "firn: warning: taken over: %s\n", attempts[i].name);
        }
    }
    return next(path, mode);
}
