/* model_text.c: reads a file of .obj or .ply. */
#include <stdio.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_plain.h"

static bool is_listed(const char *list, const char *words)
{
    const size_t size = strlen(words);
    for (const char *at = list; (at = strstr(at, words)); at += size) {
        const bool begins = at == list || (at - list >= 2 && at[-2] == ',');
        if (begins && (at[size] == ',' || at[size] == '\0'))
            return true;
    }
    return false;
}

void plain_note(char list[static PLAIN_LIST_SIZE], const char *words)
{
    static const char more[] = ", ...";
    const size_t length = strlen(list), size = strlen(words) + sizeof(", ");
    const bool is_full = length > strlen(more) && !strcmp(&list[length - strlen(more)], more);
    if (is_full || is_listed(list, words))
        return;
    const bool has_room = length + size + strlen(more) <= PLAIN_LIST_SIZE;
    (void)snprintf(&list[length], PLAIN_LIST_SIZE - length, "%s%s",
                   has_room && length > 0 ? ", " : "", has_room ? words : more);
}

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
    if (plain.colors && plain.material_count == 0 && everything_is == MODEL_BY_MATERIALS)
        plain_note(plain.undrawn, "colours of vertices"); /* all is ice, though nobody asked */
    if (status == STATUS_OK && import->missed[0])
        log_warning("%s: refers to %s, which does not exist; its materials are left out",
                    import->path, import->missed);
    if (status == STATUS_OK && plain.undrawn_materials[0])
        log_warning("%s: not drawn of its materials: %s", import->path, plain.undrawn_materials);
    if (status == STATUS_OK && plain.undrawn[0])
        log_warning("%s: not drawn: %s", import->path, plain.undrawn);
    plain_finish(&plain);
    return status;
}
