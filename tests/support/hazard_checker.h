/*
 * hazard_checker.h: an independent checker of synchronization hazards in compiled plans (test
 * oracle).
 *
 * It simulates several frames of a plan on a queue, without waits between them, by the rules of
 * Vulkan 1.3 ("Synchronization and Cache Control", "Memory Aliasing"): which accesses race (RAW,
 * WAR, WAW), which layout and content every subresource has, which memory is aliased. It repeats
 * this for many combinations of conditions. The expected content, the number of batches and the
 * peak memory are derived from the tables; nothing here uses the compiler's results or code.
 */
#ifndef TESTS_SUPPORT_HAZARD_CHECKER_H
#define TESTS_SUPPORT_HAZARD_CHECKER_H

#include <stdint.h>
#include <stdio.h>

#include "graph/rg.h"

/*
 * Checks a plan against the parameters that it was compiled with. Returns the number of errors
 * found. Writes a line about each of the first errors to `report`, which may be NULL.
 */
uint32_t hazard_check(const struct rg_plan *plan, const struct rg_compile_params *params,
                      FILE *report);

#endif
