/* model_text.c: reads a file of .obj or .ply. */
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_plain.h"

static enum status refuse_outside(const struct model_import *import)
{
    log_error("%s: refers to %s: expected only files within the model's folder", import->path,
              import->refused);
    return STATUS_DATA;
}

enum status model_load_plain(struct model_import *import, const char *suffix, struct model *model,
                             enum model_part everything_is)
{
    struct plain plain = { .import = import };
    enum status status = strcmp(suffix, "ply") == 0 ? ply_read(&plain) : obj_read(&plain);
    if (status == STATUS_OK && import->refused[0])
        status = refuse_outside(import);
    if (status == STATUS_OK)
        status = plain_build(&plain, model, everything_is);
    if (status == STATUS_OK && import->missed[0])
        log_warning("%s: refers to %s, which does not exist; its materials are left out",
                    import->path, import->missed);
    if (status == STATUS_OK && plain.undrawn[0])
        log_warning("%s: not drawn of its materials: %s", import->path, plain.undrawn);
    if (status == STATUS_OK && (plain.has_lines || plain.has_free_form))
        log_warning("%s: not drawn: %s%s%s", import->path,
                    plain.has_lines ? "points and lines" : "",
                    plain.has_lines && plain.has_free_form ? ", " : "",
                    plain.has_free_form ? "curves and surfaces in free form" : "");
    plain_finish(&plain);
    return status;
}
