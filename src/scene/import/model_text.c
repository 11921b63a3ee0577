/* model_text.c: loads an OBJ or PLY file as a model, with warnings about what is not drawn. */
#include <stdio.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_plain.h"

static bool is_listed(const char *list, const char *words)
{
    const size_t size = strlen(words);
    for (; *list; list += strcspn(list, "\n") + 1) {
        if (strcspn(list, "\n") == size && !memcmp(list, words, size))
            return true;
    }
    return false;
}

void plain_note(char list[static PLAIN_LIST_SIZE], const char *words)
{
    static const char more[] = "...";
    const size_t length = strlen(list);
    const bool has_room = length + strlen(words) + sizeof(more) + 2 <= PLAIN_LIST_SIZE;
    if (!is_listed(list, more) && !is_listed(list, words))
        (void)snprintf(&list[length], PLAIN_LIST_SIZE - length, "%s\n", has_room ? words : more);
}

static void warn(const struct model_import *import, const char *of_what, const char *list)
{
    char text[2 * PLAIN_LIST_SIZE];
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
        plain_note(plain.undrawn, "vertex colours"); /* ice shows none */
    if (status == STATUS_OK && import->missed[0])
        log_warning("%s: refers to %s, which does not exist; its materials are left out",
                    import->path, import->missed);
    if (status == STATUS_OK) {
        warn(import, " of its materials", plain.undrawn_materials);
        warn(import, "", plain.undrawn);
        (void)snprintf(model->undrawn_words, sizeof(model->undrawn_words), "%s%s",
                       plain.undrawn_materials, plain.undrawn);
    }
    plain_finish(&plain);
    return status;
}
