/* reference_layers.c: the reference as a rung, and its layers. In every build. */
#include "src/reference/reference_layers.h"
#include <stdio.h>
#include <string.h>
#include "shaders/surface.h"
#include "src/settings/scene_settings.h"
#include "src/tech/air.h"
#include "src/tech/bubbles.h"
#include "src/tech/bump.h"
#include "src/tech/cracks.h"
#include "src/tech/frost.h"
#include "src/tech/ice_caustics.h"
#include "src/tech/surface.h"

const struct rung reference_rung = { .name = "reference" };

#define SEEN(name, field) \
    { \
        (name), offsetof(struct reference_seen, field) \
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
};

size_t reference_layers_find(const char *plane)
{
    for (size_t i = 0; i < sizeof(planes) / sizeof(planes[0]); i++) {
        if (!strcmp(planes[i].plane, plane))
            return planes[i].offset / sizeof(float);
    }
    return REFERENCE_SEEN_COUNT;
}

bool reference_makes(const struct frame_layer *layer)
{
    return reference_layers_find(layer->planes[0]) < REFERENCE_SEEN_COUNT;
}

static void add_name(char *names, size_t size, const char *name, bool is_on)
{
    const size_t used = strlen(names);
    if (is_on)
        snprintf(&names[used], size - used, "%s%s", used ? ", " : "", name);
}

bool reference_leaves_out(const struct settings *settings, char *names, size_t size)
{
    const struct cracks_params *sheets = settings_of(settings, &cracks_settings);
    const struct air_params *squares = settings_of(settings, &air_settings);
    const struct bubbles_params *spheres = settings_of(settings, &bubbles_settings);
    const struct bump_params *bumps = settings_of(settings, &bump_settings);
    const struct frost_params *rough = settings_of(settings, &frost_settings);
    const struct light_params *lights = settings_of(settings, &light_settings);
    const struct surface_params *shine = settings_of(settings, &surface_settings);
    names[0] = '\0';
    add_name(names, size, "cracks", sheets->count > 0);
    add_name(names, size, "air", squares->count > 0);
    add_name(names, size, "bubbles", spheres->count > 0);
    add_name(names, size, "bumps", bumps->strength > 0.0f);
    add_name(names, size, "frost", rough->amount > 0.0f);
    add_name(names, size, "highlights",
             lights->count > 0 && lights->strength > 0.0f && shine->strength > 0.0f);
    add_name(names, size, "light through the ice", ice_caustics_is_on(settings));
    return names[0] != '\0';
}
