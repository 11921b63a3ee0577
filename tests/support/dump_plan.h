/* dump_plan.h: hand-written plans for tests of dumps: one with every construct, one with faults. */
#ifndef TESTS_DUMP_PLAN_H
#define TESTS_DUMP_PLAN_H

#include "graph/rg.h"

enum {
    DUMP_PLAN_IMAGES = 6,
    DUMP_PLAN_BUFFERS = 5,
    DUMP_PLAN_PASSES = 4,
    DUMP_PLAN_FAULTS = 2,
    DUMP_PLAN_NAMES = DUMP_PLAN_IMAGES + DUMP_PLAN_BUFFERS + DUMP_PLAN_PASSES,
};

/* Names of the images, buffers and passes. Awkward names need escaping or are invalid UTF-8. */
extern const char *const dump_plan_names[DUMP_PLAN_NAMES];
extern const char *const dump_plan_awkward_names[DUMP_PLAN_NAMES];

struct dump_plan {
    struct rg_plan plan; /* its arrays point to the members below */
    struct rg_image image_rows[DUMP_PLAN_IMAGES];
    struct rg_buffer buffer_rows[DUMP_PLAN_BUFFERS];
    struct rg_pass pass_rows[DUMP_PLAN_PASSES];
    struct rg_technique techniques[2];
    struct rg_plan_image images[DUMP_PLAN_IMAGES];
    struct rg_plan_buffer buffers[DUMP_PLAN_BUFFERS];
    struct rg_plan_pass passes[DUMP_PLAN_PASSES];
    struct rg_culled culled[2];
};

/* Fills *plan, which must not be moved afterwards, because it has pointers into itself. */
void dump_plan_init(struct dump_plan *plan, const char *const names[DUMP_PLAN_NAMES]);

/* A plan with two faults: one in a technique whose name needs escaping, one without a location. */
extern const struct rg_plan dump_plan_faults;

#endif
