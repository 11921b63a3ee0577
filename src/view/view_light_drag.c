/* view_light_drag.c: rotates sun and panorama, and changes the exposure. */
#include <math.h>
#include "src/settings/scene_settings.h"
#include "src/tech/output/tonemap.h"
#include "src/view/view_internal.h"

static const double drag_rotation_deg = 180.0; /* degrees per drag over the whole window height */

/* Wraps an angle to -180 ... 180 degrees. */
static double wrap(double degrees)
{
    return degrees - 360.0 * floor((degrees + 180.0) / 360.0);
}

static void move_sun(struct settings *settings, const struct setting *azimuth,
                     const struct setting *elevation, double right, double up)
{
    const double height = settings_get(settings, elevation) + up;
    settings_set_value(settings, azimuth, wrap(settings_get(settings, azimuth) + right));
    settings_set_value(settings, elevation, fmin(fmax(height, elevation->min), elevation->max));
}

/* Returns why the light cannot be rotated; NULL if it can. */
static const char *refusal(const struct scene *scene, const struct env_params *env, bool is_sun)
{
    if (scene->background.cube.texels)
        return "a cube map cannot be rotated: open a panorama or a model without one";
    if (scene->background.kind == SCENE_COLOR)
        return "the background is a single colour: open a panorama to rotate the light";
    if (scene->background.kind == SCENE_ENVIRONMENT && is_sun && env->sun != ENV_SUN_CUSTOM)
        return "the sun is part of this panorama: set env.sun to own to move it";
    return NULL;
}

void view_rotate_light(struct view *v, double right, double down, bool is_sun)
{
    const struct scene *scene = &v->viewport->scene;
    struct view_state state = view_state_now(v);
    const char *why = refusal(scene, settings_of(&state.settings, &env_settings), is_sun);
    right *= drag_rotation_deg;
    if (why) {
        ui_show_message(v->ui, why);
        return;
    }
    if (scene->background.kind != SCENE_ENVIRONMENT)
        move_sun(&state.settings,
                 settings_row(&sky_settings, offsetof(struct sky_params, sun_azimuth)),
                 settings_row(&sky_settings, offsetof(struct sky_params, sun_elevation)), right,
                 is_sun ? -down * drag_rotation_deg : 0.0);
    else if (is_sun)
        move_sun(&state.settings,
                 settings_row(&env_settings, offsetof(struct env_params, sun_azimuth)),
                 settings_row(&env_settings, offsetof(struct env_params, sun_elevation)), right,
                 -down * drag_rotation_deg);
    else
        state.env_rotate = (float)wrap((double)state.env_rotate + right);
    view_edit(v, &state, v->press_count | VIEW_HOLD);
}

void view_add_exposure(struct view *v, double stops)
{
    const struct setting *row =
        settings_row(&tonemap_settings, offsetof(struct tonemap_values, exposure));
    struct view_state state = view_state_now(v);
    const double exposure = settings_get(&state.settings, row) + stops;
    settings_set_value(&state.settings, row, fmin(fmax(exposure, row->min), row->max));
    view_edit(v, &state, 0);
}
