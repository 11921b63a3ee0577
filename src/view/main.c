/* main.c: entry point of firn-view, the program that `firn view` starts. */
#include "src/app/standard_streams.h"
#include "src/scene/import/decode.h"
#include "src/view/view.h"

int main(int argc, char **argv)
{
    struct app_options options;
    bool done;
    if (reader_is_wanted(argc, argv))
        return decode_main(argc, argv);
    standard_streams_begin();
    enum status status = app_parse(&options, APP_VIEW, argc - 1, argv + 1, &done);
    if (status == STATUS_OK && !done && !options.view.session)
        status = app_need_scene(&options.picture.scene);
    if (status == STATUS_OK && !done)
        status = view_run(&options);
    return (int)standard_streams_end(status);
}
