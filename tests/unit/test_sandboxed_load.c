/* test_sandboxed_load.c: reader processes that crash, hang, exceed limits or send wrong data. */
#define _GNU_SOURCE /* for resource.h's and fcntl.h's names */
#include <errno.h>
#include <fcntl.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include "src/base/log.h"
#include "src/scene/import/model_pipe.h"
#include "src/scene/import/sandboxed_load.h"
#include "tests/support/assertions.h"

/* Far more than any of them needs. */
enum {
    AMPLE = 3600, /* seconds */
};

static char tent[] = "/tmp/firn-decode-XXXXXX.obj";

/* ---- the readers: this program, started anew, with a word in place of a file ---- */

static bool write_out(void *user, const void *bytes, size_t size)
{
    (void)user;
    return write(STDOUT_FILENO, bytes, size) == (ssize_t)size;
}

/* Without pause(), which the sandbox does not allow. */
static void hang(void)
{
    sem_t never;
    sem_init(&never, 0, 0);
    for (;;)
        sem_wait(&never);
}

static void burn(void)
{
    for (volatile unsigned i = 0;; i++) {
    }
}

static void crash(void)
{
    fprintf(stderr, "firn: not to be shown\nnor this\n");
    signal(SIGSEGV, SIG_DFL); /* a sanitizer would exit */
    raise(SIGSEGV);
}

static void give_up(void)
{
    fprintf(stderr, "terminate called\nwith two lines\n");
    signal(SIGABRT, SIG_DFL);
    abort();
}

static void take_all(void)
{
#ifndef READER_MAPS_SHADOWS /* there is no limit of addresses: only the answer is tested */
    char *volatile memory = malloc((size_t)3 << 30);
    if (memory)
        _exit(STATUS_FAILED);
#endif
    _exit(STATUS_TRY_AGAIN);
}

static void throw_it(void)
{
    fprintf(stderr, "what(): std::bad_alloc\n");
    abort();
}

static void refuse(void)
{
    fprintf(stderr, "noise\nfirn: a.glb: it is \x1b[1mbad\nfirn: and more\n");
    _exit(STATUS_DATA);
}

static void leave(void)
{
    _exit(STATUS_OK);
}

static void send(float x, uint32_t index, const char *end)
{
    struct mesh_vertex vertices[3] = { { .position = { { x, 0, 0 } } } };
    uint32_t indices[3] = { 0, 1, index };
    struct object object = { .index_count = 3 };
    struct material material = material_make("ice");
    const struct model model = {
        .object = { .vertices = vertices, .indices = indices, .vertex_count = 3, .index_count = 3 },
        .objects = &object,
        .object_count = 1,
        .materials = &material,
        .material_count = 1,
    };
    fputs(end, stderr);
    if (!model_pipe_write_model(&(struct pipe_sink){ write_out, NULL }, &model))
        _exit(STATUS_WRITE);
}

static void send_lies(void)
{
    send(0, 3, "");
    hang();
}

static void send_nan(void)
{
    send(strtof("nan", NULL), 2, "");
}

static void send_and_hang(void)
{
    send(1, 2, "firn: warning: odd\n");
    hang();
}

/* Sends single bytes slowly, without using CPU time. */
static void drip(void)
{
    sem_t never;
    sem_init(&never, 0, 0);
    for (;;) {
        struct timespec end;
        clock_gettime(CLOCK_REALTIME, &end);
        end.tv_nsec += 400000000;
        end.tv_sec += end.tv_nsec / 1000000000;
        end.tv_nsec %= 1000000000;
        while (sem_timedwait(&never, &end) != 0 && errno == EINTR)
            continue;
        if (write(STDOUT_FILENO, "F", 1) != 1)
            return;
    }
}

static void babble(void)
{
    for (int i = 0; i < 100000; i++)
        fputs("firn: warning: x\n", stderr);
    send(1, 2, "");
}

static bool is_open(int file)
{
    return fcntl(file, F_GETFD) >= 0;
}

static bool is_limited(int resource, rlim_t max)
{
    struct rlimit limits;
    return getrlimit((unsigned)resource, &limits) == 0 && limits.rlim_max <= max;
}

/* Sends a mesh only if it is shut in as it should be. */
static void look_around(rlim_t seconds)
{
    sigset_t blocked;
    sigprocmask(SIG_BLOCK, NULL, &blocked);
    for (int file = 3; file < 256; file++) {
        if (is_open(file))
            _exit(STATUS_FAILED);
    }
    if (!is_limited(RLIMIT_CORE, 0) || !is_limited(RLIMIT_FSIZE, 0) ||
        !is_limited(RLIMIT_NOFILE, 32) || !is_limited(RLIMIT_CPU, seconds + 1) ||
        getpgrp() != getpid() || sigismember(&blocked, SIGTERM) ||
        signal(SIGPIPE, SIG_DFL) != SIG_DFL || getchar() != EOF)
        _exit(STATUS_FAILED);
    send(1, 2, "");
}

static void look(void)
{
    look_around(AMPLE);
}

static void look_by_default(void)
{
    look_around(READER_SECONDS);
}

static const struct {
    const char *name;
    void (*run)(void);
} readers[] = {
    { "hang", hang },           { "burn", burn },
    { "crash", crash },         { "give-up", give_up },
    { "take-all", take_all },   { "throw", throw_it },
    { "refuse", refuse },       { "leave", leave },
    { "send-lies", send_lies }, { "send-nan", send_nan },
    { "babble", babble },       { "send-and-hang", send_and_hang },
    { "look", look },           { "look-by-default", look_by_default },
    { "drip", drip },
};

static int read_badly(int argc, char **argv)
{
    struct reader_job job;
    for (size_t i = 0; argc > 2 && i < sizeof(readers) / sizeof(readers[0]); i++) {
        if (strcmp(argv[2], readers[i].name) != 0)
            continue;
        if (!reader_enter(argc, argv, &job))
            return STATUS_USAGE;
        readers[i].run();
        return STATUS_OK;
    }
    return sandboxed_load_main(argc, argv);
}

/* ---- what becomes of them ---- */

static const struct reader_params usual = { .program = "/proc/self/exe", .seconds = AMPLE };
/* A reader in a sandbox could not see its limits. */
static const struct reader_params open_air = { .program = "/proc/self/exe",
                                               .seconds = AMPLE,
                                               .no_sandbox = true };
static const struct reader_params hasty = { .program = "/proc/self/exe", .seconds = 1 };

/* Its status; what is logged goes to `said`. */
static enum status decode(const struct reader_params *params, const char *path, struct model *model,
                          char *said, size_t size)
{
    int kept = dup(STDERR_FILENO);
    FILE *caught = tmpfile();
    assert_true(kept >= 0 && caught);
    dup2(fileno(caught), STDERR_FILENO);
    const enum status status = sandboxed_load_model(model, path, MODEL_OBJECT, NULL, params);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(caught);
    const size_t length = fread(said, 1, size - 1, caught);
    said[length] = '\0';
    fclose(caught);
    return status;
}

static void check_refused(const struct reader_params *params, const char *path, enum status wanted,
                          const char *words)
{
    const struct model nothing = { 0 };
    struct model model;
    char said[4096];
    const enum status status = decode(params, path, &model, said, sizeof(said));
    const char *end = strchr(said, '\n');
    if (status != wanted || !strstr(said, words) || !end || end[1] != '\0')
        fail_msg("%s: status %d with \"%s\"", path, (int)status, said);
    assert_memory_equal(&model, &nothing, sizeof(model));
}

static void whatever_it_does(void **state)
{
    (void)state;
    check_refused(&usual, "crash", STATUS_DATA, "crash: the reader crashed (signal 11)");
    check_refused(&usual, "give-up", STATUS_DATA, "crashed (signal 6)");
    struct rlimit limits;
    assert_int_equal(getrlimit(RLIMIT_AS, &limits), 0);
    if (limits.rlim_cur == RLIM_INFINITY)
        check_refused(&usual, "throw", STATUS_DATA, "limit of 4 GiB of memory");
    else
        check_refused(&usual, "throw", STATUS_TRY_AGAIN, "memory limit that the program was start");
    check_refused(&usual, "leave", STATUS_DATA, "crashed (exit code 0)");
    check_refused(&usual, "refuse", STATUS_DATA, "firn: a.glb: it is ?[1mbad\n");
    check_refused(&usual, "send-lies", STATUS_DATA, "invalid: an index beyond the vertices");
    check_refused(&usual, "send-nan", STATUS_DATA, "invalid: a number that is not finite");
    const struct reader_params narrow = { .program = usual.program,
                                          .seconds = AMPLE,
                                          .memory_gib = 2 };
    check_refused(&narrow, "take-all", STATUS_DATA, "--load-memory");
}

static void however_long_it_takes(void **state)
{
    (void)state;
    check_refused(&hasty, "burn", STATUS_DATA,
                  "limit of 1 s of CPU time (raise it with --load-sec");
    const struct reader_params impatient = { .program = usual.program, .idle_seconds = 1 };
    check_refused(&impatient, "hang", STATUS_DATA, "no data arrived for 1 s");
    check_refused(&impatient, "drip", STATUS_DATA, "the data arrives too slowly (");
}

static void models_come_back(void **state)
{
    (void)state;
    struct model model, wanted;
    char said[4096];
    assert_int_equal(decode(&usual, tent, &model, said, sizeof(said)), STATUS_OK);
    assert_string_equal(said, "");
    assert_int_equal(model_load(&wanted, tent, MODEL_OBJECT), STATUS_OK);
    assert_int_equal(model.object.vertex_count, wanted.object.vertex_count);
    assert_memory_equal(model.object.vertices, wanted.object.vertices,
                        wanted.object.vertex_count * sizeof(struct mesh_vertex));
    model_finish(&model);
    model_finish(&wanted);

    assert_int_equal(sandboxed_load_model(&model, tent, MODEL_SURROUNDINGS, NULL, &usual),
                     STATUS_OK);
    assert_int_equal(model.object.vertex_count, 0);
    assert_int_equal(model.surroundings.index_count, 12);
    model_finish(&model);
    check_refused(&usual, "/tmp/firn-decode-none.obj", STATUS_NO_INPUT, "firn-decode-none.obj");
}

/* What it warns of is passed on; that it does not end is not waited for. */
static void warnings_come_back(void **state)
{
    (void)state;
    struct model model;
    char said[4096];
    assert_int_equal(decode(&usual, "send-and-hang", &model, said, sizeof(said)), STATUS_OK);
    assert_string_equal(said, "firn: warning: odd\n");
    model_finish(&model);
    assert_int_equal(decode(&usual, "babble", &model, said, sizeof(said)), STATUS_OK);
    assert_true(strlen(said) < 4096 && strstr(said, "firn: warning: x\n"));
    model_finish(&model);
}

static void it_is_shut_in(void **state)
{
    (void)state;
    struct model model;
    char said[4096];
    sigset_t term, before;
    const int file = open("/dev/null", O_RDONLY); /* would be inherited */
    assert_true(file > 2);
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    sigprocmask(SIG_BLOCK, &term, &before);
    void (*pipes)(int) = signal(SIGPIPE, SIG_IGN);
    const enum status status = decode(&open_air, "look", &model, said, sizeof(said));
    signal(SIGPIPE, pipes);
    sigprocmask(SIG_SETMASK, &before, NULL);
    close(file);
    assert_string_equal(said, "");
    assert_int_equal(status, STATUS_OK);
    model_finish(&model);
}

static void limits_have_defaults(void **state)
{
    (void)state;
    struct model model;
    char said[4096];
    const struct reader_params standard = { .program = "/proc/self/exe", .no_sandbox = true };
    const enum status status = decode(&standard, "look-by-default", &model, said, sizeof(said));
    assert_string_equal(said, "");
    assert_int_equal(status, STATUS_OK);
    model_finish(&model);
}

static void without_a_program(void **state)
{
    (void)state;
    const struct reader_params none = { .program = "/nonexistent/firn" };
    check_refused(&none, tent, STATUS_NO_DEVICE, "/nonexistent/firn");
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whatever_it_does),  cmocka_unit_test(however_long_it_takes),
        cmocka_unit_test(models_come_back),  cmocka_unit_test(warnings_come_back),
        cmocka_unit_test(it_is_shut_in),     cmocka_unit_test(limits_have_defaults),
        cmocka_unit_test(without_a_program),
    };
    if (reader_is_child(argc, argv))
        return read_badly(argc, argv);
    const int file = mkstemps(tent, 4);
    static const char text[] = "v 0 1 0\nv -1 -1 1\nv 1 -1 1\nv 0 -1 -1\n"
                               "f 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n";
    if (file < 0 || write(file, text, sizeof(text) - 1) != (ssize_t)sizeof(text) - 1)
        return 1;
    close(file);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(tent);
    return failed;
}
