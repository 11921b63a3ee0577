/*
 * The input defines the behaviour of a reader process: data, messages and exit. For any input, data
 * that the parent accepts is valid, refused data leaves no memory, and the status is one of
 * those of reader_process.h. No process is started: the linker puts stand-ins in place of its calls
 * (--wrap, tests/fuzz/meson.build).
 */
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#include "src/file/preset.h"
#include "src/scene/import/sandboxed_load.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_scene.h"
#include "tests/fuzz/fuzz_stream.h"

enum {
    HEAD_SIZE = 3, /* file kind, exit of the child, length of its messages */
};

static struct memory_pipe data, messages;
static int pipes[2]; /* the child's stdout and stderr */
static int wait_status;

/* NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): names of the linker */

int __wrap_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *files, int from, int to);
int __wrap_posix_spawn(pid_t *process, const char *path, const posix_spawn_file_actions_t *files,
                       const posix_spawnattr_t *attributes, char *const *arguments,
                       char *const *variables);
pid_t __wrap_waitpid(pid_t process, int *status, int options);
int __wrap_kill(pid_t process, int number);

int __wrap_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *files, int from, int to)
{
    (void)files;
    FUZZ_CHECK(to == STDOUT_FILENO || to == STDERR_FILENO);
    pipes[to - STDOUT_FILENO] = from;
    return 0;
}

int __wrap_posix_spawn(pid_t *process, const char *path, const posix_spawn_file_actions_t *files,
                       const posix_spawnattr_t *attributes, char *const *arguments,
                       char *const *variables)
{
    (void)path, (void)files, (void)attributes, (void)arguments, (void)variables;
    *process = getpid();
    FUZZ_CHECK(write(pipes[0], data.bytes, data.size) == (ssize_t)data.size);
    FUZZ_CHECK(write(pipes[1], messages.bytes, messages.size) == (ssize_t)messages.size);
    return 0;
}

pid_t __wrap_waitpid(pid_t process, int *status, int options)
{
    (void)options;
    *status = wait_status;
    return process;
}

int __wrap_kill(pid_t process, int number)
{
    (void)process, (void)number;
    return 0;
}

/* NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming) */

/* Returns what waitpid() stores: an exit code, or a signal. */
static int end_of(uint8_t byte)
{
    static const int codes[] = { 0, 1, 2, 65, 66, 69, 75, 127 };
    static const int signals[] = { SIGSEGV, SIGXCPU, SIGKILL, SIGABRT };
    return byte & 8 ? signals[byte & 3] : codes[byte & 7] << 8;
}

static enum status read_image(const struct reader_params *params)
{
    struct image image = { 0 };
    const enum status status = image_reader_read(&image, "a.exr", params);
    FUZZ_CHECK((status == STATUS_OK) == (image.planes != NULL));
    image_finish(&image);
    return status;
}

static enum status read_preset(const struct reader_params *params)
{
    struct preset preset;
    const enum status status = preset_read(&preset, "a.txt", params);
    for (uint32_t i = 0; i < preset.count; i++)
        FUZZ_CHECK(memchr(preset.lines[i].assignment, 0, PRESET_LINE_SIZE));
    FUZZ_CHECK(status == STATUS_OK || !preset.lines);
    preset_finish(&preset);
    return status;
}

static enum status read_environment(const struct reader_params *params)
{
    struct environment environment;
    const enum status status = sandboxed_load_environment(&environment, "a.hdr", params);
    if (status == STATUS_OK)
        fuzz_check_environment(&environment);
    else
        fuzz_check_no_environment(&environment);
    environment_finish(&environment);
    return status;
}

static enum status read_model(const struct reader_params *params)
{
    struct model model;
    const enum status status = sandboxed_load_model(&model, "a.glb", MODEL_OBJECT, NULL, params);
    if (status == STATUS_OK)
        fuzz_check_model(&model);
    else
        fuzz_check_no_model(&model);
    model_finish(&model);
    return status;
}

/* Makes the child's data from the input: unchanged, or as edits of a valid stream. */
static void make_data(uint8_t kind, const uint8_t *bytes, size_t size)
{
    data = (struct memory_pipe){ .size = 0 };
    if (kind & 4 || (kind & 3) == 3) {
        FUZZ_CHECK(memory_pipe_write(&data, bytes, size < MEMORY_PIPE_SIZE ? size : 0));
        return;
    }
    if ((kind & 3) == 2)
        fuzz_stream_make_head(&data);
    else
        fuzz_stream_make(&data, kind & 1);
    fuzz_stream_edit(&data, bytes, size);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static enum status (*const reads[])(const struct reader_params *params) = {
        read_environment,
        read_model,
        read_image,
        read_preset,
    };
    const struct reader_params params = { .program = "firn", .memory_gib = 1 };
    if (size < HEAD_SIZE)
        return 0;
    const size_t most = size - HEAD_SIZE, length = bytes[2] < most ? bytes[2] : most;
    messages = (struct memory_pipe){ .size = 0 };
    FUZZ_CHECK(memory_pipe_write(&messages, bytes + HEAD_SIZE, length));
    make_data(bytes[0], bytes + HEAD_SIZE + length, most - length);
    wait_status = end_of(bytes[1]);
    const enum status status = reads[bytes[0] & 3](&params);
    FUZZ_CHECK(status == STATUS_OK || status == STATUS_DATA || status == STATUS_NO_INPUT ||
               status == STATUS_NO_DEVICE || status == STATUS_TRY_AGAIN);
    return 0;
}
