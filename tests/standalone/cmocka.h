/*
 * cmocka.h: the part of cmocka that tests of graph/ use, for systems without cmocka. Failed
 * assertions end their test by longjmp().
 */
#ifndef TESTS_STANDALONE_CMOCKA_H
#define TESTS_STANDALONE_CMOCKA_H

#include <setjmp.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct CMUnitTest {
    const char *name;
    void (*test)(void **state);
    int (*setup)(void **state);
    int (*teardown)(void **state);
    void *state;
};

#define cmocka_unit_test(function) \
    { \
        .name = #function, .test = (function) \
    }
#define cmocka_unit_test_prestate(function, prestate) \
    { \
        .name = #function, .test = (function), .state = (prestate) \
    }
#define cmocka_unit_test_setup_teardown(function, before, after) \
    { \
        .name = #function, .test = (function), .setup = (before), .teardown = (after) \
    }
#define cmocka_run_group_tests(tests, setup, teardown) \
    cmocka_run((tests), sizeof(tests) / sizeof((tests)[0]))

/* State of the running test, of the program's only file with main(). */
extern jmp_buf cmocka_end;
extern bool cmocka_is_skipped;

int cmocka_run(const struct CMUnitTest *tests, size_t count);
_Noreturn void _fail(const char *file, int line);

#define print_error(...)   ((void)fprintf(stderr, __VA_ARGS__))
#define print_message(...) ((void)fprintf(stdout, __VA_ARGS__))
#define fail_msg(...)      (print_error(__VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))
#define fail()             _fail(__FILE__, __LINE__)
#define skip()             (cmocka_is_skipped = true, longjmp(cmocka_end, 1))

#define assert_true(condition) \
    ((condition) ? (void)0 : (print_error("%s\n", #condition), _fail(__FILE__, __LINE__)))
#define assert_false(condition)    assert_true(!(condition))
#define assert_non_null(pointer)   assert_true((pointer) != NULL)
#define assert_null(pointer)       assert_true((pointer) == NULL)
#define assert_ptr_equal(a, b)     assert_true((const void *)(a) == (const void *)(b))
#define assert_ptr_not_equal(a, b) assert_true((const void *)(a) != (const void *)(b))
#define assert_int_equal(a, b) \
    cmocka_compare((uintmax_t)(a), (uintmax_t)(b), true, __FILE__, __LINE__)
#define assert_int_not_equal(a, b) \
    cmocka_compare((uintmax_t)(a), (uintmax_t)(b), false, __FILE__, __LINE__)
#define assert_float_equal(a, b, epsilon) \
    assert_true((a) - (b) <= (epsilon) && (b) - (a) <= (epsilon))
#define assert_memory_equal(a, b, size) assert_true(memcmp((a), (b), (size)) == 0)
#define assert_string_equal(a, b) \
    (strcmp((a), (b)) ? (print_error("\"%s\" != \"%s\"\n", (a), (b)), _fail(__FILE__, __LINE__)) \
                      : (void)0)

static inline void cmocka_compare(uintmax_t a, uintmax_t b, bool equal, const char *file, int line)
{
    if ((a == b) == equal)
        return;
    print_error("%#llx %s %#llx\n", (unsigned long long)a,
                equal ? "!=" : "==", (unsigned long long)b);
    _fail(file, line);
}

#endif
