/* firn_view.c: entry point of firn-view, the program that `firn view` starts. */
#include "src/app/app.h"
#include "src/base/standard_streams.h"
#include "src/gpu/gpu_fallback.h"
#include "src/scene/import/sandboxed_load.h"
#include "src/view/viewer.h"

int main(int argc, char **argv)
{
    struct app_options options;
    bool done;
    if (reader_is_child(argc, argv))
        return sandboxed_load_main(argc, argv);
    standard_streams_begin();
    gpu_fallback_prepare();
    enum status status = app_parse(&options, APP_VIEW, argc - 1, argv + 1, &done);
    if (!options.image.scene.name && !options.window.session)
        options.image.scene.name = "ice-cube";
    if (status == STATUS_OK && !done)
        status = viewer_run(&(struct viewer_params){ .image = &options.image,
                                                     .window = &options.window,
                                                     .outputs = &options.run.outputs,
                                                     .gpu = options.run.gpu,
                                                     .quiet = options.run.quiet });
    return (int)standard_streams_end(status);
}
