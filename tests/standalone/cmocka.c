/* cmocka.c: runs tests one after another, each with its setup and teardown. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

jmp_buf cmocka_end;
bool cmocka_is_skipped;

static volatile bool has_failed; /* the running test */

_Noreturn void _fail(const char *file, int line)
{
    print_error("%s:%d: failure\n", file, line);
    has_failed = true;
    longjmp(cmocka_end, 1);
}

/* Returns false if the test fails. */
static bool run_test(const struct CMUnitTest *test)
{
    void *state = test->state;
    has_failed = cmocka_is_skipped = false;
    if (test->setup && test->setup(&state) != 0)
        return false;
    if (setjmp(cmocka_end) == 0)
        test->test(&state);
    if (setjmp(cmocka_end) == 0 && test->teardown && test->teardown(&state) != 0)
        has_failed = true;
    return !has_failed;
}

int cmocka_run(const struct CMUnitTest *tests, size_t count)
{
    int failures = 0;
    for (size_t i = 0; i < count; i++) {
        const bool passed = run_test(&tests[i]);
        (void)printf("%s %s\n",
                     !passed             ? "FAILED"
                     : cmocka_is_skipped ? "skipped"
                                         : "passed",
                     tests[i].name);
        (void)fflush(stdout);
        failures += !passed;
    }
    return failures;
}
