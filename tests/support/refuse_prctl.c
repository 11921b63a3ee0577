/* refuse_prctl.c: LD_PRELOAD library that stands in for a container without prctl(). */
#include <errno.h>
#include <sys/prctl.h>

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): libc's names are reserved */
int prctl(int option, ...)
{
    (void)option;
    errno = EPERM;
    return -1;
}
