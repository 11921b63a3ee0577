/*
 * lavapipe.h: opens lavapipe, Mesa's driver for the CPU, or the device that $FIRN_TEST_DEVICE
 * names, with validation, as a device for tests. Without driver or validation layer the tests fail;
 * none is skipped.
 */
#ifndef TESTS_LAVAPIPE_H
#define TESTS_LAVAPIPE_H

#include "tests/support/check.h"

#include "src/gpu/gpu.h"

/* What gpu_create() opens it by. */
struct gpu_params lavapipe_params(void);

/* No pipeline cache of the user's, and synchronization validation across submissions. */
void lavapipe_environment(void);

/* Setup and teardown for cmocka; *state is a struct gpu. Teardown fails if the validation layer
 * said anything, also about what was not destroyed. */
int lavapipe_open(void **state);
int lavapipe_close(void **state);

/* For a test that needs a device of its own. */
#define ON_DEVICE(test) cmocka_unit_test_setup_teardown(test, lavapipe_open, lavapipe_close)

/*
 * Runs tests without setup, up to 16, on one device, which takes longer to open than small pictures
 * to draw. A test fails if the validation layer said anything during it; what was not destroyed is
 * found at the end. Returns how many failed.
 */
int lavapipe_run(const struct CMUnitTest *tests, size_t count);
#define RUN_ON_DEVICE(tests) lavapipe_run(tests, sizeof(tests) / sizeof((tests)[0]))

#endif
