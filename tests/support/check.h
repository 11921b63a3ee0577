/*
 * check.h: assertions that unit tests share, besides those of cmocka.
 */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

/* cmocka wants these four first */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Fails unless |a - b| <= tolerance; NaN fails. */
#define CHECK_NEAR(a, b, tolerance) assert_true(fabs((double)(a) - (double)(b)) <= (tolerance))

#endif
