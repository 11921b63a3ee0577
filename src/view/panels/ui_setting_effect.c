/* ui_setting_effect.c: finds settings that have no effect in the current scene. */
#include <string.h>
#include "src/render/frame/pass_list.h"
#include "src/scene/scene.h"
#include "src/tech/inclusions/air.h"
#include "src/view/panels/ui_settings.h"

/* Settings that have no effect while another one is 0 or off. */
static const struct {
    const char *prefix, *needs, *reason;
} needs[] = {
    { "cracks.", "cracks.count", "No effect while there are no cracks." },
    { "bubbles.", "bubbles.count", "No effect while there are no bubbles." },
    { "air.", "air.count", "No effect while there are no planes of fine bubbles." },
    { "light.", "light.count", "No effect while there are no lights." },
    { "lens.focus", "lens.f_stop", "No effect: with aperture 0 everything is sharp." },
    { "motion.objects", "motion.count", "No effect while no objects orbit." },
    { "motion.lights", "light.count", "No effect while there are no lights." },
    { "frost.", "frost.amount", "No effect while there is no frost." },
};

static bool begins(const char *text, const char *prefix)
{
    return !strncmp(text, prefix, strlen(prefix));
}

/* Returns why a setting of sky or panorama has no effect; NULL if it has one. */
static const char *of_environment(const char *name, const struct settings *settings,
                                  const struct scene *scene)
{
    const bool is_panorama = scene->background.kind == SCENE_ENVIRONMENT;
    const struct setting *sun = settings_find("env.sun");
    const uint32_t sun_kind = (uint32_t)settings_get(settings, sun);
    if (begins(name, "sky.") && is_panorama)
        return "No effect: a panorama takes the place of the sky.";
    if (begins(name, "env.") && !is_panorama)
        return "No effect without a panorama.";
    if ((!strcmp(name, "env.sun_azimuth") || !strcmp(name, "env.sun_elevation")) &&
        strcmp(sun->choices[sun_kind], "own") != 0)
        return "No effect unless the sun of the panorama is `own`.";
    return begins(name, "landscape.") && is_panorama ? "No effect: there is no landscape." : NULL;
}

const char *ui_setting_no_effect(const struct setting *row, const struct settings *settings,
                                 const struct scene *scene)
{
    const bool is_pool = begins(row->name, "pool.") || begins(row->name, "water.") ||
                         begins(row->name, "caustics.method");
    if (is_pool && !scene->has_pool)
        return "No effect: the scene is no pool.";
    if (begins(row->name, "air.") && (air_is_medium(settings) || !strcmp(row->name, "air.model")))
        return of_environment(row->name, settings, scene);
    for (size_t i = 0; i < sizeof(needs) / sizeof(needs[0]); i++) {
        if (begins(row->name, needs[i].prefix) && strcmp(row->name, needs[i].needs) != 0 &&
            !(settings_get(settings, settings_find(needs[i].needs)) > 0.0))
            return needs[i].reason;
    }
    return of_environment(row->name, settings, scene);
}
