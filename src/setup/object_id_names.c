/* object_id_names.c: lists the names of the IDs in the layers `object` and `material`. */
#include "src/setup/object_id_names.h"
#include <stdio.h>
#include <stdlib.h>
#include "src/base/text_stream.h"

/* Prints a line with an ID and a name. Control characters in the name are replaced. */
static void print_line(FILE *out, uint32_t number, const char *name, const char *else_name)
{
    fprintf(out, "%u ", number);
    for (const char *c = name[0] ? name : else_name; *c; c++)
        fputc((unsigned char)*c < ' ' ? ' ' : *c, out);
    fputc('\n', out);
}

char *object_names(const struct scene *scene)
{
    const struct model *model = &scene->model;
    const uint32_t first = model->object_count + 1;
    struct text_stream stream;
    FILE *out = text_stream_open(&stream);
    if (!out)
        return NULL;
    for (uint32_t i = 0; i < model->object_count; i++)
        print_line(out, i + 1, model->objects[i].name, "object");
    if (model->surroundings.index_count)
        print_line(out, first, "", "surroundings");
    for (uint32_t i = 0; i < model->surroundings_object_count; i++)
        print_line(out, first + 1 + i, model->surroundings_names[i], "object");
    return text_stream_close(&stream, NULL);
}

char *material_names(const struct scene *scene)
{
    struct text_stream stream;
    FILE *out = text_stream_open(&stream);
    if (!out)
        return NULL;
    for (uint32_t i = 0; i < scene->model.material_count; i++)
        print_line(out, i + 1, scene->model.materials[i].name, "material");
    return text_stream_close(&stream, NULL);
}
