/* obj_ply_load.c: loads an OBJ, PLY or STL file as a model, and warns about what is not drawn. */
#include <stdio.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/obj_ply.h"

static void warn(const struct model_import *import, const char *of_what, const char *list)
{
    char text[2 * OBJ_PLY_LIST_SIZE];
    size_t length = 0;
    for (; *list; list += strcspn(list, "\n") + 1)
        length += (size_t)snprintf(&text[length], sizeof(text) - length, "%s%.*s",
                                   length > 0 ? ", " : "", (int)strcspn(list, "\n"), list);
    if (length > 0)
        log_warning("%s: not drawn%s: %s", import->path, of_what, text);
}

static enum status refuse_outside(const struct model_import *import)
{
    log_error("%s: refers to %s: expected only files within the model's folder", import->path,
              import->refused_file);
    return STATUS_DATA;
}

enum status model_load_obj_ply(struct model_import *import, const char *suffix, struct model *model,
                               enum model_role default_role)
{
    struct obj_ply obj_ply = { .import = import };
    enum status status = strcmp(suffix, "ply") == 0   ? ply_read(&obj_ply)
                         : strcmp(suffix, "stl") == 0 ? stl_read(&obj_ply)
                                                      : obj_read(&obj_ply);
    if (status == STATUS_OK && import->refused_file[0])
        status = refuse_outside(import);
    if (status == STATUS_OK)
        status = obj_ply_build(&obj_ply, model, default_role);
    if (obj_ply.colors && obj_ply.material_count == 0 && default_role == MODEL_BY_MATERIALS)
        obj_ply_note_undrawn(obj_ply.undrawn, "vertex colours"); /* ice shows no vertex colours */
    if (status == STATUS_OK && import->missing_file[0])
        log_warning("%s: refers to %s, which does not exist; its materials are left out",
                    import->path, import->missing_file);
    if (status == STATUS_OK) {
        warn(import, " of its materials", obj_ply.undrawn_materials);
        warn(import, "", obj_ply.undrawn);
        (void)snprintf(model->undrawn_text, sizeof(model->undrawn_text), "%s%s",
                       obj_ply.undrawn_materials, obj_ply.undrawn);
    }
    obj_ply_finish(&obj_ply);
    return status;
}
