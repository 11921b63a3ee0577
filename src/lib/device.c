/* device.c: opens and closes devices, and routes their messages to the caller. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/disk_cache.h"
#include "src/base/environment.h"
#include "src/base/process.h"
#include "src/lib/lib.h"
#include "src/scene/bundled_assets.h"
#include "src/version.h"

static const char forked[] =
    "the device was opened by another process: after fork() a child cannot "
    "use handles of its parent; open devices in processes of their own";

/* Message of this thread's last failed call without a handle. */
static _Thread_local char thread_message[LIB_MESSAGE_SIZE];

/* Process that opened the first device, or 0. Vulkan drivers do not work after fork(). */
static atomic_int opener;

/* Held while a device is opened or closed, because the tables of loaded drivers are global. */
static struct mutex opening = MUTEX_INITIALIZER;

/* ---- messages ---- */

static void write_message(struct log_sink *base, enum log_level level, const char *text)
{
    struct lib_sink *sink = (struct lib_sink *)base;
    firn *device = sink->device;
    if (level == LOG_ERROR)
        snprintf(sink->error, LIB_MESSAGE_SIZE, "%s", text);
    if (!device || !device->log)
        return;
    mutex_lock(&device->log_lock);
    device->log(device->log_user, (int)level, text);
    mutex_unlock(&device->log_lock);
}

bool lib_is_own(const firn *device)
{
    return device->owner == process_id();
}

void lib_enter_alone(struct lib_call *call)
{
    *call = (struct lib_call){
        .own = { .base = { .write = write_message }, .error = thread_message },
    };
    thread_message[0] = '\0';
    call->sink = log_set_sink(&call->own.base);
}

/* Waits until no view is in flight. */
static void wait_until_idle(firn *device)
{
    mutex_lock(&device->lock);
    while (device->pending)
        condition_wait(&device->idle, &device->lock);
    mutex_unlock(&device->lock);
}

bool lib_begin(struct lib_call *call, firn *device, bool waits)
{
    if (!device || !lib_is_own(device)) {
        char *message = device ? device->message : thread_message;
        snprintf(message, LIB_MESSAGE_SIZE, "%s",
                 device ? forked : "expected a handle, got NULL: it is closed, or was not opened");
        return false;
    }
    if (waits)
        wait_until_idle(device);
    *call = (struct lib_call){ .device = device };
    call->sink = log_set_sink(&device->sink.base);
    call->cache = disk_cache_set_folder(device->cache);
    call->assets = asset_set_folder(device->assets);
    return true;
}

firn_status lib_leave(struct lib_call *call, enum status status)
{
    log_set_sink(call->sink);
    if (call->device) {
        disk_cache_set_folder(call->cache);
        asset_set_folder(call->assets);
    }
    return (firn_status)status;
}

const char *firn_error(const firn *device)
{
    return device ? device->message : thread_message;
}

/* ---- structs of callers ---- */

enum status lib_read(void *to, size_t size, const void *from, const char *what)
{
    size_t given = 0;
    if (lib_require(from, what) != STATUS_OK)
        return STATUS_USAGE;
    memcpy(&given, from, sizeof(given));
    const char *bytes = from;
    bool is_known = given >= sizeof(given) && given <= 65536;
    for (size_t i = size; is_known && i < given; i++)
        is_known = bytes[i] == 0;
    if (!is_known) {
        log_error("%s.size: expected the size of the struct, at most %zu, got %zu", what, size,
                  given);
        return STATUS_USAGE;
    }
    memset(to, 0, size);
    memcpy(to, from, given < size ? given : size);
    return STATUS_OK;
}

enum status lib_write(void *to, const void *from, size_t size, const char *what)
{
    size_t given = 0;
    if (lib_require(to, what) != STATUS_OK)
        return STATUS_USAGE;
    memcpy(&given, to, sizeof(given));
    if (given < sizeof(given) || given > 65536) {
        log_error("%s.size: expected the size of the struct, at most %zu, got %zu", what, size,
                  given);
        return STATUS_USAGE;
    }
    if (given > size)
        memset((char *)to + size, 0, given - size);
    else
        size = given;
    memcpy((char *)to + sizeof(given), (const char *)from + sizeof(given), size - sizeof(given));
    return STATUS_OK;
}

/* ---- opening ---- */

/* Copies an option, or the environment variable if it is NULL, or the default if both are unset.
 * Returns false when out of memory. */
static bool copy(char **to, const char *option, const char *variable, const char *initial)
{
    const char *value = variable ? environment_get_secure(variable) : NULL;
    const char *from = option ? option : value && value[0] ? value : initial;
    *to = from ? strdup(from) : NULL;
    return *to || !from;
}

static enum status init(firn *device, const struct firn_options *options)
{
    const uint32_t known = FIRN_NO_CACHE | FIRN_VALIDATE | FIRN_WITHOUT_DEVICE;
    if (options->flags & ~known || (options->cache && options->cache[0] != '/')) {
        if (options->flags & ~known)
            log_error("options.flags: %#x is unknown", options->flags & ~known);
        else
            log_error("options.cache: expected an absolute path, got '%s'", options->cache);
        return STATUS_USAGE;
    }
    device->log = options->log;
    device->log_user = options->log_user;
    device->has_gpu = !(options->flags & FIRN_WITHOUT_DEVICE);
    const bool is_copied =
        copy(&device->name, options->device, NULL, NULL) &&
        copy(&device->reader, options->reader, "FIRN_READER", FIRN_READER_PROGRAM) &&
        copy(&device->cache, options->cache, NULL, NULL) &&
        copy(&device->assets, options->assets, "FIRN_ASSETS", FIRN_ASSET_FOLDER);
    return is_copied ? STATUS_OK : log_out_of_memory(NULL);
}

static enum status open_gpu(firn *device, uint32_t flags)
{
    device->gpu_params = (struct gpu_params){
        .device = device->name,
        .validate = flags & FIRN_VALIDATE,
        .no_cache = flags & FIRN_NO_CACHE,
    };
    if (!device->has_gpu)
        return STATUS_OK;
    atomic_store(&opener, process_id());
    mutex_lock(&opening);
    const enum status status = gpu_create(&device->gpu, &device->gpu_params);
    mutex_unlock(&opening);
    return status;
}

/* Routes messages to a new device while it is opened; errors become the thread's message. */
static enum status open_device(struct lib_call *call, const struct firn_options *options,
                               firn **opened)
{
    firn *device = calloc(1, sizeof(*device));
    if (!device)
        return log_out_of_memory(NULL);
    device->owner = process_id();
    device->refs = 1;
    device->sink = (struct lib_sink){ { write_message }, device, device->message };
    mutex_init(&device->log_lock);
    mutex_init(&device->lock);
    condition_init(&device->idle);
    enum status status = init(device, options);
    call->own.device = device;
    call->cache = disk_cache_set_folder(device->cache);
    if (status == STATUS_OK)
        status = open_gpu(device, options->flags);
    call->own.device = NULL;
    disk_cache_set_folder(call->cache);
    if (status == STATUS_OK)
        *opened = device;
    else
        lib_release_device(device);
    return status;
}

firn_status firn_open(const struct firn_options *options, firn **device)
{
    struct lib_call call;
    struct firn_options copied = { .size = sizeof(copied) };
    lib_enter_alone(&call);
    enum status status = lib_require(device, "device");
    if (status == STATUS_OK)
        *device = NULL;
    if (status == STATUS_OK && options)
        status = lib_read(&copied, sizeof(copied), options, "options");
    const int process = atomic_load(&opener);
    if (status == STATUS_OK && process && process != process_id()) {
        log_error("%s", forked);
        status = STATUS_FAILED;
    }
    if (status == STATUS_OK)
        status = open_device(&call, &copied, device);
    return lib_leave(&call, status);
}

void lib_release_device(firn *device)
{
    if (--device->refs)
        return;
    if (device->has_gpu) {
        mutex_lock(&opening);
        gpu_destroy(&device->gpu);
        mutex_unlock(&opening);
    }
    mutex_finish(&device->log_lock);
    mutex_finish(&device->lock);
    condition_finish(&device->idle);
    free(device->name);
    free(device->reader);
    free(device->cache);
    free(device->assets);
    free(device);
}

void firn_close(firn *device)
{
    struct lib_call call;
    if (!device || !lib_enter(&call, device, true))
        return;
    lib_release_device(device);
    (void)lib_leave(&call, STATUS_OK);
}

const char *firn_device_name(const firn *device)
{
    return device && device->has_gpu ? device->gpu.properties.deviceName : "";
}

/* ---- library ---- */

const char *firn_version(void)
{
    return FIRN_VERSION;
}

const char *firn_status_name(firn_status status)
{
    static const struct {
        firn_status status;
        const char *name;
    } names[] = {
        { FIRN_OK, "FIRN_OK" },
        { FIRN_FAILED, "FIRN_FAILED" },
        { FIRN_USAGE, "FIRN_USAGE" },
        { FIRN_DATA, "FIRN_DATA" },
        { FIRN_NO_INPUT, "FIRN_NO_INPUT" },
        { FIRN_NO_DEVICE, "FIRN_NO_DEVICE" },
        { FIRN_CANT_CREATE, "FIRN_CANT_CREATE" },
        { FIRN_WRITE, "FIRN_WRITE" },
        { FIRN_TRY_AGAIN, "FIRN_TRY_AGAIN" },
        { FIRN_CANCELLED, "FIRN_CANCELLED" },
    };

    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        if (names[i].status == status)
            return names[i].name;
    }
    return "?";
}

_Static_assert((int)FIRN_FAILED == (int)STATUS_FAILED && (int)FIRN_USAGE == (int)STATUS_USAGE &&
                   (int)FIRN_DATA == (int)STATUS_DATA &&
                   (int)FIRN_NO_INPUT == (int)STATUS_NO_INPUT &&
                   (int)FIRN_NO_DEVICE == (int)STATUS_NO_DEVICE &&
                   (int)FIRN_CANT_CREATE == (int)STATUS_CANT_CREATE &&
                   (int)FIRN_WRITE == (int)STATUS_WRITE &&
                   (int)FIRN_TRY_AGAIN == (int)STATUS_TRY_AGAIN,
               "the values are the program's exit codes");
