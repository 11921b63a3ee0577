/* cmd_graph.c: command firn graph: prints the compiled plan of a frame, without a device. */
#include <stdio.h>
#include "src/app/app.h"
#include "src/render/frame/compile_frame_plan.h"
#include "src/render/make_frame_request.h"

typedef void dump_fn(const struct rg_plan *plan, FILE *out);

static dump_fn *const dumps[APP_FORMAT_COUNT] = {
    [APP_FORMAT_TEXT] = rg_dump,
    [APP_FORMAT_JSON] = rg_dump_json,
    [APP_FORMAT_HTML] = rg_dump_html,
};

enum status app_graph(const struct app_options *o)
{
    struct setup_image p = o->image;
    struct scene scene;
    struct frame_plan frame = { 0 };
    struct camera camera;
    enum status status = setup_begin_scene(&scene, &p.scene); /* a plan needs no texels */
    if (status != STATUS_OK)
        return status;
    status = setup_camera(&camera, &scene, &p);
    if (status != STATUS_OK) {
        scene_finish(&scene);
        return status;
    }
    setup_choose_refraction(&p, &scene, &camera);
    struct renderer_params params = setup_renderer_params(&p, NULL, &scene);
    renderer_set_camera(&params, &camera);
    params.samples = p.samples;
    params.layers = p.layers;
    params.linear = true;
    params.display = true;
    status = renderer_plan(&frame, &params);
    if (status == STATUS_OK)
        dumps[o->run.format](frame.plan, stdout);
    frame_plan_finish(&frame);
    scene_finish(&scene);
    return status;
}
