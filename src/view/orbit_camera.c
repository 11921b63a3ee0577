/* orbit_camera.c: rotation, pan and zoom of an orbit camera. */
#include "src/view/orbit_camera.h"
#include <cglm/struct.h>
#include <math.h>

static const float steepest_deg = 89.0f;
static const float step_factor = 0.9f;

void orbit_camera_rotate(struct camera *camera, float azimuth_deg, float elevation_deg)
{
    const vec3s away = glms_vec3_sub(camera->eye, camera->target);
    const float distance = glms_vec3_norm(away);
    const float azimuth = glm_deg(atan2f(away.x, away.z)) + azimuth_deg;
    const float elevation = glm_deg(asinf(glm_clamp(away.y / distance, -1.0f, 1.0f)));
    /* a camera already beyond the elevation limit can only move back */
    const float limit = fmaxf(steepest_deg, fabsf(elevation));
    const struct camera before = *camera;
    *camera = camera_orbit(azimuth, glm_clamp(elevation + elevation_deg, -limit, limit), distance,
                           camera->target, camera->fov_deg);
    camera->height = before.height;
    camera->depth = before.depth;
}

void orbit_camera_look_from(struct camera *camera, float azimuth_deg, float elevation_deg)
{
    const float distance = glms_vec3_distance(camera->eye, camera->target);
    const struct camera before = *camera;
    *camera = camera_orbit(azimuth_deg, glm_clamp(elevation_deg, -steepest_deg, steepest_deg),
                           distance, camera->target, camera->fov_deg);
    camera->height = before.height;
    camera->depth = before.depth;
}

void orbit_camera_toggle_projection(struct camera *camera, float depth)
{
    const vec3s away = glms_vec3_sub(camera->eye, camera->target);
    const float slope = 2.0f * tanf(glm_rad(camera->fov_deg) / 2.0f);
    if (camera->height > 0.0f) {
        const float distance = camera->height / slope;
        camera->eye = glms_vec3_muladds(glms_vec3_normalize(away), distance, camera->target);
        camera->height = camera->depth = 0.0f;
    } else {
        camera->height = slope * glms_vec3_norm(away);
        camera->depth = depth;
    }
}

void orbit_camera_pan(struct camera *camera, float right, float up)
{
    const struct camera_basis basis = camera_basis(camera);
    const float distance = glms_vec3_distance(camera->eye, camera->target);
    const float height = camera->height > 0.0f
                             ? camera->height
                             : 2.0f * distance * tanf(glm_rad(camera->fov_deg) / 2.0f);
    const vec3s move = glms_vec3_add(glms_vec3_scale(basis.right, right * height),
                                     glms_vec3_scale(basis.up, up * height));
    camera->eye = glms_vec3_add(camera->eye, move);
    camera->target = glms_vec3_add(camera->target, move);
}

void orbit_camera_zoom(struct camera *camera, float steps, float nearest, float farthest)
{
    const vec3s away = glms_vec3_sub(camera->eye, camera->target);
    const float distance = glms_vec3_norm(away);
    const float distance_next = distance * powf(step_factor, steps);
    if (camera->height > 0.0f) {
        const float height = camera->height * powf(step_factor, steps);
        camera->height =
            glm_clamp(height, fminf(nearest, camera->height), fmaxf(farthest, camera->height));
        return;
    }
    /* a camera already beyond the distance limits can only move back */
    const float clamped =
        glm_clamp(distance_next, fminf(nearest, distance), fmaxf(farthest, distance));
    camera->eye = glms_vec3_muladds(away, clamped / distance, camera->target);
}
