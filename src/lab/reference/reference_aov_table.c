/* reference_aov_table.c: maps image planes to values of a traced ray; needs no Embree. */
#include "src/lab/reference/reference_aov_table.h"
#include <stdio.h>
#include <string.h>
#include "src/tech/techniques.h"

#define VALUE(name, field) \
    { \
        (name), offsetof(struct reference_ray_values, field) \
    }

static const struct {
    const char *plane;
    size_t offset;
} planes[] = {
    VALUE("R", color.x),
    VALUE("G", color.y),
    VALUE("B", color.z),
    VALUE("A", alpha),
    VALUE("Z", z),
    VALUE("N.X", normal.x),
    VALUE("N.Y", normal.y),
    VALUE("N.Z", normal.z),
    VALUE("P.X", position.x),
    VALUE("P.Y", position.y),
    VALUE("P.Z", position.z),
    VALUE("exit.X", exit.x),
    VALUE("exit.Y", exit.y),
    VALUE("exit.Z", exit.z),
    VALUE("path.Z", path),
    VALUE("bounces.Z", bounces),
    VALUE("tir.Z", tir),
    VALUE("inclusions.Z", inclusion_bits),
    VALUE("refraction.R", refraction.x),
    VALUE("refraction.G", refraction.y),
    VALUE("refraction.B", refraction.z),
    VALUE("reflection.R", reflection.x),
    VALUE("reflection.G", reflection.y),
    VALUE("reflection.B", reflection.z),
    VALUE("fresnel.Z", fresnel),
    VALUE("remaining.R", remaining.x),
    VALUE("remaining.G", remaining.y),
    VALUE("remaining.B", remaining.z),
    VALUE("albedo.R", albedo.x),
    VALUE("albedo.G", albedo.y),
    VALUE("albedo.B", albedo.z),
    VALUE("object.Z", object),
    VALUE("object.last.Z", last),
    VALUE("motion.X", motion.x),
    VALUE("motion.Y", motion.y),
};

size_t reference_layers_find(const char *plane)
{
    for (size_t i = 0; i < sizeof(planes) / sizeof(planes[0]); i++) {
        if (!strcmp(planes[i].plane, plane))
            return planes[i].offset / sizeof(float);
    }
    return strcmp(plane, "error.Z") != 0 ? REFERENCE_RAY_VALUE_NONE : REFERENCE_RAY_VALUE_ERROR;
}

const char *reference_layers_plane(size_t index)
{
    for (size_t i = 0; i < sizeof(planes) / sizeof(planes[0]); i++) {
        if (planes[i].offset / sizeof(float) == index)
            return planes[i].plane;
    }
    return NULL;
}

bool reference_has_layer(const struct frame_layer *layer)
{
    return reference_layers_find(layer->planes[0]) != REFERENCE_RAY_VALUE_NONE;
}

static void add_name(char *names, size_t size, const char *name, bool is_on)
{
    const size_t used = strlen(names);
    if (is_on)
        snprintf(&names[used], size - used, "%s%s", used ? ", " : "", name);
}

bool reference_unsupported(const struct settings *settings, char *names, size_t size)
{
    names[0] = '\0';
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_on && !(*t)->is_traced)
            add_name(names, size, (*t)->title ? (*t)->title : (*t)->name, (*t)->is_on(settings));
    }
    return names[0] != '\0';
}
