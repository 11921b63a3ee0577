/* ladder_options.c: setters and default settings of firn ladder. */
#include "src/app/options/ladder_options.h"
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/path.h"
#include "src/settings/scene_settings.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/refract/refract.h"
#include "src/tech/techniques.h"

enum status option_ladder_output(const struct option *option, void *at, const char *value)
{
    if (!path_ends_in(value, ".png") && !path_ends_in(value, ".exr"))
        return option_refuse(option, value, "a file name that ends in .png or .exr");
    return option_add_output(option, at, value);
}

static bool add_refraction_model(struct app_ladder *ladder, const char *name, size_t length)
{
    const struct technique *refraction;
    for (uint32_t i = 0; (refraction = techniques_refraction(i)); i++) {
        if (strlen(refraction->refraction.name) == length &&
            !strncmp(refraction->refraction.name, name, length)) {
            ladder->refraction_models |= 1u << i;
            return true;
        }
    }
    return false;
}

enum status option_refraction_models(const struct option *option, void *at, const char *value)
{
    for (const char *name = value;;) {
        const size_t length = strcspn(name, ",");
        if (!add_refraction_model(at, name, length))
            return option_refuse_name(option, OPTION_REFRACTION_MODELS, name, length);
        if (!name[length])
            return STATUS_OK;
        name += length + 1;
    }
}

void option_ladder_settings(struct settings *s)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_on && (!(*t)->is_traced || (*t)->is_ice_only))
            techniques_switch_off(s, *t);
    }
    settings_set_value(s, settings_row(&light_settings, offsetof(struct light_params, count)), 0.0);
    settings_set_value(
        s, settings_row(&env_cube_settings, offsetof(struct env_cube_params, dynamic)), 0.0);
    settings_set_value(s, settings_row(&refract_settings, offsetof(struct refract_params, fresnel)),
                       REFRACT_FRESNEL_EXACT);
    settings_set_value(s, settings_row(&refract_settings, offsetof(struct refract_params, lookup)),
                       REFRACT_LOOKUP_DISTANCE);
}

void option_ladder_whole(struct setup_scene *scene)
{
    const struct setting *refract =
        settings_row(&cracks_settings, offsetof(struct cracks_params, refract));
    for (const struct technique *const *t = techniques; *t; t++) {
        const struct setting *row = (*t)->settings ? &(*t)->settings->rows[0] : NULL;
        if ((*t)->is_ice_only && (*t)->is_traced && row)
            settings_put(&scene->settings, row, row->initial, SETTING_DEFAULT);
    }
    settings_put(&scene->settings, refract, CRACKS_REFRACT_GAP, SETTING_DEFAULT);
}
