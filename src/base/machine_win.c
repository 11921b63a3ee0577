/* machine_win.c: queries the machine by the Windows API. */
#include <stdio.h>
#include <windows.h>
#include "src/base/machine.h"

uint64_t machine_memory(void)
{
    MEMORYSTATUSEX memory = { .dwLength = sizeof(memory) };
    return GlobalMemoryStatusEx(&memory) ? memory.ullTotalPhys : 0;
}

/* Returns the limit of the job object to which the process belongs. */
uint64_t machine_memory_limit(void)
{
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = { 0 };
    const BOOL is_in_job = QueryInformationJobObject(NULL, JobObjectExtendedLimitInformation,
                                                     &limits, sizeof(limits), NULL);
    const BOOL is_limited =
        is_in_job && limits.BasicLimitInformation.LimitFlags & JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    return is_limited ? limits.ProcessMemoryLimit : 0;
}

uint32_t machine_core_count(void)
{
    SYSTEM_INFO system;
    GetSystemInfo(&system);
    return system.dwNumberOfProcessors ? system.dwNumberOfProcessors : 1;
}

void machine_advise_pages(void *begin, size_t size, bool is_huge)
{
    (void)begin;
    (void)size;
    (void)is_huge;
}

void machine_advise_allocation(void *bytes, size_t size)
{
    (void)bytes;
    (void)size;
}

/* Converts 100 ns units to milliseconds. */
static double ms_of(FILETIME time)
{
    return (double)time.dwHighDateTime * 429496.7296 + (double)time.dwLowDateTime * 1e-4;
}

double machine_cpu_ms(bool of_children)
{
    FILETIME start, end, kernel, user;
    if (of_children || !GetProcessTimes(GetCurrentProcess(), &start, &end, &kernel, &user))
        return 0.0;
    return ms_of(kernel) + ms_of(user);
}

void machine_processor(char *text, size_t size)
{
    DWORD length = (DWORD)size;
    if (RegGetValueA(HKEY_LOCAL_MACHINE, "HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0",
                     "ProcessorNameString", RRF_RT_REG_SZ, NULL, text, &length) != ERROR_SUCCESS)
        snprintf(text, size, "a processor");
}
