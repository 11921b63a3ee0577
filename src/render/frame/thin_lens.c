/* thin_lens.c: thin-lens camera: samples the aperture and shears the projection. */
#include "src/render/frame/thin_lens.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/settings/scene_settings.h"

#define HALF_WIDTH 0.018f /* half-width of 35 mm film, metres */

/* Returns a lens sample on the unit disc; sample 0 is the centre. Uses the last two dimensions of
 * Roberts' 4D R sequence. Shirley and Chiu's concentric map takes them to the disc. */
static vec2s disc_point(uint32_t sample)
{
    const float x = 2.0f * (float)fmod(0.5 + sample * 0.6287067210378087, 1.0) - 1.0f;
    const float y = 2.0f * (float)fmod(0.5 + sample * 0.5385972572236101, 1.0) - 1.0f;
    const bool is_wide = fabsf(x) > fabsf(y);
    const float radius = is_wide ? x : y;
    const float ratio = is_wide ? y / x : fabsf(y) > 0.0f ? x / y : 0.0f;
    const float angle = is_wide ? 0.785398163f * ratio : 1.570796327f - 0.785398163f * ratio;
    return (vec2s){ { radius * cosf(angle), radius * sinf(angle) } };
}

static float half_up(const struct frame_view *view)
{
    return tanf(0.5f * glm_rad(view->camera.fov_deg));
}

struct frame_lens frame_lens_of(const struct frame_view *view)
{
    const struct lens_params *params = settings_of(view->settings, &lens_settings);
    const struct camera_basis basis = camera_basis(&view->camera);
    const vec3s to_object = glms_vec3_sub(box_center(view->scene->box), view->camera.eye);
    const float right = half_up(view) * camera_aspect(&view->camera, view->width, view->height);
    const float ahead = glms_vec3_dot(to_object, basis.forward);
    struct frame_lens lens = { .focus = params->focus > 0.0f ? params->focus : ahead };
    if (!(lens.focus > 0.0f))
        lens.focus = 1.0f;
    if (!(params->f_stop > 0.0f) || view->camera.height > 0.0f)
        return lens;
    const float radius = 0.5f * HALF_WIDTH / right / params->f_stop;
    const vec2s at = glms_vec2_scale(disc_point(view->sample), radius);
    lens.aside = glms_vec3_add(glms_vec3_scale(basis.right, at.x), glms_vec3_scale(basis.up, at.y));
    return lens;
}

void frame_lens_apply(struct frame_view *view)
{
    const struct frame_lens lens = frame_lens_of(view);
    const struct camera_basis basis = camera_basis(&view->camera);
    const float pixels = 0.5f * (float)view->height / half_up(view) / lens.focus;
    if (!(glms_vec3_norm2(lens.aside) > 0.0f))
        return;
    const float pixel_aspect = view->camera.pixel_aspect > 0.0f ? view->camera.pixel_aspect : 1.0f;
    view->jitter.x -= glms_vec3_dot(lens.aside, basis.right) * pixels / pixel_aspect;
    view->jitter.y += glms_vec3_dot(lens.aside, basis.up) * pixels;
    view->camera.eye = glms_vec3_add(view->camera.eye, lens.aside);
    view->camera.target = glms_vec3_add(view->camera.target, lens.aside);
}
