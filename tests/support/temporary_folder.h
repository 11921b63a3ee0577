/*
 * temporary_folder.h: set-up and tear-down for cmocka_unit_test_setup_teardown(): each test runs in
 * a temporary working directory of its own, empty at first.
 */
#ifndef TESTS_SUPPORT_TEMPORARY_FOLDER_H
#define TESTS_SUPPORT_TEMPORARY_FOLDER_H

int temporary_folder_enter(void **state);
int temporary_folder_leave(void **state);

#endif
