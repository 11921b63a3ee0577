/* process_posix.c: starts other programs by posix_spawn() and execv(). */
#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "src/base/process.h"

int process_id(void)
{
    return (int)getpid();
}

static int spawn_shell(char *script, pid_t *process)
{
    char shell[] = "sh", option[] = "-c";
    char *const arguments[] = { shell, option, script, NULL };
    posix_spawnattr_t attributes;
    sigset_t signals;
    extern char **environ;
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE); /* main() ignores it */
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawn(process, "/bin/sh", NULL, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    return error;
}

int process_run_shell(const char *script, int *code)
{
    pid_t process;
    int result = 0;
    char *text = strdup(script);
    const int error = text ? spawn_shell(text, &process) : ENOMEM;
    free(text);
    if (error)
        return error;
    while (waitpid(process, &result, 0) < 0 && errno == EINTR)
        ;
    *code = WIFEXITED(result) ? WEXITSTATUS(result) : -1;
    return 0;
}

int process_replace(const char *program, char *const *arguments)
{
    execv(program, arguments);
    return errno;
}
