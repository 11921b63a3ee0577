/* test_file_io.c: atomic output files: complete or absent after each failure. */
#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/file/atomic_file.h"
#include "tests/support/assertions.h"
#include "tests/support/temporary_folder.h"

static int count_files(void)
{
    DIR *folder = opendir(".");
    int count = -2; /* "." and ".." */
    assert_non_null(folder);
    while (readdir(folder))
        count++;
    closedir(folder);
    return count;
}

static void save(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void check_content(const char *path, const char *expected)
{
    char text[64] = "";
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t count = fread(text, 1, sizeof(text) - 1, file);
    fclose(file);
    assert_int_equal(count, strlen(expected));
    assert_string_equal(text, expected);
}

static void test_file_new_and_again(void **state)
{
    (void)state;
    assert_int_equal(file_io_check("a"), STATUS_OK);
    assert_int_equal(count_files(), 0);
    assert_int_equal(file_io_write("a", "first", 5), STATUS_OK);
    check_content("a", "first");
    assert_int_equal(file_io_check("a"), STATUS_OK);
    assert_int_equal(file_io_write("a", "2nd", 3), STATUS_OK);
    check_content("a", "2nd");
    assert_int_equal(file_io_write("./a", "", 0), STATUS_OK);
    check_content("a", "");
    assert_int_equal(count_files(), 1);
}

static void test_file_mode(void **state)
{
    struct stat info;
    const mode_t mask = umask(027);

    (void)state;
    assert_int_equal(file_io_write("a", "x", 1), STATUS_OK);
    umask(mask);
    assert_int_equal(stat("a", &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
    for (mode_t mode = 0400; mode <= 0666; mode += 0266) { /* whoever may write the folder */
        assert_int_equal(chmod("a", mode), 0);
        assert_int_equal(file_io_write("a", "y", 1), STATUS_OK);
        check_content("a", "y");
        assert_int_equal(stat("a", &info), 0);
        assert_int_equal(info.st_mode & 0777, mode);
    }
}

static void test_file_absolute_path(void **state)
{
    char path[PATH_MAX];
    snprintf(path, sizeof(path), "%s/a", (const char *)*state);
    assert_int_equal(file_io_write(path, "abc", 3), STATUS_OK);
    check_content("a", "abc");
    if (access("/", W_OK) == 0)
        assert_int_equal(file_io_check("/firn-test-no-such-file"), STATUS_OK);
}

/* The older file survives a write that fails half way, and nothing else is left. */
static void test_file_failed_write(void **state)
{
    static const char big[100000];
    struct rlimit old, low;

    (void)state;
    assert_int_equal(file_io_write("a", "old", 3), STATUS_OK);
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    low = old;
    low.rlim_cur = 65536;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &low), 0);
    const enum status again = file_io_write("a", big, sizeof(big));
    const enum status fresh = file_io_write("b", big, sizeof(big));
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
    signal(SIGXFSZ, handler);
    assert_int_equal(again, STATUS_WRITE);
    assert_int_equal(fresh, STATUS_WRITE);
    check_content("a", "old");
    assert_int_equal(count_files(), 1);
}

static void check_cannot_create(const char *path)
{
    assert_int_equal(file_io_check(path), STATUS_CANT_CREATE);
    assert_int_equal(file_io_write(path, "x", 1), STATUS_CANT_CREATE);
}

static void test_file_bad_targets(void **state)
{
    char name[NAME_MAX + 2] = "";

    (void)state;
    save("plain", "x", 1);
    assert_int_equal(mkdir("folder", 0777), 0);
    assert_int_equal(symlink("folder", "to-folder"), 0);
    assert_int_equal(symlink("nothing", "to-nothing"), 0);
    memset(name, 'n', NAME_MAX + 1);
    check_cannot_create("");
    check_cannot_create(".");
    check_cannot_create("/");
    check_cannot_create("folder");
    check_cannot_create("folder/");
    check_cannot_create("new/");
    check_cannot_create("to-folder");
    check_cannot_create("to-nothing");
    check_cannot_create("missing/a");
    check_cannot_create("plain/a");
    check_cannot_create(name);
    check_content("plain", "x");
    assert_int_equal(count_files(), 4);
}

static void test_file_folder_without_permission(void **state)
{
    const uid_t user = geteuid();

    (void)state;
    assert_int_equal(mkdir("locked", 0555), 0);
    if (user == 0) /* whom nothing stops */
        assert_int_equal(seteuid(65534), 0);
    const enum status check = file_io_check("locked/a");
    const enum status write = file_io_write("locked/a", "x", 1);
    assert_int_equal(seteuid(user), 0);
    assert_int_equal(check, STATUS_CANT_CREATE);
    assert_int_equal(write, STATUS_CANT_CREATE);
}

static void test_file_symbolic_link(void **state)
{
    struct stat info;

    (void)state;
    assert_int_equal(mkdir("folder", 0777), 0);
    save("folder/target", "old", 3);
    assert_int_equal(symlink("folder/target", "one"), 0);
    assert_int_equal(symlink("one", "two"), 0);
    assert_int_equal(file_io_check("two"), STATUS_OK);
    assert_int_equal(file_io_write("two", "new", 3), STATUS_OK);
    check_content("folder/target", "new");
    assert_int_equal(lstat("one", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(lstat("two", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(unlink("folder/target"), 0);
    assert_int_equal(count_files(), 3);
}

static void test_file_long_names(void **state)
{
    static const size_t lengths[] = { 200, 240, NAME_MAX - 1, NAME_MAX };
    (void)state;
    for (size_t i = 0; i < 4; i++) {
        char name[NAME_MAX + 1] = "";
        memset(name, 'n', lengths[i]);
        assert_int_equal(file_io_check(name), STATUS_OK);
        assert_int_equal(file_io_write(name, "abc", 3), STATUS_OK);
        check_content(name, "abc");
    }
    assert_int_equal(count_files(), 4);
}

/* A temporary without a lock was left by a killed process, and goes. */
static void test_file_left_temporary(void **state)
{
    static const char *const others[] = { ".b.k3Xz0q.tmp",  ".a.k3Xz0.tmp", ".a.k3Xz0qq.tmp",
                                          ".a.k3Xz-q.tmp",  ".a.k3Xz0q.tm", "a.k3Xz0q.tmp",
                                          ".a.k3Xz0q.tmp~", ".ak3Xz0q.tmp" };
    (void)state;
    save("victim", "safe", 4);
    assert_int_equal(symlink("victim", ".a.SYMLNK.tmp"), 0);
    assert_int_equal(mkfifo(".a.0FIFO0.tmp", 0666), 0);
    save(".a.living.tmp", "x", 1);
    const int living = open(".a.living.tmp", O_RDWR);
    assert_int_equal(flock(living, LOCK_EX), 0);
    for (int i = 0; i < 8; i++)
        save(others[i], "x", 1);
    save(".a.k3Xz0q.tmp", "left", 4);
    save(".a.999999.tmp", "", 0);
    assert_int_equal(file_io_write("a", "abc", 3), STATUS_OK);
    check_content("a", "abc");
    check_content("victim", "safe");
    assert_int_equal(access(".a.k3Xz0q.tmp", F_OK), -1);
    assert_int_equal(access(".a.999999.tmp", F_OK), -1);
    assert_int_equal(count_files(), 8 + 5);
    close(living);
    assert_int_equal(file_io_write("a", "def", 3), STATUS_OK);
    assert_int_equal(count_files(), 8 + 4);
}

static void test_file_pipe(void **state)
{
    char text[8] = "";
    struct stat info;

    (void)state;
    assert_int_equal(mkfifo("pipe", 0666), 0);
    const int reader = open("pipe", O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    assert_int_equal(file_io_check("pipe"), STATUS_OK);
    assert_int_equal(file_io_write("pipe", "abc", 3), STATUS_OK);
    assert_int_equal(read(reader, text, sizeof(text)), 3);
    assert_string_equal(text, "abc");
    close(reader);
    assert_int_equal(stat("pipe", &info), 0);
    assert_true(S_ISFIFO(info.st_mode));
    assert_int_equal(count_files(), 1);
}

/* Writes "-" while stdout is a pipe; text printed before goes out before. */
static void test_file_stdout(void **state)
{
    char text[16] = "";
    int ends[2];

    (void)state;
    fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    assert_int_equal(pipe(ends), 0);
    dup2(ends[1], STDOUT_FILENO);
    printf("first ");
    const enum status check = file_io_check("-");
    const enum status write = file_io_write("-", "then", 4);
    const ssize_t count = read(ends[0], text, sizeof(text) - 1);
    void (*handler)(int) = signal(SIGPIPE, SIG_IGN);
    close(ends[0]);
    const enum status broken = file_io_write("-", "then", 4);
    dup2(saved, STDOUT_FILENO);
    signal(SIGPIPE, handler);
    close(saved);
    close(ends[1]);
    assert_int_equal(check, STATUS_OK);
    assert_int_equal(write, STATUS_OK);
    assert_int_equal(count, 10);
    assert_string_equal(text, "first then");
    assert_int_equal(broken, STATUS_WRITE);
    assert_int_equal(count_files(), 0);
}

#define TEST(name) \
    cmocka_unit_test_setup_teardown(name, temporary_folder_enter, temporary_folder_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_file_new_and_again),  TEST(test_file_mode),
        TEST(test_file_absolute_path),  TEST(test_file_failed_write),
        TEST(test_file_bad_targets),    TEST(test_file_folder_without_permission),
        TEST(test_file_symbolic_link),  TEST(test_file_long_names),
        TEST(test_file_left_temporary), TEST(test_file_pipe),
        TEST(test_file_stdout),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
