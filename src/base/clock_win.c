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
