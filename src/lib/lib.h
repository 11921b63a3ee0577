/* lib.h: handles of the library, and helpers of all calls: messages, checks of the calling process,
 * and copies of the caller's structs. */
#ifndef FIRN_LIB_LIB_H
#define FIRN_LIB_LIB_H

#include <stdatomic.h>
#include "src/base/log.h"
#include "src/base/thread.h"
#include "src/lib/firn.h"
#include "src/lib/image_session.h"

enum {
    LIB_MESSAGE_SIZE = 2048,
    LIB_IN_FLIGHT = 2, /* maximum number of views in flight, per renderer */
};

/* Log sink that belongs to a device. */
struct lib_sink {
    struct log_sink base;
    struct firn *device;
    char *error; /* receives errors, LIB_MESSAGE_SIZE bytes */
};

struct firn {
    int owner; /* process that opened the device */
    uint32_t refs;
    struct gpu gpu;
    struct gpu_params gpu_params;
    bool has_gpu;
    firn_log_fn *log;
    void *log_user;
    char *name, *reader, *cache, *assets;
    struct lib_sink sink;
    char message[LIB_MESSAGE_SIZE];
    struct mutex log_lock; /* held while `log` runs */
    struct mutex lock;     /* guards `pending` */
    struct condition idle; /* signalled when `pending` becomes 0 */
    uint32_t pending;      /* views in flight */
};

/* Copy of a caller's string; equal strings share one. */
struct lib_text {
    struct lib_text *next;
    char text[];
};

struct lib_arrays;

/* Replacement of an object's material. */
struct lib_material_change {
    uint32_t object;
    struct firn_material material;
};

struct firn_scene {
    firn *device;
    uint32_t refs;
    struct lib_text *texts;
    struct setup_image given; /* options as the caller set them */
    struct setup_image image; /* options of the loaded scene */
    struct session_scene session;
    bool is_loaded;
    bool needs_load;           /* `given` or arrays have changed: reload the scene */
    bool needs_settings;       /* settings of `given` have changed */
    uint32_t version;          /* incremented by each change of `image` */
    bool is_arrays;            /* created by firn_scene_create() */
    struct lib_arrays *arrays; /* arrays and environment of the caller, or NULL */
    struct scene_source source;
    struct lib_material_change *changes;
    uint32_t change_count;
    struct firn_renderer *renderers; /* linked by `next` */
};

/* Settings with which a view was drawn, for the layer `display`. */
struct lib_shown {
    struct settings settings;
    bool no_background;
};

/* Submitted view. */
struct lib_job {
    uint64_t ticket;
    struct firn_camera camera;
    struct render_result result; /* kept for the next view */
    struct lib_shown shown;
    enum status status;
    char error[LIB_MESSAGE_SIZE];
};

struct firn_renderer {
    firn_scene *scene;
    struct firn_renderer *next;
    uint32_t width, height, samples;
    char *plan; /* text of firn_renderer_plan(), or NULL */
    bool has_beauty, has_display;
    uint64_t layers;          /* bit mask of the other layers */
    struct setup_image image; /* the scene's options, with choices of this renderer */
    struct image_session session;
    uint32_t version; /* firn_scene.version of `image`; 0 if it is not set yet */
    atomic_bool is_cancelled;
    /* views in flight, guarded by `lock` */
    struct mutex lock;
    struct condition changed;
    struct thread worker;
    bool has_worker, ends;
    struct lib_job jobs[LIB_IN_FLIGHT];
    uint64_t submitted, drawn, fetched; /* numbers of views */
    uint64_t cancelled; /* number of the last view that firn_cancel() has cancelled */
};

/* ---- calls ---- */

/* State of the calling thread that a call restores. */
struct lib_call {
    firn *device; /* NULL for a call without a handle */
    struct log_sink *sink;
    const char *cache, *assets;
    struct lib_sink own; /* sink of a call without handle */
};

/* Begins a call: directs messages to the device, and waits for views in flight unless `waits` is
 * false. If `device` is NULL or belongs to another process, sets an error and returns false. */
bool lib_begin(struct lib_call *call, firn *device, bool waits);

/* Wraps the function above. Inline, because static analysers must see that a handle is not NULL
 * afterwards. */
static inline bool lib_enter(struct lib_call *call, firn *device, bool waits)
{
    return lib_begin(call, device, waits) && device;
}

/* Begins a call without handle. */
void lib_enter_alone(struct lib_call *call);

/* Ends a call and returns its result. */
firn_status lib_leave(struct lib_call *call, enum status status);

/* Returns true if the calling process opened the device. */
bool lib_is_own(const firn *device);

/* Drops a reference to a device, and frees it with the last one. */
void lib_release_device(firn *device);

/* ---- structs and strings of callers ---- */

/* Copies a struct of a caller, whose first member is its size, to `to`, whose size is `size`.
 * Members that the caller's version lacks are zero. If the struct is NULL, smaller than its size
 * member, or has nonzero members that this version does not know, logs an error that begins with
 * `what` and returns STATUS_USAGE. */
MUST_USE enum status lib_read(void *to, size_t size, const void *from, const char *what);

/* Copies `size` bytes to a caller's struct, at most as many as its `size`, but keeps its `size`. */
MUST_USE enum status lib_write(void *to, const void *from, size_t size, const char *what);

/* Returns a copy of a string that lives as long as the scene, or NULL when out of memory. */
const char *lib_keep_text(firn_scene *scene, const char *text);

/* Logs an error and returns STATUS_USAGE if an argument is NULL. */
MUST_USE static inline enum status lib_require(const void *argument, const char *name)
{
    if (argument)
        return STATUS_OK;
    log_error("%s: expected a pointer, got NULL", name);
    return STATUS_USAGE;
}

/* ---- scenes ---- */

/* Reloads the scene, or applies its settings, if they have changed. */
MUST_USE enum status lib_scene_update(firn_scene *scene);

/* Sets the image options of a loaded scene. A nonzero `samples` overrides their sample count. */
MUST_USE enum status lib_scene_image(firn_scene *scene, uint32_t samples,
                                     struct setup_image *image);

/* Closes the sessions of all renderers of a scene. */
void lib_scene_close_sessions(firn_scene *scene);

/* Marks a scene for reloading before its next use. */
void lib_scene_reload(firn_scene *scene);

void lib_release_scene(firn_scene *scene);

/* ---- materials ---- */

/* Sets the members of a material that struct firn_material has; keeps its textures. If values are
 * out of range, logs an error and returns STATUS_USAGE. */
MUST_USE enum status lib_material_read(struct material *to, const struct firn_material *from);
void lib_material_write(struct firn_material *to, const struct material *from);

/* ---- cameras ---- */

/* Reads and validates a camera; NULL stands for the scene's. */
MUST_USE enum status lib_camera_read(struct firn_camera *to, const struct firn_camera *from);

/* Converts a validated camera of any kind but FIRN_CAMERA_SCENE. */
MUST_USE enum status lib_camera_of(struct camera *camera, const struct firn_camera *from,
                                   const firn_renderer *renderer);

/* Converts a camera to the kind to->kind. Uses `from` if its kind has a matrix, otherwise
 * `camera`. */
void lib_camera_describe(struct firn_camera *to, const struct firn_camera *from,
                         const struct camera *camera, const firn_renderer *renderer);

/* ---- rendering ---- */

/* Draws a view, until renderer->is_cancelled is set. *result is {0} or an earlier view, whose
 * memory is reused. */
MUST_USE enum status lib_draw(firn_renderer *renderer, const struct firn_camera *camera,
                              struct render_result *result, firn_progress_fn *progress, void *user);

/* Updates scene and renderer, then sets the shot of a view. */
MUST_USE enum status lib_renderer_aim(firn_renderer *renderer, const struct firn_camera *camera,
                                      struct renderer_shot *shot);

/* Returns an element of an array of buffers, whose stride is the `size` of the first. */
const struct firn_buffer *lib_buffer_at(const struct firn_buffer *buffers, size_t index);

/* Returns the settings of the view that a renderer has drawn last. */
struct lib_shown lib_shown_of(const firn_renderer *renderer);

/* Validates buffers, and writes the layers to them. */
MUST_USE enum status lib_buffers_check(const firn_renderer *renderer,
                                       const struct firn_buffer *buffers, size_t count);
MUST_USE enum status lib_buffers_write(const firn_renderer *renderer,
                                       const struct firn_buffer *buffers, size_t count,
                                       const struct lib_shown *shown, struct render_result *result);

/* Returns layer `index` of firn_layer_get(), or NULL. Index 1 is `display`. */
const struct frame_layer *lib_layer(uint32_t index);

/* Ends the worker thread of a renderer, if any. */
void lib_worker_end(firn_renderer *renderer);

/* Status of a cancelled view, which only the library returns. */
#define LIB_CANCELLED ((enum status)FIRN_CANCELLED)

#endif
