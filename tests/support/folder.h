/*
 * folder.h: set-up and tear-down for cmocka_unit_test_setup_teardown(): each test runs in a
 * temporary working directory of its own, empty at first.
 */
#ifndef TESTS_FOLDER_H
#define TESTS_FOLDER_H

int folder_enter(void **state);
int folder_leave(void **state);

#endif
