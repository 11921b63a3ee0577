/* timestamp_check.h: push constants of the test load of src/lab/profile/timestamp_check.c. */
#ifndef SHADERS_OUTPUT_TIMESTAMP_CHECK_H
#define SHADERS_OUTPUT_TIMESTAMP_CHECK_H
#include "abi.h"

#define TIMESTAMP_CHECK_GROUP   64 /* workgroup size */
#define TIMESTAMP_CHECK_NUMBERS 0  /* output of timestamp_check.comp, one float per invocation */

struct timestamp_check_push {
    uint32_t rounds; /* loop iterations per invocation */
};

#endif
