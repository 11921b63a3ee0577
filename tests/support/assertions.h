/* assertions.h: assertions of the unit tests besides those of cmocka. */
#ifndef TESTS_SUPPORT_ASSERTIONS_H
#define TESTS_SUPPORT_ASSERTIONS_H

/* cmocka.h requires the headers setjmp.h, stdarg.h, stddef.h and stdint.h before it */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Fails unless |a - b| <= tolerance, and prints the difference; NaN fails. */
#define CHECK_NEAR(a, b, tolerance) \
    check_is_near((double)(a), (double)(b), (tolerance), #a " is near " #b, __FILE__, __LINE__)

static inline void check_is_near(double a, double b, double tolerance, const char *what,
                                 const char *file, int line)
{
    if (fabs(a - b) <= tolerance)
        return;
    print_error("%s: %.9g and %.9g differ by %.3g, allowed are %.3g\n", what, a, b, fabs(a - b),
                tolerance);
    _fail(file, line);
}

#endif
