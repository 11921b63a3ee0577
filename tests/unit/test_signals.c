/*
 * test_signals.c: termination signals and the times at which they are delayed. Each is tried in a
 * child process.
 */
#include <dirent.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "src/base/signals.h"
#include "tests/support/assertions.h"

enum {
    UNTOUCHED = 7 /* exit code of a child that no signal ends */
};

typedef void child_fn(struct signals *stop, int number, int out);

/*
 * Runs it after signals_begin(), with the signal's first action: its exit code, and what it has
 * written to `out`.
 */
static int run(child_fn *child, void (*action)(int), int number, char words[static 64])
{
    struct signals stop = { 0 };
    int pipes[2], result;

    assert_int_equal(pipe(pipes), 0);
    const pid_t process = fork();
    assert_true(process >= 0);
    if (process == 0) {
        close(pipes[0]);
        signal(number, action);
        if (signals_begin(&stop) != STATUS_OK)
            _exit(1);
        child(&stop, number, pipes[1]);
        signals_end(&stop);
        _exit(UNTOUCHED);
    }
    close(pipes[1]);
    const ssize_t count = read(pipes[0], words, 63);
    words[count > 0 ? count : 0] = '\0';
    close(pipes[0]);
    assert_int_equal(waitpid(process, &result, 0), process);
    assert_true(WIFEXITED(result));
    return WEXITSTATUS(result);
}

static void say(int out, const char *word)
{
    if (write(out, word, strlen(word)) < 0)
        _exit(1);
}

/* Of a thread, as /proc has it; 'S' if it is no more. */
static int state_of(const char *thread)
{
    char name[64], text[512] = "";
    snprintf(name, sizeof(name), "/proc/self/task/%.20s/stat", thread);
    FILE *file = fopen(name, "r");
    if (!file)
        return 'S';
    const size_t length = fread(text, 1, sizeof(text) - 1, file);
    fclose(file);
    const char *end = length ? strrchr(text, ')') : NULL;
    return end && end[1] == ' ' ? end[2] : 'S';
}

static bool is_other_awake(void)
{
    char own[32];
    bool awake = false;
    snprintf(own, sizeof(own), "%ld", (long)getpid());
    DIR *folder = opendir("/proc/self/task");
    if (!folder)
        _exit(1);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        const bool other = entry->d_name[0] != '.' && strcmp(entry->d_name, own) != 0;
        awake = awake || (other && state_of(entry->d_name) != 'S');
    }
    closedir(folder);
    return awake;
}

/* A signal that is waited for has woken whoever waits before kill() returns: once all other threads
 * sleep again, it has been heeded as far as it will be. */
static void settle(void)
{
    while (is_other_awake())
        sched_yield();
}

static void wait_for_end(struct signals *stop, int number, int out)
{
    (void)stop;
    (void)out;
    kill(getpid(), number);
    for (;;)
        pause();
}

static void write_first(struct signals *stop, int number, int out)
{
    signals_hold(stop);
    kill(getpid(), number);
    settle();
    say(out, "written");
    signals_release(stop);
    for (;;)
        pause();
}

static void say_last(void *user, int code)
{
    const int *out = user;
    dprintf(*out, "last %d", code);
}

static void wait_with_last_words(struct signals *stop, int number, int out)
{
    stop->user = &out; /* lives as long as the child */
    stop->last = say_last;
    kill(getpid(), number);
    for (;;)
        pause();
}

static void end_first(struct signals *stop, int number, int out)
{
    signals_end(stop);
    kill(getpid(), number);
    settle();
    say(out, "ended");
}

static void outlive(struct signals *stop, int number, int out)
{
    (void)stop;
    kill(getpid(), number);
    settle();
    say(out, "alive");
}

static const int numbers[] = { SIGHUP, SIGINT, SIGTERM, SIGUSR1 };
static const int codes[] = { 129, 130, 143, 75 };

enum {
    NUMBER_COUNT = sizeof(numbers) / sizeof(numbers[0])
};

static void test_exit_codes(void **state)
{
    char words[64];
    (void)state;
    for (size_t i = 0; i < NUMBER_COUNT; i++)
        assert_int_equal(run(wait_for_end, SIG_DFL, numbers[i], words), codes[i]);
}

static void test_not_while_held(void **state)
{
    char words[64];
    (void)state;
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        assert_int_equal(run(write_first, SIG_DFL, numbers[i], words), codes[i]);
        assert_string_equal(words, "written");
    }
}

static void test_last_words(void **state)
{
    static const char *const said[] = { "last 129", "last 130", "last 143", "last 75" };
    char words[64];
    (void)state;
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        assert_int_equal(run(wait_with_last_words, SIG_DFL, numbers[i], words), codes[i]);
        assert_string_equal(words, said[i]);
    }
}

static void test_not_after_the_end(void **state)
{
    char words[64];
    (void)state;
    assert_int_equal(run(end_first, SIG_DFL, SIGTERM, words), UNTOUCHED);
    assert_string_equal(words, "ended");
}

static void test_ignored_ones_stay_ignored(void **state)
{
    char words[64];
    (void)state;
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        assert_int_equal(run(outlive, SIG_IGN, numbers[i], words), UNTOUCHED);
        assert_string_equal(words, "alive");
    }
}

static void test_end_without_begin(void **state)
{
    struct signals stop = { 0 };
    (void)state;
    signals_end(&stop);
    assert_false(stop.begun);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exit_codes),        cmocka_unit_test(test_not_while_held),
        cmocka_unit_test(test_not_after_the_end), cmocka_unit_test(test_ignored_ones_stay_ignored),
        cmocka_unit_test(test_end_without_begin), cmocka_unit_test(test_last_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
