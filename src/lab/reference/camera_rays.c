/* camera_rays.c: generates camera rays for perspective, orthographic and thin-lens cameras. */
#include "src/lab/reference/camera_rays.h"
#include <cglm/struct.h>
#include "src/render/frame/frame_uniforms.h"
#include "src/render/frame/thin_lens.h"
#include "src/settings/scene_settings.h"

struct camera_rays camera_rays_of(const struct frame_view *view, enum pixel_filter filter)
{
    const struct lens_params *lens = settings_of(view->settings, &lens_settings);
    const bool is_orthographic = view->camera.height > 0.0f;
    return (struct camera_rays){
        .view = *view,
        .push = frame_view_push(view),
        .filter = filter,
        .forward = camera_basis(&view->camera).forward,
        .is_orthographic = is_orthographic,
        .has_lens = lens->f_stop > 0.0f && !is_orthographic,
    };
}

struct embree_scene_ray camera_rays_at(const struct camera_rays *rays, uint32_t x, uint32_t y,
                                       uint32_t sample)
{
    const vec2s jitter = pixel_filter_offset(rays->filter, sample);
    const struct surroundings_push *push = &rays->push;
    struct frame_view view = rays->view;
    const float right = 2.0f * ((float)x + 0.5f + jitter.x) / (float)view.width - 1.0f;
    const float down = 2.0f * ((float)y + 0.5f + jitter.y) / (float)view.height - 1.0f;
    const vec3s along =
        glms_vec3_muladds(push->up, -down, glms_vec3_muladds(push->right, right, push->forward));
    struct embree_scene_ray ray = {
        .origin = push->eye,
        .dir = glms_vec3_normalize(along),
        .near = scene_near_plane(view.scene),
        .from = EMBREE_SCENE_NO_ORIGIN,
    };
    if (rays->is_orthographic) {
        ray.origin = glms_vec3_add(push->eye, glms_vec3_sub(along, push->forward));
        ray.dir = push->forward;
        return ray;
    }
    view.sample = sample;
    if (rays->has_lens) {
        const struct frame_lens lens = frame_lens_of(&view);
        const vec3s focus = glms_vec3_scale(along, lens.focus);
        ray.origin = glms_vec3_add(push->eye, lens.aside);
        ray.dir = glms_vec3_normalize(glms_vec3_sub(focus, lens.aside));
    }
    ray.near /= glms_vec3_dot(ray.dir, rays->forward);
    return ray;
}
