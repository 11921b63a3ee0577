/* reader_child_win.c: reader processes on Windows: restricted token, job object and pipes. The
 * token has no privileges and low integrity, so the child cannot write files of the user or open
 * other processes. The job object limits memory and CPU time, allows no further process, no
 * clipboard and no desktop settings, and ends the child with its parent. */
#include <errno.h>
#include <io.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>
#include "src/base/clock.h"
#include "src/file/reader_child.h"

enum {
    BUFFER_SIZE = 1 << 20, /* pipe capacity, bytes */
    COMMAND_SIZE = 32768,  /* maximum length of a command line */
    POLL_MS = 2,           /* anonymous pipes cannot be waited for */
};

struct reader_child {
    HANDLE process, job;
    HANDLE pipes[READER_CHILD_PIPE_COUNT]; /* read ends, or NULL */
};

static void close_handle(HANDLE *handle)
{
    if (*handle)
        (void)CloseHandle(*handle);
    *handle = NULL;
}

/* Appends an argument, quoted as the C run-time library parses it. Returns false if it does not fit
 * into the command line. */
static bool append_argument(char command[static COMMAND_SIZE], const char *argument)
{
    char *end = command + strlen(command);
    size_t slashes = 0;
    if (strlen(command) + 2 * strlen(argument) + 4 > COMMAND_SIZE)
        return false;
    if (end > command)
        *end++ = ' ';
    *end++ = '"';
    for (const char *c = argument; *c; c++) {
        slashes = *c == '\\' ? slashes + 1 : 0;
        if (*c == '"') {
            size_t back = 0;
            while (end - 1 - back >= command && end[-1 - (ptrdiff_t)back] == '\\')
                back++;
            memset(end, '\\', back + 1);
            end += back + 1;
        }
        *end++ = *c;
    }
    memset(end, '\\', slashes); /* before the closing quote */
    end += slashes;
    memcpy(end, "\"", 2);
    return true;
}

/* Returns a copy of this process's token without privileges and with low integrity, or NULL. */
static HANDLE make_token(void)
{
    SID low = {
        SID_REVISION, 1, { SECURITY_MANDATORY_LABEL_AUTHORITY }, { SECURITY_MANDATORY_LOW_RID }
    };
    TOKEN_MANDATORY_LABEL label = { { &low, SE_GROUP_INTEGRITY } };
    HANDLE own = NULL, restricted = NULL;
    const DWORD access =
        TOKEN_DUPLICATE | TOKEN_ASSIGN_PRIMARY | TOKEN_QUERY | TOKEN_ADJUST_DEFAULT;
    if (!OpenProcessToken(GetCurrentProcess(), access, &own))
        return NULL;
    if (CreateRestrictedToken(own, DISABLE_MAX_PRIVILEGE, 0, NULL, 0, NULL, 0, NULL, &restricted) &&
        !SetTokenInformation(restricted, TokenIntegrityLevel, &label, sizeof(label)))
        close_handle(&restricted);
    close_handle(&own);
    return restricted;
}

/* Returns a job object with the limits of a reader, or NULL. */
static HANDLE make_job(const struct reader_params *params)
{
    const HANDLE job = CreateJobObjectA(NULL, NULL);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = { 0 };
    JOBOBJECT_BASIC_UI_RESTRICTIONS surface = {
        JOB_OBJECT_UILIMIT_DESKTOP | JOB_OBJECT_UILIMIT_DISPLAYSETTINGS |
        JOB_OBJECT_UILIMIT_EXITWINDOWS | JOB_OBJECT_UILIMIT_GLOBALATOMS |
        JOB_OBJECT_UILIMIT_HANDLES | JOB_OBJECT_UILIMIT_READCLIPBOARD |
        JOB_OBJECT_UILIMIT_SYSTEMPARAMETERS | JOB_OBJECT_UILIMIT_WRITECLIPBOARD
    };
    limits.BasicLimitInformation.LimitFlags =
        JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_ACTIVE_PROCESS |
        JOB_OBJECT_LIMIT_PROCESS_TIME | JOB_OBJECT_LIMIT_PROCESS_MEMORY |
        JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    limits.BasicLimitInformation.ActiveProcessLimit = 1;
    limits.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = params->seconds * 10000000LL;
    limits.ProcessMemoryLimit = (SIZE_T)params->memory_gib << 30;
    if (!job)
        return NULL;
    if (SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof(limits)) &&
        SetInformationJobObject(job, JobObjectBasicUIRestrictions, &surface, sizeof(surface)))
        return job;
    (void)CloseHandle(job);
    return NULL;
}

/* Opens a pipe whose write end the child inherits. */
static bool open_pipe(HANDLE *read_end, HANDLE *write_end)
{
    SECURITY_ATTRIBUTES inherited = { sizeof(inherited), NULL, TRUE };
    return CreatePipe(read_end, write_end, &inherited, BUFFER_SIZE) &&
           SetHandleInformation(*read_end, HANDLE_FLAG_INHERIT, 0);
}

/* Creates the suspended process with nothing but the two write ends, assigns it to the job and
 * resumes it. */
static bool spawn(struct reader_child *child, const char *program, char *command, HANDLE ends[2])
{
    STARTUPINFOEXA startup = { .StartupInfo = { .cb = sizeof(startup) } };
    PROCESS_INFORMATION started = { 0 };
    char empty_environment[2] = "";
    SIZE_T size = 0;
    const DWORD flags = CREATE_SUSPENDED | CREATE_NO_WINDOW | EXTENDED_STARTUPINFO_PRESENT;
    HANDLE token = make_token();
    (void)InitializeProcThreadAttributeList(NULL, 1, 0, &size);
    startup.lpAttributeList = malloc(size);
    bool ok = token && startup.lpAttributeList &&
              InitializeProcThreadAttributeList(startup.lpAttributeList, 1, 0, &size);
    startup.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    startup.StartupInfo.hStdOutput = ends[READER_CHILD_DATA];
    startup.StartupInfo.hStdError = ends[READER_CHILD_MESSAGES];
    if (ok) {
        ok =
            UpdateProcThreadAttribute(startup.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST,
                                      ends, 2 * sizeof(ends[0]), NULL, NULL) &&
            CreateProcessAsUserA(token, program, command, NULL, NULL, TRUE, flags,
                                 empty_environment, NULL, &startup.StartupInfo, &started);
        DeleteProcThreadAttributeList(startup.lpAttributeList);
    }
    free(startup.lpAttributeList);
    close_handle(&token);
    child->process = started.hProcess;
    ok = ok && AssignProcessToJobObject(child->job, started.hProcess) &&
         ResumeThread(started.hThread) != (DWORD)-1;
    if (!ok && started.hProcess)
        (void)TerminateProcess(started.hProcess, EXIT_FAILURE);
    close_handle(&started.hThread);
    return ok;
}

int reader_child_start(struct reader_child **started, const struct reader_params *params,
                       char *const *arguments)
{
    struct reader_child *child = calloc(1, sizeof(*child));
    char *command = calloc(COMMAND_SIZE, 1);
    HANDLE ends[READER_CHILD_PIPE_COUNT] = { NULL };
    bool ok = child && command;
    *started = NULL;
    for (char *const *argument = arguments; ok && *argument; argument++)
        ok = append_argument(command, *argument);
    for (int i = 0; ok && i < READER_CHILD_PIPE_COUNT; i++)
        ok = open_pipe(&child->pipes[i], &ends[i]);
    if (ok)
        child->job = make_job(params);
    ok = ok && child->job && spawn(child, params->program, command, ends);
    const DWORD error = GetLastError();
    for (int i = 0; i < READER_CHILD_PIPE_COUNT; i++)
        close_handle(&ends[i]);
    free(command);
    if (ok) {
        *started = child;
        return 0;
    }
    if (child)
        (void)reader_child_finish(child);
    return error == ERROR_FILE_NOT_FOUND || error == ERROR_PATH_NOT_FOUND ? ENOENT
           : !child || error == ERROR_NOT_ENOUGH_MEMORY                   ? ENOMEM
                                                                          : EACCES;
}

bool reader_child_is_open(const struct reader_child *child, enum reader_child_pipe pipe)
{
    return child->pipes[pipe];
}

void reader_child_close(struct reader_child *child, enum reader_child_pipe pipe)
{
    close_handle(&child->pipes[pipe]);
}

/* Returns true if a pipe has data or has ended. */
static bool is_pipe_ready(HANDLE pipe)
{
    DWORD count = 0;
    return pipe && (!PeekNamedPipe(pipe, NULL, 0, NULL, &count, NULL) || count > 0);
}

bool reader_child_wait(const struct reader_child *child, double seconds,
                       bool is_ready[static READER_CHILD_PIPE_COUNT])
{
    const double end = clock_seconds() + seconds;
    bool is_any = false;
    for (;;) {
        for (int i = 0; i < READER_CHILD_PIPE_COUNT; i++) {
            is_ready[i] = is_pipe_ready(child->pipes[i]);
            is_any = is_any || is_ready[i];
        }
        if (is_any || clock_seconds() >= end)
            return true;
        Sleep(POLL_MS);
    }
}

size_t reader_child_read(struct reader_child *child, enum reader_child_pipe pipe, void *bytes,
                         size_t size)
{
    const DWORD size_max = size < BUFFER_SIZE ? (DWORD)size : BUFFER_SIZE;
    DWORD count = 0;
    if (ReadFile(child->pipes[pipe], bytes, size_max, &count, NULL) && count > 0)
        return count;
    close_handle(&child->pipes[pipe]);
    return 0;
}

static double seconds_of(FILETIME time)
{
    return ((double)time.dwHighDateTime * 0x1p32 + (double)time.dwLowDateTime) * 1e-7;
}

double reader_child_busy_seconds(struct reader_child *child)
{
    FILETIME begin, end, kernel, user;
    return GetProcessTimes(child->process, &begin, &end, &kernel, &user)
               ? seconds_of(kernel) + seconds_of(user)
               : 0.0;
}

struct reader_child_end reader_child_finish(struct reader_child *child)
{
    enum {
        KILLED = 137,
        PATIENCE_MS = 100 /* for a child that is exiting */
    };
    struct reader_child_end result = { 0 };
    DWORD code = 0;
    for (int i = 0; i < READER_CHILD_PIPE_COUNT; i++)
        close_handle(&child->pipes[i]);
    if (child->process) {
        if (WaitForSingleObject(child->process, PATIENCE_MS) != WAIT_OBJECT_0)
            (void)TerminateProcess(child->process, KILLED);
        (void)WaitForSingleObject(child->process, INFINITE);
        (void)GetExitCodeProcess(child->process, &code);
        result.code = (int)code;
        result.is_out_of_time = code == ERROR_NOT_ENOUGH_QUOTA;
    }
    close_handle(&child->process);
    close_handle(&child->job);
    free(child);
    return result;
}

bool reader_child_inherits_limit(bool is_time, uint64_t limit)
{
    (void)is_time;
    (void)limit;
    return false;
}

/* ---- in the child process ---- */

/* The parent has set the limits of the job object. */
bool reader_child_limit(uint32_t seconds, uint32_t memory_gib)
{
    (void)seconds;
    (void)memory_gib;
    return true;
}

bool reader_child_write(const void *bytes, size_t size)
{
    const HANDLE out = GetStdHandle(STD_OUTPUT_HANDLE);
    for (const char *next = bytes; size > 0;) {
        const DWORD part = size < BUFFER_SIZE ? (DWORD)size : BUFFER_SIZE;
        DWORD count = 0;
        if (!WriteFile(out, next, part, &count, NULL) || count == 0)
            return false;
        next += count;
        size -= count;
    }
    return true;
}
