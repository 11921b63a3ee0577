/* clock_test.h: what src/profile/clock_test.c and its shaders agree on. */
#ifndef SHADERS_CLOCK_TEST_H
#define SHADERS_CLOCK_TEST_H
#include "abi.h"

#define CLOCK_TEST_GROUP   64 /* invocations of a workgroup */
#define CLOCK_TEST_NUMBERS 0  /* what clock_test.comp writes, one float an invocation */

struct clock_test_push {
    uint32_t rounds; /* of arithmetic in each invocation */
};

#endif
