/*
 * lavapipe.h: the Vulkan device for tests: lavapipe, Mesa's CPU driver, with validation.
 *
 * $FIRN_TEST_DEVICE selects another device. Without a driver or validation layer the tests fail;
 * none is skipped.
 */
#ifndef TESTS_LAVAPIPE_H
#define TESTS_LAVAPIPE_H

#include "tests/support/assertions.h"

#include "src/gpu/gpu.h"

/* Returns the parameters of gpu_create() for the test device. */
struct gpu_params lavapipe_params(void);

/* Disables the user's pipeline cache, and enables synchronization validation across submissions. */
void lavapipe_environment(void);

/* cmocka setup and teardown; *state is a struct gpu. Teardown fails if the validation layer
 * reported anything, including objects that were not destroyed. */
int lavapipe_open(void **state);
/* Without synchronization validation across submissions: layer 1.3.239 tracks timeline semaphores
 * as binary ones, and ignores a signal while an earlier one has not been waited for. It then
 * reports reads that are ordered after writes by a wait for the ignored signal's value. */
int lavapipe_open_for_timelines(void **state);
int lavapipe_close(void **state);

/* Declares a test that gets its own device. */
#define ON_DEVICE(test) cmocka_unit_test_setup_teardown(test, lavapipe_open, lavapipe_close)

/*
 * Runs up to 16 tests without setup on one device, because opening a device takes longer than
 * drawing small images. A test fails if the validation layer reported anything during it; leaked
 * objects are found at the end. Returns the number of failures.
 */
int lavapipe_run(const struct CMUnitTest *tests, size_t count);
#define RUN_ON_DEVICE(tests) lavapipe_run(tests, sizeof(tests) / sizeof((tests)[0]))

#endif
