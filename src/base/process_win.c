/* process_win.c: starts other programs on Windows, which has no /bin/sh. */
#include <errno.h>
#include <process.h>
#include <stdint.h>
#include <stdlib.h>
#include <windows.h>
#include "src/base/process.h"

int process_id(void)
{
    return (int)GetCurrentProcessId();
}

int process_run_shell(const char *script, int *code)
{
    (void)script;
    *code = -1;
    return ENOSYS;
}

/* A new process would not keep the number and the console, so this one waits for it. */
int process_replace(const char *program, char *const *arguments)
{
    const intptr_t code = _spawnv(_P_WAIT, program, (const char *const *)arguments);
    if (code < 0)
        return errno;
    exit((int)code);
}
