/*
 * status.h: result of an operation that may fail; the values are the program's exit codes.
 *
 * The function that detects an error logs one line (what, where, how to fix it) and returns the
 * status; its callers pass the status on and log nothing.
 */
#ifndef FIRN_BASE_STATUS_H
#define FIRN_BASE_STATUS_H

enum status {
    STATUS_OK = 0,
    STATUS_FAILED = 1,       /* some of several tasks failed, or a bug in the program */
    STATUS_USAGE = 2,        /* the command line is wrong */
    STATUS_DATA = 65,        /* an input file is damaged or out of range */
    STATUS_NO_INPUT = 66,    /* an input file is missing or unreadable */
    STATUS_NO_DEVICE = 69,   /* no usable Vulkan device */
    STATUS_CANT_CREATE = 73, /* an output file cannot be created */
    STATUS_WRITE = 74,       /* an output file cannot be written completely */
    STATUS_TRY_AGAIN = 75,   /* temporary failure (device lost, out of memory, SIGUSR1): retry */
};

/* Makes the compiler warn if a caller ignores the result. */
#define MUST_USE __attribute__((warn_unused_result))

#endif
