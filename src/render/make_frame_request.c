/* make_frame_request.c: translates renderer params into frame requests. */
#include "src/render/make_frame_request.h"
#include "src/render/denoise.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/scene/scene.h"
#include "src/settings/scene_settings.h"
#include "src/tech/technique.h"

void renderer_set_camera(struct renderer_params *params, const struct camera *camera)
{
    const struct frame_view view = {
        .scene = params->scene,
        .settings = params->settings,
        .camera = *camera,
        .width = params->width,
        .height = params->height,
    };
    params->is_orthographic = camera->height > 0.0f;
    params->may_exceed_image = frame_view_exceeds_image(&view);
}

bool renderer_is_interleaved(const struct renderer_params *params)
{
    return params->interleaved && params->columns * params->rows > 1;
}

struct tiling renderer_tiling(const struct renderer_params *params)
{
    const bool is_tiled = !params->interleaved;
    return (struct tiling){
        .width = params->width,
        .height = params->height,
        .columns = is_tiled && params->columns ? params->columns : 1,
        .rows = is_tiled && params->rows ? params->rows : 1,
    };
}

/* Returns true if the image may be denoised: it is read back, drawn whole, and has few samples.
 * Images with many samples must equal progressive rendering, which does not denoise. */
static bool should_denoise(const struct renderer_params *params)
{
    const struct ground_params *ground = settings_of(params->settings, &ground_settings);
    const bool is_read = params->linear || params->resolved || params->display;
    const bool is_kept = params->keep || params->scales || params->refines;
    const bool is_few = params->is_adaptive || params->samples < DENOISE_SAMPLES_ENOUGH;
    return params->refraction && params->refraction->refraction.traces_bvh && ground->denoise &&
           is_few && is_read && !is_kept && params->columns * params->rows <= 1;
}

static struct technique_config choose(const struct renderer_params *params,
                                      enum technique_purpose purpose)
{
    struct technique_config config = {
        .settings = params->settings,
        .purpose = purpose,
        .refraction = params->refraction,
        .scene = params->scene,
        .may_exceed_image = purpose == TECHNIQUE_IMAGE && params->may_exceed_image,
        .uses_queries = params->gpu && params->gpu->has_rays, /* `firn graph` has no device */
        .has_fast_queries =
            params->gpu && params->gpu->properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU,
        .object_count = params->scene->has_pool ? 0 : params->scene->model.object_count,
        .denoises_light = purpose == TECHNIQUE_IMAGE && should_denoise(params),
    };
    if (params->refraction && params->refraction->refraction.choose)
        params->refraction->refraction.choose(&config);
    return config;
}

bool renderer_denoises(const struct renderer_params *params)
{
    return choose(params, TECHNIQUE_IMAGE).denoises_light;
}

bool renderer_draws_beyond_image(const struct renderer_params *params)
{
    return choose(params, TECHNIQUE_IMAGE).is_wide;
}

struct frame_request renderer_image_request(const struct renderer_params *params)
{
    const bool many = params->samples > 1 || params->refines || renderer_denoises(params);
    const bool scales = params->scales || params->refines;
    const struct tiling tiling = renderer_tiling(params);
    struct frame_request request = {
        .config = choose(params, TECHNIQUE_IMAGE),
        .face_size = params->face_size,
        .view = { params->width, params->height },
        .layers = params->layers,
        .max_view = scales ? (VkExtent2D){ params->width, params->height } : (VkExtent2D){ 0 },
        .beauty =
            params->linear || params->resolved || params->refines || (params->display && many),
        .display = params->display && !many,
        .keep_display = params->keep,
        .sharing = params->sharing,
    };
    if (tiling.columns * tiling.rows > 1)
        request.max_region =
            (VkExtent2D){ tile_largest(&tiling).width, tile_largest(&tiling).height };
    return request;
}

struct frame_request renderer_capture_request(const struct renderer_params *params)
{
    return (struct frame_request){
        .config = choose(params, TECHNIQUE_CAPTURE),
        .face_size = params->face_size,
        .view = { params->width, params->height },
        .keep_cube = true,
        .sharing = params->sharing,
    };
}

/* Returns the request for tone-mapping. The view has the size of the largest tile. */
struct frame_request renderer_resolve_request(const struct renderer_params *params)
{
    const struct tiling tiling = renderer_tiling(params);
    const struct tile largest = tile_largest(&tiling);
    return (struct frame_request){
        .config = choose(params, TECHNIQUE_RESOLVE),
        .view = { largest.width, largest.height },
        .display = params->display,
        .keep_display = params->keep,
        .sharing = params->sharing,
    };
}

enum status renderer_plan(struct frame_plan *plan, const struct renderer_params *params)
{
    const struct frame_request request = renderer_image_request(params);
    return frame_plan_init(plan, &request);
}
