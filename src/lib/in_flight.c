/* in_flight.c: firn_submit() and firn_fetch(): a worker thread draws views asynchronously. */
#include <string.h>
#include "src/base/disk_cache.h"
#include "src/lib/lib.h"
#include "src/scene/bundled_assets.h"

static struct lib_job *job_of(firn_renderer *r, uint64_t number)
{
    return &r->jobs[number % LIB_IN_FLIGHT];
}

static void finish_pending(firn *device)
{
    mutex_lock(&device->lock);
    if (--device->pending == 0)
        condition_wake_all(&device->idle);
    mutex_unlock(&device->lock);
}

/* Draws a view. Sends messages to the device's callback, and stores the error in the job. */
static void draw(firn_renderer *r, struct lib_job *job)
{
    struct lib_sink sink = r->scene->device->sink;
    sink.error = job->error;
    job->error[0] = '\0';
    log_set_sink(&sink.base);
    job->status = lib_draw(r, &job->camera, &job->result, NULL, NULL);
    job->shown = lib_shown_of(r);
    log_set_sink(NULL);
}

static void work(void *user)
{
    firn_renderer *r = user;
    firn *device = r->scene->device;
    disk_cache_set_folder(device->cache);
    asset_set_folder(device->assets);
    mutex_lock(&r->lock);
    while (!r->ends) {
        if (r->drawn == r->submitted) {
            condition_wait(&r->changed, &r->lock);
            continue;
        }
        struct lib_job *job = job_of(r, r->drawn);
        if (r->drawn >= r->cancelled) /* submitted after firn_cancel() */
            atomic_store(&r->is_cancelled, false);
        mutex_unlock(&r->lock);
        draw(r, job);
        mutex_lock(&r->lock);
        r->drawn++;
        condition_wake_all(&r->changed);
        finish_pending(device);
    }
    mutex_unlock(&r->lock);
}

void lib_worker_end(firn_renderer *r)
{
    if (r->has_worker) {
        mutex_lock(&r->lock);
        r->ends = true;
        condition_wake_all(&r->changed);
        mutex_unlock(&r->lock);
        thread_join(&r->worker);
    }
    for (uint32_t i = 0; i < LIB_IN_FLIGHT; i++)
        render_result_finish(&r->jobs[i].result);
}

static enum status start(firn_renderer *r)
{
    if (!r->has_worker)
        r->has_worker = thread_start(&r->worker, work, r);
    if (!r->has_worker)
        log_error("cannot start a thread");
    return r->has_worker ? STATUS_OK : STATUS_TRY_AGAIN;
}

static enum status submit(firn_renderer *r, const struct firn_camera *camera, uint64_t *ticket)
{
    firn *device = r->scene->device;
    struct firn_camera copied;
    enum status status = lib_camera_read(&copied, camera);
    if (status == STATUS_OK)
        status = lib_require(ticket, "ticket");
    if (status == STATUS_OK && r->submitted - r->fetched == LIB_IN_FLIGHT) {
        log_error("two views of the renderer are in flight: fetch one first");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = start(r);
    if (status != STATUS_OK)
        return status;
    mutex_lock(&device->lock);
    device->pending++;
    mutex_unlock(&device->lock);
    mutex_lock(&r->lock);
    struct lib_job *job = job_of(r, r->submitted);
    job->camera = copied;
    job->ticket = ++r->submitted;
    *ticket = job->ticket;
    condition_wake_all(&r->changed);
    mutex_unlock(&r->lock);
    return STATUS_OK;
}

/* Returns true if another renderer of the device has views in flight. */
static bool is_other_busy(const firn_renderer *r)
{
    firn *device = r->scene->device;
    mutex_lock(&device->lock);
    const uint64_t pending = device->pending;
    mutex_unlock(&device->lock);
    return pending && r->submitted == r->fetched;
}

firn_status firn_submit(firn_renderer *renderer, const struct firn_camera *camera, uint64_t *ticket)
{
    struct lib_call call;
    const bool is_own = renderer && lib_is_own(renderer->scene->device);
    const bool waits = is_own && is_other_busy(renderer);
    if (!lib_enter(&call, renderer ? renderer->scene->device : NULL, waits))
        return renderer ? FIRN_FAILED : FIRN_USAGE;
    return lib_leave(&call, submit(renderer, camera, ticket));
}

static enum status fetch(firn_renderer *r, uint64_t ticket, const struct firn_buffer *buffers,
                         size_t count)
{
    enum status status = lib_buffers_check(r, buffers, count);
    if (status == STATUS_OK && (r->fetched == r->submitted || ticket != r->fetched + 1)) {
        log_error("ticket %llu: not the oldest view in flight", (unsigned long long)ticket);
        status = STATUS_USAGE;
    }
    if (status != STATUS_OK)
        return status;
    struct lib_job *job = job_of(r, r->fetched);
    mutex_lock(&r->lock);
    while (r->drawn <= r->fetched)
        condition_wait(&r->changed, &r->lock);
    mutex_unlock(&r->lock);
    status = job->status;
    if (status == STATUS_OK)
        status = lib_buffers_write(r, buffers, count, &job->shown, &job->result);
    else
        memcpy(r->scene->device->message, job->error, LIB_MESSAGE_SIZE);
    r->fetched++;
    return status;
}

firn_status firn_fetch(firn_renderer *renderer, uint64_t ticket, const struct firn_buffer *buffers,
                       size_t count)
{
    struct lib_call call;
    if (!lib_enter(&call, renderer ? renderer->scene->device : NULL, false))
        return renderer ? FIRN_FAILED : FIRN_USAGE;
    return lib_leave(&call, fetch(renderer, ticket, buffers, count));
}

int firn_is_ready(firn_renderer *r)
{
    if (!r || !lib_is_own(r->scene->device))
        return 0;
    mutex_lock(&r->lock);
    const int is_ready = r->drawn > r->fetched;
    mutex_unlock(&r->lock);
    return is_ready;
}
