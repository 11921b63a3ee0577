/* traced_scene.h: a scene prepared for ray tracing on the CPU: camera, Embree scene, media. */
#ifndef FIRN_LAB_REFERENCE_TRACED_SCENE_H
#define FIRN_LAB_REFERENCE_TRACED_SCENE_H

#include "shaders/output/first_surface.h"
#include "src/lab/reference/camera_rays.h"
#include "src/lab/reference/pool_scene.h"
#include "src/lab/reference/tracer_context.h"
#include "src/render/renderer.h"

struct traced_scene_params {
    const struct scene *scene;
    const struct settings *settings;
    uint32_t width, height; /* pixels */
    enum pixel_filter filter;
    RTCDevice device;
    uint64_t memory; /* triangle memory limit, bytes; 0 for RAM */
};

/* Contains pointers to itself, so it must not be moved after traced_scene_init(). */
struct traced_scene {
    struct traced_scene_params params;
    struct radiance radiance;
    struct globals globals;
    struct camera_rays camera_rays;
    struct first_surface_previous earlier;
    struct embree_scene embree_scene;
    struct nested_media media;
    struct inclusions inclusions;
    struct pool_scene pool_scene;
    struct tracer tracing; /* without photons; the caller may change it */
};

/* Creates an Embree device. If the CPU is too old or memory is short, logs an error and returns
 * STATUS_NO_DEVICE or STATUS_TRY_AGAIN. */
MUST_USE enum status traced_scene_open_device(RTCDevice *device);

/* Prepares a scene for the camera and time of a shot. Scene and settings are borrowed. On failure,
 * logs an error; the caller calls traced_scene_finish() even then. */
MUST_USE enum status traced_scene_init(struct traced_scene *traced,
                                       const struct traced_scene_params *params,
                                       const struct renderer_shot *shot);

/* Changes the camera and time. Returns false if the Embree scene must be built again, because
 * objects have moved or a pool has waves. */
bool traced_scene_set_shot(struct traced_scene *traced, const struct renderer_shot *shot);

void traced_scene_finish(struct traced_scene *traced); /* accepts {0} */

#endif
