/* timestamp_check.h: shared by src/profile/timestamp_check.c and its shaders. */
#ifndef SHADERS_TIMESTAMP_CHECK_H
#define SHADERS_TIMESTAMP_CHECK_H
#include "abi.h"

#define TIMESTAMP_CHECK_GROUP   64 /* invocations of a workgroup */
#define TIMESTAMP_CHECK_NUMBERS 0  /* output of timestamp_check.comp, one float per invocation */

struct timestamp_check_push {
    uint32_t rounds; /* iterations of arithmetic in each invocation */
};

#endif
