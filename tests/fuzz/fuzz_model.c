/*
 * fuzz_model.c: reads the input as a model file and, after the first 0 of a text file, a second
 * file that it may refer to. As in the program, a child reads it and sends the meshes through a
 * pipe, and the parent accepts them or reports why there are none. Draco, stb, libwebp and libavif
 * are large and not instrumented; some broken files make them crash, or work for hours. That is
 * why a child reads: there, and nowhere else, it is allowed. So their functions are wrapped (the
 * linker's --wrap), and say in shared memory that one of them runs. A crash at any other time is a
 * fault, and so is an end without a status of the reader, meshes that the parent does not accept
 * and anything that the sanitizers find in the parent. The child is forked, which is a hundred
 * times as fast as a new program. It returns its counters of coverage, of which libFuzzer sees
 * only the parent's.
 */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include <errno.h>
#include <sanitizer/common_interface_defs.h>
#include <signal.h>
#include <stb/stb_image.h>
#include <stb/stb_image_resize.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <webp/decode.h>
#include "src/scene/import/gltf/gltf_draco.h"
#include "src/scene/import/model_avif.h"
#include "src/scene/import/model_pipe.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/fuzz_scene.h"

enum {
    THEIR_MS = 250, /* CPU time of one call of Draco, stb, libwebp or libavif */
    OUR_MS = 20000,
    COUNTERS_SIZE = 1 << 20,
    SIZE_MAX_OF_ALL = 1 << 30,
};

/* Of libFuzzer: an 8-bit counter for each edge of the instrumented code. Only the linker knows them
 * by these names, because the compiler adds the usual ones to each file in another way. */
extern uint8_t counters_begin[], counters_end[];

struct shared {
    int their_calls; /* a function of Draco, stb, libwebp or libavif runs */
    uint8_t counters[COUNTERS_SIZE];
};

static struct shared *shared;

/* NOLINTBEGIN(readability-identifier-naming): names of AddressSanitizer and the linker */

/* No allocation of theirs makes the fuzzer run out of memory. */
const char *__asan_default_options(void);

const char *__asan_default_options(void)
{
    return "max_allocation_size_mb=1024:allocator_may_return_null=1:symbolize=0";
}

/* ---- in the child ---- */

static void set_timer(int ms)
{
    const struct itimerval timer = { .it_value = { ms / 1000, (suseconds_t)ms % 1000 * 1000 } };
    setitimer(ITIMER_PROF, &timer, NULL);
}

static void enter(void)
{
    if (shared->their_calls++ == 0)
        set_timer(THEIR_MS);
}

static void leave(void)
{
    if (--shared->their_calls == 0)
        set_timer(OUR_MS);
}

#define WRAP(type, name, parameters, arguments) \
    type __real_##name parameters; \
    type __wrap_##name parameters; \
\
    type __wrap_##name parameters \
    { \
        enter(); \
        type result = __real_##name arguments; \
        leave(); \
        return result; \
    }

WRAP(struct gltf_draco *, gltf_draco_new, (const void *bytes, size_t size), (bytes, size))
WRAP(stbi_uc *, stbi_load_from_memory,
     (const stbi_uc *bytes, int size, int *x, int *y, int *channels, int wanted),
     (bytes, size, x, y, channels, wanted))
WRAP(int, stbi_info_from_memory, (const stbi_uc *bytes, int size, int *x, int *y, int *channels),
     (bytes, size, x, y, channels))

WRAP(int, WebPGetInfo, (const uint8_t *bytes, size_t size, int *width, int *height),
     (bytes, size, width, height))
WRAP(uint8_t *, WebPDecodeRGBAInto,
     (const uint8_t *bytes, size_t size, uint8_t *texels, size_t texels_size, int stride),
     (bytes, size, texels, texels_size, stride))
WRAP(bool, model_avif_read_size, (const uint8_t *bytes, size_t size, int *width, int *height),
     (bytes, size, width, height))
WRAP(enum status, model_avif_decode,
     (const uint8_t *bytes, size_t size, int width, int height, uint8_t *texels),
     (bytes, size, width, height, texels))

/* NOLINTEND(readability-identifier-naming) */

static bool write_all(void *user, const void *bytes, size_t size)
{
    const int *out = user;
    for (const char *next = bytes; size > 0;) {
        const ssize_t count = write(*out, next, size);
        if (count <= 0)
            return false;
        next += count;
        size -= (size_t)count;
    }
    return true;
}

static void die_quietly(void)
{
}

/* No crash of the child is libFuzzer's to report: the parent looks at it. What sanitizers say goes
 * to stderr instead of a file for each process. */
static void leave_reports(void)
{
    static const int signals[] = { SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTERM };
    for (size_t i = 0; i < sizeof(signals) / sizeof(signals[0]); i++)
        signal(signals[i], SIG_DFL);
    __sanitizer_set_death_callback(die_quietly);
    __sanitizer_set_report_fd((void *)STDERR_FILENO);
}

_Noreturn static void read_in_child(const char *path, enum model_role part, int out)
{
    const struct pipe_sink sink = { write_all, &out };
    struct model model;
    leave_reports();
    set_timer(OUR_MS);
    enum status status = model_load(&model, path, part);
    if (status != STATUS_OK)
        fuzz_check_no_model(&model);
    else if (!model_pipe_write_model(&sink, &model))
        status = STATUS_WRITE;
    model_finish(&model);
    memcpy(shared->counters, counters_begin, (size_t)(counters_end - counters_begin));
    _exit((int)status);
}

/* ---- in the parent ---- */

static bool read_pipe(void *user, void *bytes, size_t size)
{
    const int *in = user;
    for (char *next = bytes; size > 0;) {
        const ssize_t count = read(*in, next, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return false;
        next += count;
        size -= (size_t)count;
    }
    return true;
}

static void add_coverage(void)
{
    const size_t size = (size_t)(counters_end - counters_begin);
    for (size_t i = 0; i < size; i++) {
        if (shared->counters[i] > counters_begin[i])
            counters_begin[i] = shared->counters[i];
    }
}

/* Aborts if the child's end is none of the reader's. */
static void check_end(int ended, enum pipe_fault fault)
{
    const int code = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    if (fault == PIPE_SHORT && shared->their_calls > 0)
        return;
    if (fault == PIPE_OK)
        FUZZ_CHECK(code == STATUS_OK);
    else
        FUZZ_CHECK(fault == PIPE_SHORT && (code == STATUS_DATA || code == STATUS_TRY_AGAIN));
    add_coverage();
}

static void read_model(const char *path, enum model_role part)
{
    struct model model;
    int pipes[2], ended = 0;
    FUZZ_CHECK(pipe(pipes) == 0);
    shared->their_calls = 0;
    const pid_t child = fork();
    FUZZ_CHECK(child >= 0);
    if (child == 0) {
        close(pipes[0]);
        read_in_child(path, part, pipes[1]);
    }
    close(pipes[1]);
    const struct pipe_source source = { read_pipe, &pipes[0], SIZE_MAX_OF_ALL };
    const enum pipe_fault fault = model_pipe_read_model(&source, &model);
    close(pipes[0]);
    while (waitpid(child, &ended, 0) != child)
        FUZZ_CHECK(errno == EINTR);
    if (fault == PIPE_OK)
        fuzz_check_model(&model);
    else
        fuzz_check_no_model(&model);
    model_finish(&model);
    check_end(ended, fault);
}

/* Returns the suffix of the format as which the bytes begin. */
static const char *find_name(const uint8_t *data, size_t size)
{
    if (size >= 4 && !memcmp(data, "glTF", 4))
        return "a.glb";
    if (size >= 3 && !memcmp(data, "ply", 3))
        return "a.ply";
    if (size >= 5 && (!memcmp(data, "solid", 5) || !memcmp(data, "STL b", 5)))
        return "a.stl";
    return size >= 1 && data[0] == '{' ? "a.gltf" : "a.obj";
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    if (!shared) {
        shared =
            mmap(NULL, sizeof(*shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        FUZZ_CHECK(shared != MAP_FAILED);
        FUZZ_CHECK(counters_end - counters_begin <= COUNTERS_SIZE);
    }
    const char *name = find_name(data, size);
    const bool is_text = !strcmp(name, "a.gltf") || !strcmp(name, "a.obj");
    const uint8_t *end = is_text && size > 0 ? memchr(data, 0, size) : NULL;
    const size_t model_size = end ? (size_t)(end - data) : size;
    fuzz_file_write(path, "beside", end ? end + 1 : data, end ? size - model_size - 1 : 0);
    fuzz_file_write(path, name, data, model_size);
    read_model(path, size & 1 ? MODEL_OBJECT : MODEL_SURROUNDINGS);
    return 0;
}
