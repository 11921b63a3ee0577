/* traced_scene.c: prepares a scene for ray tracing on the CPU with Embree. */
#include "src/lab/reference/traced_scene.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/lab/reference/whitted.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/scene/environment/image_based_lighting.h"
#include "src/settings/scene_settings.h"
#include "src/tech/lighting/ice_caustics.h"
#include "src/tech/output/first_surface.h"

enum {
    EXPECTED_STEP = 16, /* stride of environment map texels in expected_radiance */
};

#define EXPECTED_MAX \
    4.0f /* upper limit of expected_radiance, so that the sun does not dominate it */

enum status traced_scene_open_device(RTCDevice *device)
{
    *device = rtcNewDevice(NULL);
    if (*device)
        return STATUS_OK;
    const bool is_old = rtcGetDeviceError(NULL) == RTC_ERROR_UNSUPPORTED_CPU;
    log_error("ray tracing on the CPU: %s",
              is_old ? "expected a CPU with SSE4.2, which Embree needs; choose another refraction "
                       "model and no traced layers (firn list layers)"
                     : "out of memory");
    return is_old ? STATUS_NO_DEVICE : STATUS_TRY_AGAIN;
}

static uint64_t memory_limit(uint64_t stated)
{
    const uint64_t limit = machine_memory_limit();
    if (stated)
        return stated;
    uint64_t memory = machine_memory();
    if (!memory)
        memory = UINT64_MAX;
    return limit && limit < memory ? limit : memory;
}

static struct tracer tracing_of(const struct traced_scene *t)
{
    const struct settings *settings = t->params.settings;
    const struct reference_params *params = settings_of(settings, &reference_settings);
    struct tracer tracing = {
        .embree_scene = &t->embree_scene,
        .radiance = &t->radiance,
        .media = &t->media,
        .inclusions = &t->inclusions,
        .pool_scene = t->params.scene->has_pool ? &t->pool_scene : NULL,
        .earlier = &t->earlier,
        .expected_radiance = glms_vec3_minv(radiance_mean(&t->radiance, EXPECTED_STEP),
                                            glms_vec3_fill(EXPECTED_MAX)),
        .guide = image_based_lighting_dominant_cone(&t->radiance.scene->background.environment,
                                                    t->radiance.scene->background.prefiltered),
        .params = *params,
    };
    for (uint32_t i = 0; i < t->radiance.scene->inclusions.media.count; i++) {
        const struct volume_scattering volume_scattering =
            volume_scattering_of(&t->radiance, settings, i);
        if (volume_scattering.majorant > 0.0f)
            tracing.scattering_media[tracing.scattering_media_count++] = volume_scattering;
    }
    return tracing;
}

/* Replaces a pool in the scene by triangle meshes. Returns false when out of memory. */
static bool build_pool(struct traced_scene *t, struct frame_view *view)
{
    if (!view->scene->has_pool)
        return true;
    if (!pool_scene_init(&t->pool_scene, view->scene, view->settings, &t->globals))
        return false;
    view->scene = &t->pool_scene.scene;
    t->globals = frame_view_globals(view, &t->camera_rays.push);
    t->globals.world_from_object = glms_mat4_identity(); /* the ice is in world space */
    return true;
}

/* Sets the camera, the time, and the transforms of objects now and in the previous frame. */
static struct frame_view set_view(struct traced_scene *t, const struct renderer_shot *shot)
{
    const struct traced_scene_params *params = &t->params;
    struct frame_view view = {
        .scene = params->scene,
        .settings = params->settings,
        .camera = shot->camera,
        .time = shot->time,
        .width = params->width,
        .height = params->height,
    };
    t->camera_rays = camera_rays_of(&view, params->filter);
    t->globals = frame_view_globals(&view, &t->camera_rays.push);
    view.previous_clip_from_world = frame_view_previous_clip_from_world(&view, &shot->earlier);
    first_surface_write(&t->earlier, &view, &t->globals);
    return view;
}

/* Initialises camera, media and lighting. Returns false when out of memory. */
static bool prepare(struct traced_scene *t, const struct renderer_shot *shot)
{
    const struct scene *scene = t->params.scene;
    const struct settings *settings = t->params.settings;
    struct frame_view view = set_view(t, shot);
    if (!build_pool(t, &view) || !nested_media_init(&t->media, view.scene, settings))
        return false;
    if (scene->has_pool)
        pool_scene_set_media(&t->pool_scene, scene, settings, &t->media);
    const struct ground_params *ground = settings_of(settings, &ground_settings);
    t->radiance = radiance_of(view.scene, &t->globals);
    t->radiance.is_traced = ground->light == GROUND_TRACED;
    const struct ice_caustics_params *sun = settings_of(settings, &ice_caustics_settings);
    const bool is_mapped = !scene->has_pool && ice_caustics.is_on(settings);
    t->radiance.hides_sun = t->radiance.is_traced || (is_mapped && sun->ground);
    t->inclusions = inclusions_of(&t->radiance, settings);
    t->tracing = tracing_of(t);
    return true;
}

enum status traced_scene_init(struct traced_scene *traced, const struct traced_scene_params *params,
                              const struct renderer_shot *shot)
{
    *traced = (struct traced_scene){ .params = *params };
    if (!prepare(traced, shot))
        return log_out_of_memory("objects");
    return embree_scene_init(&traced->embree_scene, params->device, &traced->radiance,
                             memory_limit(params->memory));
}

static bool is_equal(const mat4s *a, const mat4s *b)
{
    for (int i = 0; i < 16; i++) {
        if (fabsf(a->raw[i / 4][i % 4] - b->raw[i / 4][i % 4]) > 0.0f)
            return false;
    }
    return true;
}

bool traced_scene_set_shot(struct traced_scene *traced, const struct renderer_shot *shot)
{
    const mat4s objects = traced->globals.world_from_object;
    const mat4s movers = traced->globals.world_from_movers;
    if (traced->params.scene->has_pool)
        return false;
    set_view(traced, shot);
    return is_equal(&objects, &traced->globals.world_from_object) &&
           is_equal(&movers, &traced->globals.world_from_movers);
}

void traced_scene_finish(struct traced_scene *traced)
{
    nested_media_finish(&traced->media);
    embree_scene_finish(&traced->embree_scene);
    pool_scene_finish(&traced->pool_scene);
}
