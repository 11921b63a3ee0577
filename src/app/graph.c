/* graph.c: firn graph: the compiled plan of a frame, without a device. */
#include <stdio.h>
#include "src/app/app.h"
#include "src/frame/plan.h"
#include "src/render/renderer.h"

typedef void dump_fn(const struct rg_plan *plan, FILE *out);

static dump_fn *const dumps[APP_FORMAT_COUNT] = {
    [APP_FORMAT_TEXT] = rg_dump,
    [APP_FORMAT_DOT] = rg_dump_dot,
    [APP_FORMAT_JSON] = rg_dump_json,
    [APP_FORMAT_HTML] = rg_dump_html,
};

enum status app_graph(const struct app_options *given)
{
    struct app_options o = *given;
    struct scene scene;
    struct frame_plan frame = { 0 };
    enum status status = app_load_scene(&scene, &o);
    if (status != STATUS_OK)
        return status;
    status = renderer_plan(&frame, &(struct renderer_params){
                                       .scene = &scene,
                                       .settings = &o.settings,
                                       .rung = o.rung,
                                       .width = o.width,
                                       .height = o.height,
                                       .samples = o.samples,
                                       .layers = o.layers,
                                       .linear = true,
                                       .display = true,
                                       .sharing = o.sharing,
                                   });
    if (status == STATUS_OK)
        dumps[o.format](frame.plan, stdout);
    frame_plan_finish(&frame);
    scene_finish(&scene);
    return status;
}
