/* refuse_prctl.c: LD_PRELOAD library that makes prctl() fail, as some containers do. */
#include <errno.h>
#include <sys/prctl.h>

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): libc's names are reserved */
int prctl(int option, ...)
{
    (void)option;
    errno = EPERM;
    return -1;
}
