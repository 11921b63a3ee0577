/* camera.c: converts between struct firn_camera and the renderer's camera. */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "src/lib/lib.h"
#include "src/scene/world_position.h"

/* Pinhole camera with OpenCV's axes. The principal point is relative to the top left corner of the
 * image. */
struct pinhole {
    double axes[3][3]; /* right, down, forward, unit vectors in world space */
    double eye[3];     /* metres, in the space of the model file */
    double fx, fy, cx, cy;
};

static bool are_finite(const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!(fabs(numbers[i]) <= 1e9))
            return false;
    }
    return true;
}

static double dot(const double a[static 3], const double b[static 3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[static 3], const double b[static 3], double c[static 3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* ---- checks ---- */

/* Returns true if the 3x3 part of a 3x4 matrix is a rotation, within 1e-3. */
static bool is_rotation(const double m[static 12])
{
    const double columns[3][3] = { { m[0], m[4], m[8] },
                                   { m[1], m[5], m[9] },
                                   { m[2], m[6], m[10] } };
    double z[3];
    for (int i = 0; i < 3; i++) {
        if (fabs(dot(columns[i], columns[i]) - 1.0) > 2e-3 ||
            fabs(dot(columns[i], columns[(i + 1) % 3])) > 1e-3)
            return false;
    }
    cross(columns[0], columns[1], z);
    return dot(z, columns[2]) > 0.0;
}

static const char *fault_of(const struct firn_camera *c)
{
    const double difference[3] = { c->target[0] - c->eye[0], c->target[1] - c->eye[1],
                                   c->target[2] - c->eye[2] };
    if (c->kind > FIRN_CAMERA_OPENGL)
        return "kind: expected a firn_camera_kind";
    if (c->has_time && !(c->time >= 0.0 && c->time <= 1e9))
        return "time: expected seconds from 0 to 1e9";
    if (c->kind == FIRN_CAMERA_SCENE)
        return NULL;
    if (c->kind == FIRN_CAMERA_LOOK_AT) {
        if (!are_finite(c->eye, 3) || !are_finite(c->target, 3) || !are_finite(c->up, 3) ||
            !(dot(difference, difference) > 0.0))
            return "eye, target, up: expected numbers within 1e9, and a target that is not the eye";
        return c->fov_deg >= 1.0 && c->fov_deg <= 170.0 ? NULL
                                                        : "fov_deg: expected 1 to 170 degrees";
    }
    if (!(c->fx > 0.0 && c->fy > 0.0) || !are_finite(&c->fx, 4))
        return "fx, fy, cx, cy: expected pixels, with fx and fy above 0";
    if (!are_finite(c->world_from_camera, 12) || !is_rotation(c->world_from_camera))
        return "world_from_camera: expected a rotation without scale or reflection, and a position";
    return NULL;
}

enum status lib_camera_read(struct firn_camera *to, const struct firn_camera *from)
{
    *to = (struct firn_camera){ .size = sizeof(*to) };
    const enum status status = from ? lib_read(to, sizeof(*to), from, "camera") : STATUS_OK;
    const char *fault = status == STATUS_OK ? fault_of(to) : NULL;
    if (fault)
        log_error("camera.%s", fault);
    return fault ? STATUS_USAGE : status;
}

/* ---- to the renderer's camera ---- */

static struct camera look_at(const struct firn_camera *from, const struct model *model)
{
    return (struct camera){
        .eye = world_position_relative(model, from->eye),
        .target = world_position_relative(model, from->target),
        .up = { { (float)from->up[0], (float)from->up[1], (float)from->up[2] } },
        .fov_deg = (float)from->fov_deg,
    };
}

static struct pinhole pinhole_of_matrix(const struct firn_camera *from)
{
    const double *m = from->world_from_camera;
    const bool is_opencv = from->kind == FIRN_CAMERA_OPENCV;
    const double sign = is_opencv ? 1.0 : -1.0, corner = is_opencv ? 0.5 : 0.0;
    struct pinhole p = {
        .fx = from->fx,
        .fy = from->fy,
        .cx = from->cx + corner,
        .cy = from->cy + corner,
    };
    for (size_t i = 0; i < 3; i++) {
        p.axes[0][i] = m[4 * i];
        p.axes[1][i] = sign * m[4 * i + 1];
        p.axes[2][i] = sign * m[4 * i + 2];
        p.eye[i] = m[4 * i + 3];
    }
    return p;
}

static struct camera of_pinhole(const struct pinhole *p, const firn_renderer *renderer)
{
    const struct model *model = &renderer->scene->session.scene.model;
    const double width = renderer->width, height = renderer->height;
    struct camera camera = {
        .eye = world_position_relative(model, p->eye),
        .fov_deg = (float)(360.0 / 3.14159265358979323846 * atan(height / 2.0 / p->fy)),
        .pixel_aspect = (float)(p->fy / p->fx),
        .off_center = { { (float)((p->cx - width / 2.0) / width),
                          (float)((p->cy - height / 2.0) / height) } },
    };
    /* a distant target, because eye and target are rounded to single precision */
    const float distance = 1.0f + 16.0f * glms_vec3_norm(camera.eye);
    for (int i = 0; i < 3; i++) {
        camera.target.raw[i] = camera.eye.raw[i] + distance * (float)p->axes[2][i];
        camera.up.raw[i] = -(float)p->axes[1][i];
    }
    return camera;
}

enum status lib_camera_of(struct camera *camera, const struct firn_camera *from,
                          const firn_renderer *renderer)
{
    const struct model *model = &renderer->scene->session.scene.model;
    const struct pinhole pinhole = pinhole_of_matrix(from);
    *camera =
        from->kind == FIRN_CAMERA_LOOK_AT ? look_at(from, model) : of_pinhole(&pinhole, renderer);
    if (!glms_vec3_eqv(camera->eye, camera->target))
        return STATUS_OK;
    log_error("camera: eye and target are equal in single precision");
    return STATUS_USAGE;
}

/* ---- from the renderer's camera ---- */

static struct pinhole pinhole_of(const struct camera *camera, const firn_renderer *renderer)
{
    const struct model *model = &renderer->scene->session.scene.model;
    const struct camera_basis basis = camera_basis(camera);
    const double width = renderer->width, height = renderer->height;
    const double aspect = camera->pixel_aspect > 0.0f ? (double)camera->pixel_aspect : 1.0;
    struct pinhole p = {
        .fy = height / 2.0 / tan((double)camera->fov_deg * 3.14159265358979323846 / 360.0),
        .cx = width * (0.5 + (double)camera->off_center.x),
        .cy = height * (0.5 + (double)camera->off_center.y),
    };
    p.fx = p.fy / aspect;
    for (int i = 0; i < 3; i++) {
        p.axes[0][i] = (double)basis.right.raw[i];
        p.axes[1][i] = -(double)basis.up.raw[i];
        p.axes[2][i] = (double)basis.forward.raw[i];
        p.eye[i] = world_position_axis(model, camera->eye, i);
    }
    return p;
}

/* Writes a pinhole camera as the kind to->kind. */
static void write_pinhole(struct firn_camera *to, const struct pinhole *p, double height)
{
    const bool is_opencv = to->kind == FIRN_CAMERA_OPENCV;
    const double sign = is_opencv ? 1.0 : -1.0, corner = is_opencv ? 0.5 : 0.0;
    to->fx = p->fx;
    to->fy = p->fy;
    to->cx = p->cx - corner;
    to->cy = p->cy - corner;
    to->fov_deg = 360.0 / 3.14159265358979323846 * atan(height / 2.0 / p->fy);
    for (size_t i = 0; i < 3; i++) {
        to->world_from_camera[4 * i] = p->axes[0][i];
        to->world_from_camera[4 * i + 1] = sign * p->axes[1][i];
        to->world_from_camera[4 * i + 2] = sign * p->axes[2][i];
        to->world_from_camera[4 * i + 3] = p->eye[i];
        to->eye[i] = p->eye[i];
        to->target[i] = p->eye[i] + p->axes[2][i];
        to->up[i] = -p->axes[1][i];
    }
}

void lib_camera_describe(struct firn_camera *to, const struct firn_camera *from,
                         const struct camera *camera, const firn_renderer *renderer)
{
    const struct pinhole pinhole =
        from->kind >= FIRN_CAMERA_OPENCV ? pinhole_of_matrix(from) : pinhole_of(camera, renderer);
    write_pinhole(to, &pinhole, renderer->height);
    to->has_time = from->has_time;
    to->time = from->time;
}
