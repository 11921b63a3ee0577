/* machine_posix.c: queries the machine by POSIX and, on Linux, by /proc. */
#define _DEFAULT_SOURCE /* madvise() */
#include <stdio.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#include "src/base/machine.h"

uint64_t machine_memory(void)
{
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? (uint64_t)pages * (uint64_t)size : 0;
}

uint64_t machine_memory_limit(void)
{
    struct rlimit limit;
    const bool is_limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return is_limited ? limit.rlim_cur : 0;
}

uint32_t machine_core_count(void)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 0 ? (uint32_t)cores : 1;
}

void machine_advise_pages(void *begin, size_t size, bool is_huge)
{
    (void)madvise(begin, size, is_huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
}

void machine_advise_allocation(void *bytes, size_t size)
{
    const uintptr_t page = 2u << 20, first = ((uintptr_t)bytes + page - 1) / page * page;
    const uintptr_t end = ((uintptr_t)bytes + size) / page * page;
    if (bytes && first < end)
        machine_advise_pages((char *)bytes + (first - (uintptr_t)bytes), end - first, true);
}

static double ms_of(struct timeval time)
{
    return (double)time.tv_sec * 1e3 + (double)time.tv_usec * 1e-3;
}

double machine_cpu_ms(bool of_children)
{
    struct rusage usage = { 0 };
    (void)getrusage(of_children ? RUSAGE_CHILDREN : RUSAGE_SELF, &usage); /* cannot fail */
    return ms_of(usage.ru_utime) + ms_of(usage.ru_stime);
}

void machine_processor(char *text, size_t size)
{
    char line[256], name[192] = "a processor";
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof(line), file)) {
        if (sscanf(line, "model name : %191[^\n]", name) == 1)
            break;
    }
    if (file)
        fclose(file);
    snprintf(text, size, "%s", name);
}
