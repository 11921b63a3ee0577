/* request.c: what a renderer's plans are to draw and bring back. */
#include "src/render/request.h"
#include "src/render/uploaded_scene.h"

bool renderer_is_interleaved(const struct renderer_params *params)
{
    return params->interleaved && params->columns * params->rows > 1;
}

struct tiling renderer_tiling(const struct renderer_params *params)
{
    const bool parts = !params->interleaved;
    return (struct tiling){
        .width = params->width,
        .height = params->height,
        .columns = parts && params->columns ? params->columns : 1,
        .rows = parts && params->rows ? params->rows : 1,
    };
}

struct frame_request renderer_picture_request(const struct renderer_params *params)
{
    const bool many = params->samples > 1;
    const struct tiling tiling = renderer_tiling(params);
    struct frame_request request = {
        .list = frame_with(params->rung, params->settings, params->scene->is_convex),
        .view = { params->width, params->height },
        .layers = params->layers,
        .beauty = params->linear || (params->display && many),
        .display = params->display && !many,
        .keep_display = params->keep,
        .sharing = params->sharing,
    };
    if (tiling.columns * tiling.rows > 1)
        request.part = (VkExtent2D){ tile_largest(&tiling).width, tile_largest(&tiling).height };
    uploaded_scene_describe(params->scene, &request);
    return request;
}

struct frame_request renderer_capture_request(const struct renderer_params *params)
{
    struct frame_request request = {
        .list = frame_capture(),
        .view = { params->width, params->height },
        .keep_cube = true,
        .sharing = params->sharing,
    };
    uploaded_scene_describe(params->scene, &request);
    return request;
}

/* A view as large as a face. */
struct frame_request renderer_bake_request(const struct renderer_params *params)
{
    struct frame_request request = {
        .list = frame_bake(),
        .view = { params->width, params->height },
        .cube_back = true,
        .sharing = params->sharing,
    };
    uploaded_scene_describe(params->scene, &request);
    return request;
}

/* Of a picture as large as the largest tile. */
struct frame_request renderer_resolve_request(const struct renderer_params *params)
{
    const struct tiling tiling = renderer_tiling(params);
    const struct tile largest = tile_largest(&tiling);
    return (struct frame_request){
        .list = frame_resolve(),
        .view = { largest.width, largest.height },
        .display = true,
        .sharing = params->sharing,
    };
}

enum status renderer_plan(struct frame_plan *plan, const struct renderer_params *params)
{
    const struct frame_request request = renderer_picture_request(params);
    return frame_plan_init(plan, &request);
}
