/* ui_camera.c: rows of the camera group: field of view, focus, bookmarks, directions. */
#include <math.h>
#include <stdio.h>
#include "src/settings/scene_settings.h"
#include "src/view/panels/ui_internal.h"

/* Half the height of a full-frame sensor, for the focal length, millimetres. */
static const float half_sensor = 12.0f;

static const float radian = 0.0174532925f;

static void field_of_view(const struct camera *camera, struct ui_request *request)
{
    static const struct imgui_slider_range range = { 2.0f, 120.0f, "%.3g\xc2\xb0", true };

    static const struct imgui_slider_range lengths = { 7.0f, 680.0f, "%.3g mm", true };
    const bool is_orthographic = camera->height > 0.0f;
    const char *none = "an orthographic camera has none";
    float fov_deg = camera->fov_deg;
    float length = half_sensor / tanf(fov_deg * 0.5f * radian);
    imgui_disabled_begin(is_orthographic);
    if (ui_named_slider("Field of view", &fov_deg, &range,
                        is_orthographic ? none : "vertical angle of view (--fov)"))
        request->fov_deg = fov_deg;
    if (ui_named_slider("Focal length", &length, &lengths,
                        is_orthographic
                            ? none
                            : "focal length with a sensor of 36 mm by 24 mm, which sets "
                              "the field of view"))
        request->fov_deg = 2.0f * atanf(half_sensor / length) / radian;
    imgui_disabled_end();
}

/* Draws the button after which a click in the image sets the distance of the focus. */
static void focus(struct ui *ui, struct ui_request *request)
{
    const struct lens_params *lens = settings_of(&request->settings, &lens_settings);
    const bool is_pinhole = !(lens->f_stop > 0.0f);
    static const char *const names[] = { "click a point" };
    uint32_t chosen = ui->focuses ? 0 : UINT32_MAX;
    imgui_disabled_begin(is_pinhole);
    if (ui_named_buttons("Focus on", names, 1, &chosen,
                         is_pinhole ? "No effect: with aperture 0 everything is sharp."
                                    : "then click in the image what is to be sharp (lens.focus)"))
        ui->focuses = true;
    imgui_disabled_end();
}

static void bookmarks(const struct ui_view *view, struct ui_request *request)
{
    static const enum view_action actions[] = { VIEW_BOOKMARK_1, VIEW_BOOKMARK_2, VIEW_BOOKMARK_3,
                                                VIEW_BOOKMARK_4, VIEW_ADD_BOOKMARK };

    static const char *const names[] = { "1", "2", "3", "4", "store" };
    uint32_t chosen = view->bookmark;
    if (!ui_named_buttons("Bookmarks", names, 5, &chosen,
                          "cameras: Ctrl B stores this one, Ctrl 1 to Ctrl 4 return to one"))
        return;
    request->action = actions[chosen];
}

void ui_camera_rows(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    static const char *const directions[] = { "front", "side", "top", "first" };

    static const enum view_action actions[] = { VIEW_FRONT, VIEW_SIDE, VIEW_TOP, VIEW_RESET };

    static const char *const projections[] = { "perspective", "orthographic" };
    const struct camera *camera = &view->viewport->camera;
    uint32_t direction = UINT32_MAX, projection = camera->height > 0.0f;
    field_of_view(camera, request);
    focus(ui, request);
    bookmarks(view, request);
    if (ui_named_buttons("Look from", directions, 4, &direction,
                         "direction of the camera; `first` is that of the scene"))
        request->action = actions[direction];
    if (ui_named_buttons("Projection", projections, 2, &projection, "kind of camera"))
        request->action = VIEW_ORTHOGRAPHIC;
}
