/*
 * status.h: result of an operation that may fail. The values are the program's exit codes. A
 * function that detects an error logs one line (what, where, how to fix it) and returns the status.
 * Calling functions pass the status on and log nothing.
 */
#ifndef FIRN_BASE_STATUS_H
#define FIRN_BASE_STATUS_H

enum status {
    STATUS_OK = 0,
    STATUS_FAILED = 1,       /* some of several tasks failed; bug */
    STATUS_USAGE = 2,        /* invalid command line */
    STATUS_DATA = 65,        /* damaged or out-of-range input file */
    STATUS_NO_INPUT = 66,    /* missing or unreadable input file */
    STATUS_NO_DEVICE = 69,   /* no usable Vulkan device, or a missing feature of the system */
    STATUS_CANT_CREATE = 73, /* an output file cannot be created */
    STATUS_WRITE = 74,       /* output file incompletely written */
    STATUS_TRY_AGAIN = 75,   /* retry: device lost, out of memory */
};

/* Makes the compiler warn if a caller ignores the result. */
#define MUST_USE __attribute__((warn_unused_result))

#endif
