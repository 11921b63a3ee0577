/* obj_ply.c: functions that the readers of OBJ, MTL and PLY files share. */
#include "src/scene/import/obj_ply.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/file_info.h"
#include "src/base/log.h"

void *obj_ply_array_grow(struct obj_ply_array *array, size_t count, size_t item_size)
{
    size_t capacity = array->room > 0 ? array->room : 64;
    while (capacity - array->count < count) {
        if (capacity > SIZE_MAX / 2 / item_size)
            return NULL;
        capacity *= 2;
    }
    void *items = realloc(array->items, capacity * item_size);
    if (!items)
        return NULL;
    array->items = items;
    array->room = capacity;
    array->count += count;
    return (char *)items + (array->count - count) * item_size;
}

char *obj_ply_read_file(struct model_import *import, const char *path, size_t *size, bool *is_found)
{
    FILE *file = model_file_open(import, path);
    char *bytes = NULL;
    const struct file_info info =
        file ? file_info_of_open(file) : (struct file_info){ .kind = FILE_MISSING };
    *is_found = info.kind != FILE_MISSING;
    if (!*is_found) {
        if (file)
            fclose(file);
        return NULL;
    }
    const size_t size_max = info.size > 0 ? (size_t)info.size : 0;
    bytes = malloc(size_max + 1);
    if (bytes) {
        *size = fread(bytes, 1, size_max, file);
        bytes[*size] = '\0';
    } else {
        (void)log_out_of_memory(path);
    }
    if (bytes && ferror(file)) {
        log_error("%s: %s", path, strerror(errno));
        free(bytes);
        bytes = NULL;
    }
    fclose(file);
    return bytes;
}

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
