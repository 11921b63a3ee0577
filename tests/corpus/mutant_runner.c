/*
 * mutant_runner.c: the program firn for mutants.py: runs many commands, each in a forked process.
 *
 * Each line of stdin has a file for the messages and the arguments of a command, separated by tabs.
 * The answer is a line with its exit code, or with the negative number of a signal. Reader
 * processes are forked, too (the linker's --wrap): starting sanitized programs takes most of the
 * time of small files.
 */
#define _GNU_SOURCE /* clearenv, closefrom, putenv, strsep */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    LINE_SIZE = 4096,
    ARGUMENTS_MAX = 32,
    CPU_SECONDS = 60,
};

static int pipes[2]; /* the reader's stdout and stderr */

/* NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): names of the linker */

int __real_main(int argc, char *const *argv);
int __wrap_main(void);
int __real_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *files, int from, int to);
int __wrap_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *files, int from, int to);
int __wrap_posix_spawn(pid_t *process, const char *path, const posix_spawn_file_actions_t *files,
                       const posix_spawnattr_t *attributes, char *const *arguments,
                       char *const *variables);

int __wrap_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *files, int from, int to)
{
    pipes[to - STDOUT_FILENO] = from;
    return __real_posix_spawn_file_actions_adddup2(files, from, to);
}

/* Runs the program in a process with the pipes, signals and process group of the real call. */
_Noreturn static void run_reader(char *const *arguments, char *const *variables)
{
    int count = 0;
    setpgid(0, 0);
    signal(SIGPIPE, SIG_DFL);
    signal(SIGXFSZ, SIG_DFL);
    signal(SIGXCPU, SIG_DFL);
    const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (input < 0 || dup2(input, STDIN_FILENO) < 0 || dup2(pipes[0], STDOUT_FILENO) < 0 ||
        dup2(pipes[1], STDERR_FILENO) < 0)
        _exit(EXIT_FAILURE);
    closefrom(3);
    clearenv();
    while (*variables)
        putenv(*variables++);
    while (arguments[count])
        count++;
    _exit(__real_main(count, arguments));
}

int __wrap_posix_spawn(pid_t *process, const char *path, const posix_spawn_file_actions_t *files,
                       const posix_spawnattr_t *attributes, char *const *arguments,
                       char *const *variables)
{
    (void)path, (void)files, (void)attributes;
    *process = fork();
    if (*process == 0)
        run_reader(arguments, variables);
    if (*process > 0)
        setpgid(*process, *process);
    return *process < 0 ? errno : 0;
}

/* NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming) */

_Noreturn static void run_command(char *line)
{
    const struct rlimit time = { CPU_SECONDS, CPU_SECONDS + 5 }, core = { 0, 0 };
    char name[] = "firn", *arguments[ARGUMENTS_MAX + 1] = { name }, *next = line;
    const char *messages = strsep(&next, "\t\n");
    int count = 1;
    while (next && *next && count < ARGUMENTS_MAX)
        arguments[count++] = strsep(&next, "\t\n");
    if (setrlimit(RLIMIT_CPU, &time) != 0 || setrlimit(RLIMIT_CORE, &core) != 0 ||
        !freopen("/dev/null", "r", stdin) || !freopen("/dev/null", "w", stdout) ||
        !freopen(messages, "w", stderr))
        _exit(EXIT_FAILURE);
    exit(__real_main(count, arguments));
}

int __wrap_main(void)
{
    char line[LINE_SIZE];
    while (fgets(line, sizeof(line), stdin)) {
        int status = 0;
        const pid_t child = fork();
        if (child < 0)
            return EXIT_FAILURE;
        if (child == 0)
            run_command(line);
        while (waitpid(child, &status, 0) < 0 && errno == EINTR)
            continue;
        printf("%d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
        fflush(stdout);
    }
    return EXIT_SUCCESS;
}
