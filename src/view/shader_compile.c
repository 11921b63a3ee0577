/* shader_compile.c: compiles a shader with glslc and checks the resulting SPIR-V. */
#include "src/view/shader_compile.h"
#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include "shaders/embedded.h"

extern char **environ;

enum {
    PATH_SIZE = 4096,
    CODE_SIZE_MAX = 16 << 20,
    BINDING_COUNT = 64,
    SPIRV_MAGIC = 0x07230203,
    SPIRV_HEADER_WORDS = 5,
    SPIRV_OP_DECORATE = 71, /* operands: target id, decoration, value */
    SPIRV_BINDING = 33,
};

static const char program[] = "glslc";
static const char *const flags[] = { WATCH_GLSLC_FLAGS };

enum {
    FLAG_COUNT = sizeof(flags) / sizeof(flags[0]),
    FIXED_FLAG_COUNT = sizeof(embedded_origins[0].flags) / sizeof(embedded_origins[0].flags[0]),
    WORD_COUNT = FLAG_COUNT + FIXED_FLAG_COUNT + 6,
};

/* Runs the compiler with stdout and stderr redirected to `out`. Returns the compiler's exit code.
 * Returns -1 if the compiler crashed or could not be run. */
static int run(char *const *args, FILE *out)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t none;
    pid_t child;
    int status = -1;
    sigemptyset(&none);
    if (posix_spawn_file_actions_init(&files) != 0)
        return -1;
    if (posix_spawnattr_init(&how) != 0) {
        posix_spawn_file_actions_destroy(&files);
        return -1;
    }
    posix_spawnattr_setsigmask(&how, &none); /* do not inherit blocked signals */
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK);
    posix_spawn_file_actions_adddup2(&files, fileno(out), 1);
    posix_spawn_file_actions_adddup2(&files, fileno(out), 2);
    const int failed = posix_spawnp(&child, program, &files, &how, args, environ);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    if (failed)
        return -1;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool shader_compile_is_possible(void)
{
    char name[] = "glslc";
    char version[] = "--version";
    char *const args[] = { name, version, NULL };
    FILE *out = tmpfile();
    const bool possible = out && run(args, out) == 0;
    if (out)
        fclose(out);
    return possible;
}

/* Finds the compiler's first error message, without its newline. */
static void find_fault(FILE *out, char message[static SHADER_COMPILE_MESSAGE_SIZE])
{
    char line[SHADER_COMPILE_MESSAGE_SIZE];
    rewind(out);
    while (fgets(line, sizeof(line), out)) {
        if (!strstr(line, "error: "))
            continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(message, SHADER_COMPILE_MESSAGE_SIZE, "%s", line);
        return;
    }
    snprintf(message, SHADER_COMPILE_MESSAGE_SIZE, "%s could not be run, or crashed", program);
}

static bool read_code(struct shader_compile_code *code, FILE *file)
{
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    if (size < (long)(SPIRV_HEADER_WORDS * sizeof(uint32_t)) || size > CODE_SIZE_MAX || size % 4)
        return false;
    rewind(file);
    code->count = (size_t)size / sizeof(uint32_t);
    code->spirv = malloc((size_t)size);
    if (code->spirv && fread(code->spirv, sizeof(uint32_t), code->count, file) == code->count &&
        code->spirv[0] == SPIRV_MAGIC)
        return true;
    free(code->spirv);
    *code = (struct shader_compile_code){ 0 };
    return false;
}

/* Compiles a shader. The compiler writes to the unnamed temporary files `spirv` and `out`. */
static bool compile_to(struct shader_compile_code *code, const char *folder,
                       const struct embedded_origin *origin,
                       char message[static SHADER_COMPILE_MESSAGE_SIZE], FILE *spirv, FILE *out)
{
    char args[WORD_COUNT][PATH_SIZE];
    char *argv[WORD_COUNT + 1];
    size_t count = 0;
    snprintf(args[count++], PATH_SIZE, "%s", program);
    for (size_t i = 0; i < FLAG_COUNT; i++)
        snprintf(args[count++], PATH_SIZE, "%s", flags[i]);
    for (size_t i = 0; origin->flags[i]; i++)
        snprintf(args[count++], PATH_SIZE, "%s", origin->flags[i]);
    snprintf(args[count++], PATH_SIZE, "-I%s", folder);
    snprintf(args[count++], PATH_SIZE, "-c");
    snprintf(args[count++], PATH_SIZE, "-o");
    snprintf(args[count++], PATH_SIZE, "/dev/fd/%d", fileno(spirv));
    snprintf(args[count++], PATH_SIZE, "%s/%s", folder, origin->file);
    for (size_t i = 0; i < count; i++)
        argv[i] = args[i];
    argv[count] = NULL;
    if (run(argv, out) != 0) {
        find_fault(out, message);
        return false;
    }
    if (read_code(code, spirv))
        return true;
    snprintf(message, SHADER_COMPILE_MESSAGE_SIZE, "%s/%s: the compiler wrote no SPIR-V", folder,
             origin->file);
    return false;
}

bool shader_compile(struct shader_compile_code *code, const char *folder,
                    const struct embedded_origin *origin,
                    char message[static SHADER_COMPILE_MESSAGE_SIZE])
{
    FILE *spirv = tmpfile();
    FILE *out = tmpfile();
    bool compiled = false;
    *code = (struct shader_compile_code){ 0 };
    if (spirv && out)
        compiled = compile_to(code, folder, origin, message, spirv, out);
    else
        snprintf(message, SHADER_COMPILE_MESSAGE_SIZE, "cannot create a temporary file: %s",
                 strerror(errno));
    if (spirv)
        fclose(spirv);
    if (out)
        fclose(out);
    return compiled;
}

/* Returns a mask of the descriptor bindings in SPIR-V code: bit i for binding i. */
static uint64_t find_bindings(const uint32_t *spirv, size_t count)
{
    uint64_t bindings = 0;
    for (size_t i = SPIRV_HEADER_WORDS; i < count;) {
        const size_t length = spirv[i] >> 16;
        const bool is_binding = (spirv[i] & 0xffff) == SPIRV_OP_DECORATE && length == 4 &&
                                i + 3 < count && spirv[i + 2] == SPIRV_BINDING;
        if (is_binding && spirv[i + 3] < BINDING_COUNT)
            bindings |= UINT64_C(1) << spirv[i + 3];
        i += length ? length : count;
    }
    return bindings;
}

int shader_compile_new_binding(const struct shader_compile_code *code, const uint32_t *allowed,
                               size_t allowed_count)
{
    const uint64_t added =
        find_bindings(code->spirv, code->count) & ~find_bindings(allowed, allowed_count);
    for (int i = 0; i < BINDING_COUNT; i++) {
        if (added >> i & 1)
            return i;
    }
    return -1;
}
