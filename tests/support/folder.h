/*
 * folder.h: set-up and tear-down of tests that run inside a folder of their own, empty at first, as
 * cmocka_unit_test_setup_teardown() takes them.
 */
#ifndef TESTS_FOLDER_H
#define TESTS_FOLDER_H

int folder_enter(void **state);
int folder_leave(void **state);

#endif
