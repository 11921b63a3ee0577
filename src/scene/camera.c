/* camera.c: reversed-Z perspective, orthographic and cube map projections. */
#include "src/scene/camera.h"

#include <assert.h>
#include <cglm/struct.h>
#include <math.h>

/* Normalises a vector whose squared length may underflow or overflow. */
static vec3s normalize_safe(vec3s v)
{
    const float largest = fmaxf(fabsf(v.x), fmaxf(fabsf(v.y), fabsf(v.z)));
    if (largest > 0 && (largest < 1e-15F || largest > 1e15F))
        v = glms_vec3_divs(v, largest);
    return glms_vec3_normalize(v);
}

bool camera_is_equal(const struct camera *a, const struct camera *b)
{
    return glms_vec3_eqv(a->eye, b->eye) && glms_vec3_eqv(a->target, b->target) &&
           glms_vec3_eqv(a->up, b->up) && a->fov_deg == b->fov_deg && a->height == b->height &&
           a->depth == b->depth && a->pixel_aspect == b->pixel_aspect &&
           glms_vec2_eqv(a->off_center, b->off_center);
}

float camera_aspect(const struct camera *camera, uint32_t width, uint32_t height)
{
    const float aspect = (float)width / (float)height;
    return camera->pixel_aspect > 0 ? aspect * camera->pixel_aspect : aspect;
}

vec2s camera_pixel_shift(const struct camera *camera, uint32_t width, uint32_t height)
{
    return (
        vec2s){ { -camera->off_center.x * (float)width, -camera->off_center.y * (float)height } };
}

struct camera_basis camera_basis(const struct camera *camera)
{
    vec3s forward = normalize_safe(glms_vec3_sub(camera->target, camera->eye));
    vec3s up = camera->up;
    if (glms_vec3_eqv(up, glms_vec3_zero()))
        up = (vec3s){ { 0, 1, 0 } };
    vec3s right = glms_vec3_cross(forward, normalize_safe(up));
    if (!(glms_vec3_norm(right) > 1e-4F)) {
        up = fabsf(forward.y) > 0.5F ? (vec3s){ { 0, 0, -1 } } : (vec3s){ { 0, 1, 0 } };
        right = glms_vec3_cross(forward, up);
    }
    right = glms_vec3_normalize(right);
    return (struct camera_basis){
        .right = right,
        .up = glms_vec3_cross(right, forward),
        .forward = forward,
    };
}

static void set_row(mat4s *matrix, int row, vec3s v, float w)
{
    matrix->raw[0][row] = v.x;
    matrix->raw[1][row] = v.y;
    matrix->raw[2][row] = v.z;
    matrix->raw[3][row] = w;
}

/* Returns the matrix that maps a point at `eye` + p to the clip coordinates (right.p, down.p, near,
 * forward.p). */
static mat4s projection(vec3s right, vec3s down, vec3s forward, vec3s eye, float near)
{
    mat4s clip_from_world = { 0 };
    set_row(&clip_from_world, 0, right, -glms_vec3_dot(right, eye));
    set_row(&clip_from_world, 1, down, -glms_vec3_dot(down, eye));
    set_row(&clip_from_world, 2, (vec3s){ 0 }, near);
    set_row(&clip_from_world, 3, forward, -glms_vec3_dot(forward, eye));
    return clip_from_world;
}

float camera_half_height(const struct camera *camera)
{
    return camera->height > 0 ? camera->height / 2 : tanf(glm_rad(camera->fov_deg) / 2);
}

/* Returns an orthographic projection, with depth (far - distance) / (far - near). */
static mat4s orthographic_projection(const struct camera *camera, float aspect, float near,
                                     vec2s jitter)
{
    const struct camera_basis basis = camera_basis(camera);
    const float half = camera->height / 2;
    const float far = fmaxf(camera->depth, 2 * near);
    const vec3s right = glms_vec3_scale(basis.right, 1 / (half * aspect));
    const vec3s down = glms_vec3_scale(basis.up, -1 / half);
    const vec3s back = glms_vec3_scale(basis.forward, -1 / (far - near));
    mat4s clip_from_world = { 0 };
    set_row(&clip_from_world, 0, right, -glms_vec3_dot(right, camera->eye) - jitter.x);
    set_row(&clip_from_world, 1, down, -glms_vec3_dot(down, camera->eye) - jitter.y);
    set_row(&clip_from_world, 2, back, far / (far - near) - glms_vec3_dot(back, camera->eye));
    set_row(&clip_from_world, 3, (vec3s){ 0 }, 1);
    return clip_from_world;
}

mat4s camera_clip_from_world(const struct camera *camera, uint32_t width, uint32_t height,
                             float near, vec2s jitter)
{
    jitter = glms_vec2_add(jitter, camera_pixel_shift(camera, width, height));
    const vec2s jitter_clip = { { 2 * jitter.x / (float)width, 2 * jitter.y / (float)height } };
    if (camera->height > 0)
        return orthographic_projection(camera, camera_aspect(camera, width, height), near,
                                       jitter_clip);
    struct camera_basis basis = camera_basis(camera);
    float scale_y = 1 / tanf(glm_rad(camera->fov_deg) / 2);
    float scale_x = scale_y * (float)height / (float)width;
    if (camera->pixel_aspect > 0)
        scale_x /= camera->pixel_aspect;
    vec3s right = glms_vec3_scale(basis.right, scale_x);
    vec3s down = glms_vec3_scale(basis.up, -scale_y);
    /* Adding a multiple of the w row shifts the image after the perspective division. */
    right = glms_vec3_muladds(basis.forward, -2 * jitter.x / (float)width, right);
    down = glms_vec3_muladds(basis.forward, -2 * jitter.y / (float)height, down);
    return projection(right, down, basis.forward, camera->eye, near);
}

mat4s camera_view_from_world(const struct camera *camera)
{
    struct camera_basis basis = camera_basis(camera);
    mat4s view_from_world = { 0 };
    set_row(&view_from_world, 0, basis.right, -glms_vec3_dot(basis.right, camera->eye));
    set_row(&view_from_world, 1, basis.up, -glms_vec3_dot(basis.up, camera->eye));
    set_row(&view_from_world, 2, glms_vec3_negate(basis.forward),
            glms_vec3_dot(basis.forward, camera->eye));
    view_from_world.raw[3][3] = 1;
    return view_from_world;
}

mat4s camera_cube_clip_from_world(uint32_t face, vec3s center, float near)
{
    struct camera_basis basis = camera_cube_basis(face);
    return projection(basis.right, glms_vec3_negate(basis.up), basis.forward, center, near);
}

struct camera_basis camera_cube_basis(uint32_t face)
{
    static const struct camera_basis faces[6] = {
        { .right = { { 0, 0, -1 } }, .up = { { 0, 1, 0 } }, .forward = { { 1, 0, 0 } } },
        { .right = { { 0, 0, 1 } }, .up = { { 0, 1, 0 } }, .forward = { { -1, 0, 0 } } },
        { .right = { { 1, 0, 0 } }, .up = { { 0, 0, -1 } }, .forward = { { 0, 1, 0 } } },
        { .right = { { 1, 0, 0 } }, .up = { { 0, 0, 1 } }, .forward = { { 0, -1, 0 } } },
        { .right = { { 1, 0, 0 } }, .up = { { 0, 1, 0 } }, .forward = { { 0, 0, 1 } } },
        { .right = { { -1, 0, 0 } }, .up = { { 0, 1, 0 } }, .forward = { { 0, 0, -1 } } },
    };
    assert(face < 6);
    return faces[face];
}

struct camera camera_orbit(float azimuth_deg, float elevation_deg, float distance, vec3s target,
                           float fov_deg)
{
    float azimuth = glm_rad(azimuth_deg);
    float elevation = glm_rad(elevation_deg);
    vec3s toward_eye = { {
        cosf(elevation) * sinf(azimuth),
        sinf(elevation),
        cosf(elevation) * cosf(azimuth),
    } };
    return (struct camera){
        .eye = glms_vec3_muladds(toward_eye, distance, target),
        .target = target,
        .fov_deg = fov_deg,
    };
}

float camera_framing_distance(float diagonal, float fov_deg, uint32_t width, uint32_t height)
{
    const float margin = 1.1F;
    float aspect = (float)width / (float)height;
    float half_angle = atanf(tanf(glm_rad(fov_deg) / 2) * fminf(aspect, 1));
    return margin * diagonal / 2 / sinf(half_angle);
}
