/*
 * allocations.h: counts how often a program asks the heap for memory.
 *
 * It is linked with --wrap for each function of allocations.c; meson's synthetic_dep does so. What
 * shared libraries ask for does not count.
 */
#ifndef TESTS_ALLOCATIONS_H
#define TESTS_ALLOCATIONS_H

#include <stdint.h>

/* Calls since the program began. */
uint64_t allocations_count(void);

#endif
