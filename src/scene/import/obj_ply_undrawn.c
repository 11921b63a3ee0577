/* obj_ply_undrawn.c: list of the contents of an OBJ, MTL or PLY file that are not drawn. */
#include <stdio.h>
#include <string.h>
#include "src/scene/import/obj_ply.h"

static bool is_listed(const char *list, const char *words)
{
    const size_t size = strlen(words);
    for (; *list; list += strcspn(list, "\n") + 1) {
        if (strcspn(list, "\n") == size && !memcmp(list, words, size))
            return true;
    }
    return false;
}

void obj_ply_note_undrawn(char list[static OBJ_PLY_LIST_SIZE], const char *words)
{
    static const char more[] = "...";
    const size_t length = strlen(list);
    const bool has_room = length + strlen(words) + sizeof(more) + 2 <= OBJ_PLY_LIST_SIZE;
    if (!is_listed(list, more) && !is_listed(list, words))
        (void)snprintf(&list[length], OBJ_PLY_LIST_SIZE - length, "%s\n", has_room ? words : more);
}
