/*
 * hazard.h: an independent judge of compiled plans.
 *
 * Runs some frames of a plan on a queue of paper, with nothing awaited in between, by the rules of
 * Vulkan 1.3 ("Synchronization and Cache Control", "Memory Aliasing"): which access may race with
 * which, which layout and content every subresource has, what memory is shared. It does so for many
 * ways in which conditions may turn out. What passes should do, how many batches they need and how
 * many bytes are taken at once is derived anew from the tables; nothing here asks the compiler.
 */
#ifndef TESTS_HAZARD_H
#define TESTS_HAZARD_H

#include <stdint.h>
#include <stdio.h>

#include "graph/rg.h"

/*
 * Returns the number of findings, 0 for a plan without fault, and writes a line about each of the
 * first ones to `report`, which may be NULL. `params` are those that the plan was compiled with.
 */
uint32_t hazard_check(const struct rg_plan *plan, const struct rg_compile_params *params,
                      FILE *report);

#endif
