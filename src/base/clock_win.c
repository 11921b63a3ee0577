/* clock_win.c: monotonic time by the performance counter. */
#include <windows.h>
#include "src/base/clock.h"

double clock_seconds(void)
{
    LARGE_INTEGER count, frequency;
    QueryPerformanceCounter(&count); /* cannot fail since Windows XP */
    QueryPerformanceFrequency(&frequency);
    return (double)count.QuadPart / (double)frequency.QuadPart;
}

double clock_cpu_seconds(void)
{
    FILETIME created, ended, kernel, user;
    if (!GetProcessTimes(GetCurrentProcess(), &created, &ended, &kernel, &user))
        return 0.0;
    const double high = (double)kernel.dwHighDateTime + (double)user.dwHighDateTime;
    const double low = (double)kernel.dwLowDateTime + (double)user.dwLowDateTime;
    return (high * 4294967296.0 + low) * 1e-7; /* of 100 ns */
}
