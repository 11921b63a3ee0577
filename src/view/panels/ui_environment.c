/* ui_environment.c: rows of the group of lights: environment, its rotation and exposure, and the
 * ground below a model. */
#include <string.h>
#include "src/scene/bundled_assets.h"
#include "src/view/panels/ui_internal.h"

enum {
    ENVIRONMENT_MAX = 8,
};

static void environment_buttons(const struct ui_view *view, struct ui_request *request)
{
    const char *names[ENVIRONMENT_MAX];
    const char *now = view->viewport->state.scene.environment;
    const bool is_sky = view->viewport->scene.background.kind == SCENE_SKY;
    uint32_t count = 0;
    uint32_t chosen = is_sky ? 0 : UINT32_MAX;
    for (; count < ENVIRONMENT_MAX && ui_environment(count); count++) {
        names[count] = ui_environment(count);
        chosen = now && !strcmp(now, names[count]) ? count : chosen;
    }
    if (ui_named_buttons("Environment", names, count, &chosen,
                         "surrounding panorama (--env); or drop an .exr or .hdr file") &&
        !request->open)
        request->open = strdup(names[chosen]);
}

static void panorama(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    static const struct imgui_slider_range turns = { -180.0f, 180.0f, "%.0f\xc2\xb0", false };

    static const struct imgui_slider_range stops = { -8.0f, 8.0f, "%+.2f stops", false };
    const struct setup_scene *scene = &view->viewport->state.scene;
    const struct scene_background *background = &view->viewport->scene.background;
    const bool is_file = scene->environment && !asset_is_valley(scene->environment);
    const bool is_panorama = background->kind == SCENE_ENVIRONMENT;
    float exposure = scene->env_exposure;
    imgui_disabled_begin(!is_panorama);
    request->rotates = ui_deferred_slider(
        ui, "Rotation", &request->env_rotate, &turns,
        is_panorama ? "rotation of the panorama about the vertical (--env-rotate); Ctrl drag in "
                      "the image does the same"
                    : "No effect: the environment is no panorama.");
    imgui_disabled_end();
    imgui_disabled_begin(!is_file);
    if (ui_deferred_slider(ui, "Its exposure", &exposure, &stops,
                           is_file ? "brightness of the environment (--env-exposure)"
                                   : "No effect: there is no environment file.")) {
        request->reloads = true;
        request->env_exposure = exposure;
    }
    imgui_disabled_end();
}

static void ground_buttons(const struct ui_view *view, struct ui_request *request)
{
    const struct setup_scene *scene = &view->viewport->state.scene;
    const bool is_builtin = scene_find_builtin(scene->name);
    uint32_t chosen = scene->ground.ground;
    imgui_disabled_begin(is_builtin);
    if (ui_named_buttons("Ground", stage_ground_names, STAGE_COLOR, &chosen,
                         is_builtin ? "No effect: built-in scenes have their own surroundings."
                                    : "floor below the model (--ground)")) {
        request->reloads = true;
        request->ground = (enum stage_ground)chosen;
    }
    imgui_disabled_end();
}

void ui_environment_rows(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    environment_buttons(view, request);
    panorama(ui, view, request);
    ground_buttons(view, request);
}
