/* sandbox_win.c: sandbox of reader processes on Windows: a job object that the parent has made. */
#include <windows.h>
#include "src/file/sandbox.h"

/* reader_child_win.c starts the process with a restricted token, in a job object without further
 * processes. Nothing restricts which files it reads. */
bool sandbox_enter(const char *path, bool with_folder)
{
    BOOL is_in_job = FALSE;
    (void)path;
    (void)with_folder;
    return IsProcessInJob(GetCurrentProcess(), NULL, &is_in_job) && is_in_job;
}

struct sandbox_support sandbox_query(void)
{
    return (struct sandbox_support){ 0 };
}
