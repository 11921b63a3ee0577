/* image_session.h: draws images of one scene with one set of options: chooses camera, exposure and
 * refraction model, opens the device, poses the scene, and creates the renderer or path tracer. */
#ifndef FIRN_LIB_IMAGE_SESSION_H
#define FIRN_LIB_IMAGE_SESSION_H

#include "src/lab/reference/reference.h"
#include "src/setup/setup.h"

/* Scene whose slow part may not be loaded yet. Several sessions may draw it. */
struct session_scene {
    struct scene scene; /* by setup_begin_scene() */
    bool is_filled;     /* textures and meshes are filled */
    uint32_t pose;      /* number of poses so far */
};

struct image_session {
    /* set by the caller; all pointers are borrowed */
    struct setup_image *image;
    struct session_scene *scene;
    struct gpu *gpu;                     /* opened when needed if gpu->device is NULL */
    const struct gpu_params *gpu_params; /* of the device to open */
    uint64_t layers;                     /* returned layers, as in renderer_params */
    bool linear, display, resolved;      /* returned images, as in renderer_params */
    bool prefers_start;                  /* few pixels are drawn by the process */
    bool quiet;                          /* log no warnings about what is not drawn */
    bool skips_exposure;                 /* nothing depends on the exposure, so meter none */
    double noise, seconds;               /* limits of the path tracer; 0 for none */
    /* set by the functions */
    struct camera camera;        /* of the options, at time 0 */
    struct renderer *renderer;   /* NULL until it is opened, and if `reference` draws */
    struct reference *reference; /* NULL unless the path tracer draws */
    uint32_t pose;               /* pose of `renderer` or `reference` */
    bool is_wide;                /* `renderer` draws beyond the image */
    bool is_orthographic;        /* `renderer` draws orthographic views */
    bool is_outdated;            /* by image_session_change() */
    bool has_warned;
};

/* Chooses the camera at time 0, the exposure and the refraction model. */
MUST_USE enum status image_session_choose(struct image_session *session);

/* Poses an animated model for a shot, and sets the cameras of the shot: shot->earlier, and
 * shot->camera if `sets_camera` is true. */
MUST_USE enum status image_session_pose(struct image_session *session, struct renderer_shot *shot,
                                        bool sets_camera);

/* Notes that *session->image has changed, but not its scene. */
void image_session_change(struct image_session *session);

/* Creates the renderer or the path tracer, or adapts it to the image's options, the present pose
 * and a camera, unless it fits. */
MUST_USE enum status image_session_open(struct image_session *session, const struct camera *camera);

/* Draws a shot with the renderer or the path tracer, as renderer_render() does. */
MUST_USE enum status image_session_draw(struct image_session *session,
                                        const struct renderer_shot *shot,
                                        struct render_result *result,
                                        renderer_progress_fn *progress, void *user);

/* Returns the name of the device that draws. */
const char *image_session_device(const struct image_session *session);

/* Destroys the renderer and the path tracer. */
void image_session_close(struct image_session *session);

#endif
