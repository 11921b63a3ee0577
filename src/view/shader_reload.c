/* shader_reload.c: shader hot reload: a thread polls files and recompiles those that changed. */
#include "src/view/shader_reload.h"
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include "shaders/embedded.h"
#include "src/base/log.h"
#include "src/view/shader_compile.h"

enum {
    PATH_SIZE = 4096,
    NAME_SIZE = 128,
    DEPTH_MAX = 16,               /* maximum nesting of #include */
    POLL_NANOSECONDS = 100000000, /* polling interval */
};

/* Reload state of one built-in shader. */
struct file {
    const char *name;                   /* source file, relative to the folder */
    uint64_t stamp;                     /* hash of the file and its includes when last compiled */
    uint64_t polled;                    /* hash at the last poll */
    bool failed;                        /* compilation failed */
    struct shader_compile_code ready;   /* compiled code, held back until all shaders compile */
    struct shader_compile_code offered; /* code for shader_reload_take(); protected by the lock */
    struct rg_shader live;              /* active replacement; .words NULL if none */
    struct shader_compile_code code;    /* owns the code of `live` */
    struct shader_compile_code before;  /* for shader_reload_revert() */
    bool taken;                         /* replaced by the last shader_reload_take() */
};

struct shader_reload {
    const char *folder;
    bool quiet;
    struct file *files; /* parallel to embedded_all */
    size_t count;
    pthread_t thread;
    bool runs;
    pthread_mutex_t lock;
    pthread_cond_t wake;
    bool quit, has_new;                        /* protected by the lock, like `message` */
    char message[SHADER_COMPILE_MESSAGE_SIZE]; /* error of the last compilation */
    char shown[SHADER_COMPILE_MESSAGE_SIZE];   /* copy by shader_reload_take() */
};

static void free_code(struct shader_compile_code *code)
{
    free(code->spirv);
    *code = (struct shader_compile_code){ 0 };
}

/* 64-bit FNV-1a hash */
static uint64_t mix(uint64_t stamp, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        stamp = (stamp ^ bytes[i]) * 0x100000001b3;
    return stamp;
}

/* Returns a hash of the metadata of a file and of all files that it includes. If one of them is
 * saved, the hash changes. Returns 0 if the file does not exist. */
static uint64_t find_stamp(const char *folder, const char *name, int depth)
{
    char path[PATH_SIZE];
    char line[256];
    char included[NAME_SIZE];
    struct stat info;
    uint64_t stamp = 0xcbf29ce484222325;
    const int length = snprintf(path, sizeof(path), "%s/%s", folder, name);
    FILE *file = length > 0 && length < PATH_SIZE && depth < DEPTH_MAX ? fopen(path, "r") : NULL;
    if (!file)
        return 0;
    if (fstat(fileno(file), &info) == 0) {
        stamp = mix(stamp, &info.st_mtim, sizeof(info.st_mtim));
        stamp = mix(stamp, &info.st_size, sizeof(info.st_size));
        stamp = mix(stamp, &info.st_ino, sizeof(info.st_ino));
    }
    while (fgets(line, sizeof(line), file)) {
        if (sscanf(line, " # include \"%127[^\"]\"", included) != 1)
            continue;
        const uint64_t inner = find_stamp(folder, included, depth + 1);
        stamp = mix(stamp, &inner, sizeof(inner));
    }
    fclose(file);
    return stamp;
}

/* Polls all shader files. Returns true if some must be recompiled. If a file has changed since the
 * previous poll, returns false, because an editor may still be writing it. */
static bool poll_files(struct shader_reload *w)
{
    bool changed = false;
    bool is_stable = true;
    for (size_t i = 0; i < w->count; i++) {
        struct file *f = &w->files[i];
        const uint64_t stamp = find_stamp(w->folder, f->name, 0);
        is_stable = is_stable && stamp == f->polled;
        changed = changed || stamp != f->stamp;
        f->polled = stamp;
    }
    return changed && is_stable;
}

static bool should_quit(struct shader_reload *w)
{
    pthread_mutex_lock(&w->lock);
    const bool quit = w->quit;
    pthread_mutex_unlock(&w->lock);
    return quit;
}

static void compile(struct shader_reload *w, size_t index,
                    char message[static SHADER_COMPILE_MESSAGE_SIZE])
{
    const struct rg_shader *own = embedded_all[index];
    struct file *f = &w->files[index];
    struct shader_compile_code code = { 0 };
    f->stamp = f->polled;
    if (f->polled) {
        f->failed = !shader_compile(&code, w->folder, &embedded_origins[index], message);
    } else {
        f->failed = true;
        snprintf(message, SHADER_COMPILE_MESSAGE_SIZE, "%s/%s: the file was deleted", w->folder,
                 f->name);
    }
    if (f->failed)
        return;
    const int binding = shader_compile_new_binding(&code, own->words, own->word_count);
    f->failed = binding >= 0;
    if (f->failed) {
        snprintf(message, SHADER_COMPILE_MESSAGE_SIZE,
                 "%s/%s: binding %d is not declared by its pass; add it to the pass", w->folder,
                 f->name, binding);
        free_code(&code);
        return;
    }
    free_code(&f->ready);
    f->ready = code;
}

/* If every changed shader was compiled, makes all of them available to shader_reload_take(). */
static void offer(struct shader_reload *w, const char *message, bool sound)
{
    size_t count = 0;
    const char *name = "";
    pthread_mutex_lock(&w->lock);
    if (sound || *message) /* else keep the previous error */
        snprintf(w->message, sizeof(w->message), "%s", message);
    for (size_t i = 0; i < w->count && sound; i++) {
        struct file *f = &w->files[i];
        if (!f->ready.spirv)
            continue;
        free_code(&f->offered);
        f->offered = f->ready;
        f->ready = (struct shader_compile_code){ 0 };
        name = f->name;
        count++;
    }
    w->has_new = w->has_new || count;
    pthread_mutex_unlock(&w->lock);
    if (!sound) /* no lock is needed, as only this thread writes w->message */
        log_error("%s (the previous shaders stay in use)", w->message);
    else if (count == 1 && !w->quiet)
        fprintf(stderr, "%s/%s: compiled\n", w->folder, name);
    else if (count && !w->quiet)
        fprintf(stderr, "%s: %zu shaders compiled\n", w->folder, count);
}

static void compile_all(struct shader_reload *w)
{
    char message[SHADER_COMPILE_MESSAGE_SIZE] = "";
    bool sound = true;
    for (size_t i = 0; i < w->count; i++) {
        char fault[SHADER_COMPILE_MESSAGE_SIZE] = "";
        struct file *f = &w->files[i];
        if (should_quit(w))
            return;
        if (f->polled != f->stamp)
            compile(w, i, fault);
        if (*fault && !*message)
            memcpy(message, fault, sizeof(message));
        sound = sound && !f->failed;
    }
    offer(w, message, sound);
}

static void *run(void *data)
{
    struct shader_reload *w = data;
    while (!should_quit(w)) {
        struct timespec until;
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += POLL_NANOSECONDS;
        until.tv_sec += until.tv_nsec / 1000000000;
        until.tv_nsec %= 1000000000;
        pthread_mutex_lock(&w->lock);
        if (!w->quit)
            pthread_cond_timedwait(&w->wake, &w->lock, &until);
        pthread_mutex_unlock(&w->lock);
        if (poll_files(w))
            compile_all(w);
    }
    return NULL;
}

/* Finds the source file of each shader. Returns true if at least one of the files exists. */
static bool find_files(struct shader_reload *w)
{
    bool found = false;
    for (size_t i = 0; embedded_all[i]; i++) {
        struct file *f = &w->files[i];
        f->name = embedded_origins[i].file;
        f->stamp = f->polled = find_stamp(w->folder, f->name, 0);
        found = found || f->stamp;
    }
    return found;
}

enum status shader_reload_create(struct shader_reload **reload, const char *folder, bool quiet)
{
    struct shader_reload *w = calloc(1, sizeof(*w));
    size_t count = 0;
    *reload = NULL;
    while (embedded_all[count])
        count++;
    struct file *files = calloc(count + 1, sizeof(*files)); /* not calloc(0) */
    if (!w || !files) {
        log_error("out of memory");
        free(w);
        free(files);
        return STATUS_TRY_AGAIN;
    }
    *w = (struct shader_reload){ .folder = folder, .quiet = quiet, .files = files, .count = count };
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->wake, NULL);
    enum status status = STATUS_OK;
    if (!find_files(w)) {
        log_error(
            "--watch: no shader of firn found in %s/; choose another folder with --watch=FOLDER",
            folder);
        status = STATUS_NO_INPUT;
    } else if (!shader_compile_is_possible()) {
        log_error("--watch: cannot run glslc: install it, or correct PATH");
        status = STATUS_FAILED;
    } else if (pthread_create(&w->thread, NULL, run, w) != 0) {
        log_error("--watch: cannot start a thread");
        status = STATUS_TRY_AGAIN;
    }
    w->runs = status == STATUS_OK;
    if (status == STATUS_OK)
        *reload = w;
    else
        shader_reload_destroy(w);
    return status;
}

void shader_reload_destroy(struct shader_reload *w)
{
    if (!w)
        return;
    if (w->runs) {
        pthread_mutex_lock(&w->lock);
        w->quit = true;
        pthread_cond_signal(&w->wake);
        pthread_mutex_unlock(&w->lock);
        pthread_join(w->thread, NULL);
    }
    for (size_t i = 0; i < w->count; i++) {
        struct file *f = &w->files[i];
        free_code(&f->ready);
        free_code(&f->offered);
        free_code(&f->code);
        free_code(&f->before);
    }
    pthread_mutex_destroy(&w->lock);
    pthread_cond_destroy(&w->wake);
    free(w->files);
    free(w);
}

static void set_live(struct file *f, const struct rg_shader *own)
{
    f->live = (struct rg_shader){ own->name, f->code.spirv, f->code.count };
}

bool shader_reload_take(struct shader_reload *w)
{
    pthread_mutex_lock(&w->lock);
    const bool has_new = w->has_new;
    w->has_new = false;
    memcpy(w->shown, w->message, sizeof(w->shown));
    for (size_t i = 0; i < w->count && has_new; i++) {
        struct file *f = &w->files[i];
        f->taken = f->offered.spirv;
        if (!f->taken)
            continue;
        free_code(&f->before);
        f->before = f->code;
        f->code = f->offered;
        f->offered = (struct shader_compile_code){ 0 };
        set_live(f, embedded_all[i]);
    }
    pthread_mutex_unlock(&w->lock);
    return has_new;
}

void shader_reload_revert(struct shader_reload *w)
{
    for (size_t i = 0; i < w->count; i++) {
        struct file *f = &w->files[i];
        if (!f->taken)
            continue;
        free_code(&f->code);
        f->code = f->before;
        f->before = (struct shader_compile_code){ 0 };
        f->taken = false;
        set_live(f, embedded_all[i]);
    }
}

const char *shader_reload_message(const struct shader_reload *w)
{
    return w->shown;
}

const struct rg_shader *shader_reload_replace(void *user, const struct rg_shader *shader)
{
    const struct shader_reload *w = user;
    for (size_t i = 0; i < w->count; i++) {
        if (embedded_all[i] == shader && w->files[i].live.words)
            return &w->files[i].live;
    }
    return shader;
}
