/* image_session.h: draws images of one scene with one set of options: chooses camera, exposure and
 * refraction model, opens the device, poses the scene, and creates the renderer or path tracer. */
#ifndef FIRN_LIB_IMAGE_SESSION_H
#define FIRN_LIB_IMAGE_SESSION_H

#include "src/lab/reference/ray_layer_tracer.h"
#include "src/lab/reference/reference.h"
#include "src/setup/setup.h"

/* Scene whose textures and meshes may not be loaded yet. Several sessions may share it. */
struct session_scene {
    struct scene scene; /* initialised by setup_begin_scene() */
    bool is_filled;     /* textures and meshes are loaded */
    uint32_t pose;      /* number of poses so far */
};

struct image_session {
    /* set by the caller; all pointers are borrowed */
    struct setup_image *image;
    struct session_scene *scene;
    struct gpu *gpu;                     /* device; opened on demand if gpu->device is NULL */
    const struct gpu_params *gpu_params; /* parameters for opening the device */
    uint64_t layers;                     /* layers to return, as in renderer_params */
    bool linear, display, resolved;      /* images to return, as in renderer_params */
    bool prefers_start;                  /* the process draws few pixels: prefer a short start */
    bool quiet;                          /* suppress warnings about features that are not drawn */
    bool skips_exposure;                 /* do not meter, because nothing depends on the exposure */
    double noise, seconds;               /* limits of the path tracer; 0 for none */
    /* set by the functions */
    struct camera camera;                /* camera of the options, at time 0 */
    struct renderer *renderer;           /* NULL until it is created, and if `reference` draws */
    struct reference *reference;         /* NULL unless the path tracer draws */
    struct ray_layer_tracer *ray_layers; /* NULL unless layers are traced by the CPU */
    uint32_t pose;                       /* pose for which `renderer` or `reference` was created */
    bool is_wide;                        /* `renderer` draws beyond the image */
    bool is_orthographic;                /* `renderer` supports orthographic views */
    bool is_outdated;                    /* set by image_session_change() */
    bool has_warned;
};

/* Chooses the camera at time 0, the exposure and the refraction model. If the model lacks a layer
 * of *session->image, logs an error and returns STATUS_USAGE, or with --aov all, removes it. */
MUST_USE enum status image_session_choose(struct image_session *session);

/* Poses an animated model for a shot, and sets the cameras of the shot: shot->earlier, and
 * shot->camera if `sets_camera` is true. */
MUST_USE enum status image_session_pose(struct image_session *session, struct renderer_shot *shot,
                                        bool sets_camera);

/* Marks the session as outdated after a change of *session->image that does not affect the
 * scene. */
void image_session_change(struct image_session *session);

/* Creates the renderer or the path tracer. If there is one, adapts it to the image's options, the
 * present pose and a camera. */
MUST_USE enum status image_session_open(struct image_session *session, const struct camera *camera);

/* Draws a shot with the renderer or the path tracer, as renderer_render_again() does, and its
 * traced layers. */
MUST_USE enum status image_session_draw(struct image_session *session,
                                        const struct renderer_shot *shot,
                                        struct render_result *result,
                                        renderer_progress_fn *progress, void *user);

/* Adds the traced layers (ray_layer_tracer.h) to the result of a shot. Callers that do not use
 * image_session_draw() call it after drawing. */
MUST_USE enum status image_session_trace_layers(struct image_session *session,
                                                const struct renderer_shot *shot,
                                                struct render_result *result);

/* Returns true if a layer is available with a refraction model. */
bool image_session_has_layer(const struct technique *refraction, const struct frame_layer *layer);

/* Returns the name of the device that draws. */
const char *image_session_device(const struct image_session *session);

/* Destroys the renderer and the path tracer. */
void image_session_close(struct image_session *session);

#endif
