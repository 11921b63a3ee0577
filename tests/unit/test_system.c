/* test_system.c: the interfaces to the operating system in src/base and src/file, natively and
 * under Wine. The current folder must be writable. */
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/ascii.h"
#include "src/base/clock.h"
#include "src/base/disk_cache.h"
#include "src/base/environment.h"
#include "src/base/file_info.h"
#include "src/base/loaded_library.h"
#include "src/base/machine.h"
#include "src/base/parallel.h"
#include "src/base/path.h"
#include "src/base/process.h"
#include "src/base/program.h"
#include "src/base/text_stream.h"
#include "src/base/thread.h"
#include "src/file/atomic_file.h"
#include "src/file/reader_process.h"
#include "tests/support/assertions.h"

static const char file_name[] = "system test.txt";

enum {
    ITEMS = 1000,
    DATA_SIZE = 3000000, /* more than a pipe holds */
};

/* ---- threads ---- */

struct shared {
    struct mutex lock;
    struct condition changed;
    int stage;
};

static void answer(void *user)
{
    struct shared *shared = user;
    mutex_lock(&shared->lock);
    while (shared->stage != 1)
        condition_wait(&shared->changed, &shared->lock);
    shared->stage = 2;
    condition_wake_all(&shared->changed);
    mutex_unlock(&shared->lock);
}

static void test_thread(void **state)
{
    (void)state;
    struct shared shared = { .stage = 0 };
    struct thread thread;
    mutex_init(&shared.lock);
    condition_init(&shared.changed);
    assert_true(thread_start(&thread, answer, &shared));
    mutex_lock(&shared.lock);
    shared.stage = 1;
    condition_wake_all(&shared.changed);
    while (shared.stage != 2)
        condition_wait(&shared.changed, &shared.lock);
    mutex_unlock(&shared.lock);
    thread_join(&thread);
    condition_finish(&shared.changed);
    mutex_finish(&shared.lock);
}

static void count(void *user, uint32_t i)
{
    atomic_uint *counts = user;
    atomic_fetch_add(&counts[i], 1);
}

static void test_parallel(void **state)
{
    (void)state;
    static atomic_uint counts[ITEMS];
    assert_true(machine_core_count() >= 1);
    assert_true(parallel_for(ITEMS, 8, count, counts, NULL, NULL));
    for (int i = 0; i < ITEMS; i++)
        assert_int_equal(atomic_load(&counts[i]), 1);
}

/* ---- texts, clock, machine, environment ---- */

static void test_text(void **state)
{
    (void)state;
    struct text_stream stream;
    size_t length;
    FILE *out = text_stream_open(&stream);
    assert_non_null(out);
    fprintf(out, "%d of ", 7);
    fputs("ten\n", out);
    char *text = text_stream_close(&stream, &length);
    assert_string_equal(text, "7 of ten\n");
    assert_int_equal(length, 9);
    free(text);
    assert_true(ascii_begins_equal("SOLID a", "solid", 5));
    assert_false(ascii_begins_equal("sol", "solid", 5));
    assert_true(path_ends_in("a.b.EXR", ".exr"));
    assert_false(path_ends_in("a.exr2", ".exr"));
}

static void test_machine(void **state)
{
    (void)state;
    char name[64], path[PROGRAM_PATH_SIZE];
    const double begin = clock_seconds();
    assert_true(machine_memory() > 1 << 20);
    machine_processor(name, sizeof(name));
    assert_true(name[0] != '\0');
    assert_true(process_id() != 0);
    assert_true(program_path(path, NULL));
    assert_int_equal(file_info_of(path).kind, FILE_REGULAR);
    assert_true(environment_set_default("FIRN_SYSTEM_TEST", "first"));
    assert_true(environment_set_default("FIRN_SYSTEM_TEST", "second"));
    assert_string_equal(getenv("FIRN_SYSTEM_TEST"), "first");
    assert_null(loaded_library_find("no-such-library", "main"));
    assert_true(clock_seconds() >= begin);
}

/* ---- files ---- */

static void test_files(void **state)
{
    (void)state;
    FILE *file;
    int64_t size;
    char byte;
    (void)remove(file_name);
    assert_int_equal(file_info_of(file_name).kind, FILE_MISSING);
    assert_int_equal(file_io_check(file_name), STATUS_OK);
    assert_int_equal(file_info_of(file_name).kind, FILE_MISSING);
    assert_int_equal(file_io_write(file_name, "old", 3), STATUS_OK);
    assert_int_equal(file_io_write(file_name, "newer", 5), STATUS_OK);
    const struct file_info info = file_info_of(file_name), folder = file_info_of(".");
    assert_int_equal(info.kind, FILE_REGULAR);
    assert_int_equal(info.size, 5);
    assert_int_equal(folder.kind, FILE_FOLDER);
    assert_true(file_is_readable(file_name));
    assert_false(file_is_link(file_name));
    assert_false(file_io_is_direct(file_name));
    assert_false(file_info_is_same(&info, &folder));
    assert_int_equal(file_io_write(".", "x", 1), STATUS_CANT_CREATE);
    assert_int_equal(file_io_open(file_name, &file, &size), STATUS_OK);
    const struct file_info opened = file_info_of_open(file);
    assert_true(file_info_is_same(&info, &opened));
    assert_int_equal(size, 5);
    assert_true(file_seek(file, 3) && fread(&byte, 1, 1, file) == 1 && byte == 'e');
    fclose(file);
    assert_int_equal(file_io_open(".", &file, &size), STATUS_NO_INPUT);
    assert_int_equal(remove(file_name), 0);
}

static bool is_sound(const void *user, const void *data, size_t size)
{
    (void)user;
    return disk_cache_is_intact(data, size);
}

static void test_cache(void **state)
{
    (void)state;
    char path[PROGRAM_PATH_SIZE], data[3 + DISK_CACHE_HASH_SIZE] = "abc";
    assert_true(program_path(path, "cache-of-test-system"));
    const char *earlier = disk_cache_set_folder(path);
    const struct disk_cache_file request = {
        .name = "test.bin", .size_max = 100, .is_quiet = true, .is_sound = is_sound
    };
    size_t size;
    disk_cache_write("test.bin", data, 3);
    char *read = disk_cache_read(&request, &size);
    assert_non_null(read);
    assert_int_equal(size, sizeof(data));
    assert_memory_equal(read, "abc", 3);
    free(read);
    disk_cache_evict("test", 0);
    assert_null(disk_cache_read(&request, &size));
    disk_cache_set_folder(earlier);
}

/* ---- reader processes ---- */

/* Sends DATA_SIZE bytes and a note, or crashes if `details` is "crash". */
static int read_in_child(int argc, char **argv)
{
    struct reader_job job;
    if (!reader_enter(argc, argv, &job))
        return STATUS_USAGE;
    if (strcmp(job.details, "crash") == 0)
        abort();
    char *bytes = calloc(DATA_SIZE, 1);
    fprintf(stderr, "firn: note: %s was read\n", job.path);
    const bool is_sent =
        bytes && pipe_write(&reader_sink, bytes, DATA_SIZE) && pipe_write_end(&reader_sink);
    _Exit(is_sent ? STATUS_OK : STATUS_WRITE);
}

/* Runs a reader of the test's file and returns its result. */
static enum status run_reader(const char *details)
{
    char program[PROGRAM_PATH_SIZE];
    struct reader *reader;
    char *bytes = calloc(DATA_SIZE, 1);
    assert_true(bytes && program_path(program, NULL));
    const struct reader_params params = { .program = program, .details = details };
    enum status status = reader_start(&reader, &params, READER_IMAGE, file_name);
    assert_int_equal(status, STATUS_OK);
    const struct pipe_source source = reader_source(reader);
    enum pipe_fault fault = source.read(source.user, bytes, DATA_SIZE) ? PIPE_OK : PIPE_SHORT;
    if (fault == PIPE_OK)
        fault = pipe_read_end(&source);
    status = reader_end(reader, fault);
    free(bytes);
    return status;
}

static void test_reader(void **state)
{
    (void)state;
    assert_int_equal(file_io_write(file_name, "x", 1), STATUS_OK);
    assert_int_equal(run_reader(""), STATUS_OK);
    assert_int_equal(run_reader("a \"quoted\\\" detail\\"), STATUS_OK);
    assert_int_equal(run_reader("crash"), STATUS_DATA);
    assert_int_equal(remove(file_name), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_thread), cmocka_unit_test(test_parallel),
        cmocka_unit_test(test_text),   cmocka_unit_test(test_machine),
        cmocka_unit_test(test_files),  cmocka_unit_test(test_cache),
        cmocka_unit_test(test_reader),
    };
    if (reader_is_child(argc, argv))
        return read_in_child(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
