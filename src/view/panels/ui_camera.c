/* ui_camera.c: rows of the camera group: field of view, directions and projection. */
#include <math.h>
#include <stdio.h>
#include "src/view/panels/ui_internal.h"

/* Half the height of a full-frame sensor, for the focal length, millimetres. */
static const float half_sensor = 12.0f;

static void field_of_view(const struct camera *camera, struct ui_request *request)
{
    static const struct imgui_slider_range range = { 2.0f, 120.0f, "%.3g\xc2\xb0", true };
    char tip[160];
    float fov_deg = camera->fov_deg;
    snprintf(tip, sizeof(tip),
             "vertical angle of view; %.3g mm of focal length on a sensor of 24 mm by 36 mm",
             (double)(half_sensor / tanf(fov_deg * 0.5f * 0.0174532925f)));
    imgui_disabled_begin(camera->height > 0.0f);
    if (ui_named_slider("Field of view", &fov_deg, &range,
                        camera->height > 0.0f ? "an orthographic camera has none" : tip))
        request->fov_deg = fov_deg;
    imgui_disabled_end();
}

void ui_camera_rows(const struct ui_view *view, struct ui_request *request)
{
    static const char *const directions[] = { "front", "side", "top", "first" };

    static const enum view_action actions[] = { VIEW_FRONT, VIEW_SIDE, VIEW_TOP, VIEW_RESET };

    static const char *const projections[] = { "perspective", "orthographic" };
    const struct camera *camera = &view->viewport->camera;
    uint32_t direction = UINT32_MAX, projection = camera->height > 0.0f;
    field_of_view(camera, request);
    if (ui_named_buttons("Look from", directions, 4, &direction,
                         "direction of the camera; `first` is that of the scene"))
        request->action = actions[direction];
    if (ui_named_buttons("Projection", projections, 2, &projection, "kind of camera"))
        request->action = VIEW_ORTHOGRAPHIC;
}
