/* reference_layers.c: maps image planes to the values of a traced ray; also built without Embree.
 */
#include "src/reference/reference_layers.h"
#include <stdio.h>
#include <string.h>
#include "src/tech/techniques.h"

#define SEEN(name, field) \
    { \
        (name), offsetof(struct reference_ray_values, field) \
    }

static const struct {
    const char *plane;
    size_t offset;
} planes[] = {
    SEEN("R", color.x),
    SEEN("G", color.y),
    SEEN("B", color.z),
    SEEN("A", alpha),
    SEEN("Z", z),
    SEEN("N.X", normal.x),
    SEEN("N.Y", normal.y),
    SEEN("N.Z", normal.z),
    SEEN("P.X", position.x),
    SEEN("P.Y", position.y),
    SEEN("P.Z", position.z),
    SEEN("exit.X", exit.x),
    SEEN("exit.Y", exit.y),
    SEEN("exit.Z", exit.z),
    SEEN("path.Z", path),
    SEEN("bounces.Z", bounces),
    SEEN("tir.Z", tir),
    SEEN("inclusions.Z", met),
    SEEN("refraction.R", refraction.x),
    SEEN("refraction.G", refraction.y),
    SEEN("refraction.B", refraction.z),
    SEEN("reflection.R", reflection.x),
    SEEN("reflection.G", reflection.y),
    SEEN("reflection.B", reflection.z),
    SEEN("fresnel.Z", fresnel),
    SEEN("remaining.R", remaining.x),
    SEEN("remaining.G", remaining.y),
    SEEN("remaining.B", remaining.z),
    SEEN("albedo.R", albedo.x),
    SEEN("albedo.G", albedo.y),
    SEEN("albedo.B", albedo.z),
    SEEN("object.Z", object),
    SEEN("object.last.Z", last),
    SEEN("motion.X", motion.x),
    SEEN("motion.Y", motion.y),
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
