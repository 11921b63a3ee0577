/* timestamp_check.h: what src/profile/timestamp_check.c and its shaders agree on. */
#ifndef SHADERS_TIMESTAMP_CHECK_H
#define SHADERS_TIMESTAMP_CHECK_H
#include "abi.h"

#define TIMESTAMP_CHECK_GROUP   64 /* invocations of a workgroup */
#define TIMESTAMP_CHECK_NUMBERS 0  /* what timestamp_check.comp writes, one float an invocation */

struct timestamp_check_push {
    uint32_t rounds; /* of arithmetic in each invocation */
};

#endif
