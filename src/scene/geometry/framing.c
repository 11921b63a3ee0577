/* framing.c: support points of a model file's geometry, and the camera that frames them. */
#include "src/scene/geometry/framing.h"
#include <cglm/struct.h>
#include <math.h>

static const float azimuth_deg = 30.0f;
static const float elevation_deg = 17.0f;
static const float default_fov_deg = 24.0f;
static const float widest_fov_deg = 60.0f; /* in a room */
static const float fill = 0.66f;           /* projected bounds relative to the image dimension */
static const float room_factor = 4.0f;     /* minimum width of a room, in widths of the objects */

enum {
    PAIR_COUNT = FRAMING_POINT_COUNT / 2, /* opposite directions */
    BLOCK_VERTICES = 64,                  /* vertices that are skipped together */
    ROTATION_COUNT = 16,                  /* rotations of a rotating object that are framed */
};

/* ---- support points ---- */

/* Axes of the search, and the vertices that are extreme along them. */
struct search {
    float x[PAIR_COUNT], y[PAIR_COUNT], z[PAIR_COUNT];
    float low[PAIR_COUNT], high[PAIR_COUNT];
    const struct mesh_vertex *lowest[PAIR_COUNT], *highest[PAIR_COUNT];
};

/* Distributes the axes over a hemisphere along a Fibonacci spiral. */
static void search_init(struct search *search)
{
    const float golden_angle = 2.39996323f;
    for (int i = 0; i < PAIR_COUNT; i++) {
        const float height = ((float)i + 0.5f) / PAIR_COUNT;
        const float radius = sqrtf(1.0f - height * height);
        search->x[i] = radius * cosf(golden_angle * (float)i);
        search->y[i] = height;
        search->z[i] = radius * sinf(golden_angle * (float)i);
        search->low[i] = INFINITY;
        search->high[i] = -INFINITY;
        search->lowest[i] = search->highest[i] = NULL;
    }
}

static void search_vertex(struct search *search, const struct mesh_vertex *vertex, vec3s center)
{
    /* relative to the centre, because rounding grows with the distance from the origin */
    const vec3s p = glms_vec3_sub(vertex->position, center);
    for (int i = 0; i < PAIR_COUNT; i++) {
        const float d = p.x * search->x[i] + p.y * search->y[i] + p.z * search->z[i];
        if (d < search->low[i]) {
            search->low[i] = d;
            search->lowest[i] = vertex;
        }
        if (d > search->high[i]) {
            search->high[i] = d;
            search->highest[i] = vertex;
        }
    }
}

/* Returns true if no vertex of a box can be extreme. The slack covers rounding. */
static bool are_within_extremes(const struct search *search, const struct box *box, vec3s center)
{
    const vec3s half = glms_vec3_scale(glms_vec3_sub(box->max, box->min), 0.5f);
    const vec3s p = glms_vec3_sub(box_center(*box), center);
    const float slack = 1e-5f * (glms_vec3_norm(p) + glms_vec3_norm(half));
    for (int i = 0; i < PAIR_COUNT; i++) {
        const float d = p.x * search->x[i] + p.y * search->y[i] + p.z * search->z[i];
        const float reach = half.x * fabsf(search->x[i]) + half.y * search->y[i] +
                            half.z * fabsf(search->z[i]) + slack;
        if (!(d - reach >= search->low[i] && d + reach <= search->high[i])) /* or NaN */
            return false;
    }
    return true;
}

/* Searches the vertices of a mesh, skipping blocks of consecutive ones within the extremes. */
static void search_mesh(struct search *search, const struct mesh *mesh, vec3s center)
{
    for (uint32_t first = 0; first < mesh->vertex_count; first += BLOCK_VERTICES) {
        const uint32_t left = mesh->vertex_count - first;
        const struct mesh block = { .vertices = &mesh->vertices[first],
                                    .vertex_count = left < BLOCK_VERTICES ? left : BLOCK_VERTICES };
        const struct box box = mesh_box(&block);
        if (are_within_extremes(search, &box, center))
            continue;
        for (uint32_t i = 0; i < block.vertex_count; i++)
            search_vertex(search, &block.vertices[i], center);
    }
}

static struct box unite(struct box a, struct box b)
{
    return (struct box){ glms_vec3_minv(a.min, b.min), glms_vec3_maxv(a.max, b.max) };
}

/* Returns true if `outer` extends far beyond `inner` to all sides, and does not start above it. It
 * may end below the top of `inner`, as a floor does. */
static bool surrounds(const struct box *outer, const struct box *inner)
{
    const vec3s a = glms_vec3_sub(outer->max, outer->min);
    const vec3s b = glms_vec3_sub(inner->max, inner->min);
    const bool is_around = outer->min.x <= inner->min.x && outer->max.x >= inner->max.x &&
                           outer->min.z <= inner->min.z && outer->max.z >= inner->max.z;
    return is_around && outer->min.y <= inner->min.y + 0.5f * b.y && a.x > room_factor * b.x &&
           a.z > room_factor * b.z;
}

void framing_init(struct framing *framing, const struct mesh *object, const struct mesh *opaque)
{
    const struct mesh *meshes[] = { object, opaque };
    const struct box inner = mesh_box(object);
    const struct box outer = mesh_box(opaque);
    const bool has_both = object->vertex_count && opaque->vertex_count;
    const bool is_alone = has_both && surrounds(&outer, &inner);
    struct search search;
    *framing = (struct framing){ .box = object->vertex_count ? inner : outer };
    if (is_alone && box_contains(&outer, &inner))
        framing->room = outer;
    if (has_both && !is_alone)
        framing->box = unite(inner, outer);
    search_init(&search);
    for (int m = 0; m < (is_alone ? 1 : 2); m++)
        search_mesh(&search, meshes[m], box_center(framing->box));
    for (int i = 0; i < PAIR_COUNT && search.lowest[i]; i++) {
        framing->points[framing->count++] = search.lowest[i]->position;
        framing->points[framing->count++] = search.highest[i]->position;
    }
}

/* ---- camera ---- */

/* Greatest coordinate of the points along a sloped axis, and least, in camera space. */
struct extent {
    float low, high;
};

/* Pyramid of view that is fitted around the points: the camera's axes and the points. */
struct fit {
    const struct framing *framing;
    const struct framing_view *view;
    struct camera_basis basis;
    vec3s origin;
};

static void extend(struct extent *extent, const struct fit *fit, vec3s p, vec3s axis, float slope)
{
    const float across = glms_vec3_dot(p, axis);
    const float along = slope * glms_vec3_dot(p, fit->basis.forward);
    extent->high = fmaxf(extent->high, across - along);
    extent->low = fmaxf(extent->low, -across - along);
}

/* Returns the planes of two opposite sides of the pyramid: points whose coordinates along `axis`
 * and `forward` are (a, d) satisfy a - slope d <= high and -a - slope d <= low. */
static struct extent find_extent(const struct fit *fit, vec3s axis, float slope)
{
    const int rotations = fit->view->rotates ? ROTATION_COUNT : 1;
    struct extent extent = { -INFINITY, -INFINITY };
    for (int k = 0; k < rotations; k++) {
        const float angle = 2.0f * (float)CGLM_PI * (float)k / (float)rotations;
        const float c = cosf(angle), s = sinf(angle);
        for (uint32_t i = 0; i < fit->framing->count; i++) {
            const vec3s p = glms_vec3_sub(fit->framing->points[i], fit->origin);
            const vec3s turned = { { c * p.x + s * p.z, p.y, c * p.z - s * p.x } };
            extend(&extent, fit, turned, axis, slope);
        }
    }
    return extent;
}

/* Returns the camera's distance from the origin at which the points just fit between two sides. */
static float fitted_distance(const struct fit *fit, vec3s axis, float slope)
{
    const struct extent extent = find_extent(fit, axis, slope);
    return fit->view->target ? fmaxf(extent.low, extent.high) / slope
                             : (extent.low + extent.high) / (2.0f * slope);
}

/* Returns the camera's coordinate along `axis` that centres the bounds at a distance. */
static float centred(const struct fit *fit, vec3s axis, float slope, float distance)
{
    float low = 0.0f;
    float high = slope;
    for (int i = 0; i < 30; i++) {
        const float middle = 0.5f * (low + high);
        if (fitted_distance(fit, axis, middle) > distance)
            low = middle;
        else
            high = middle;
    }
    const struct extent extent = find_extent(fit, axis, high);
    return 0.5f * (extent.high - extent.low);
}

static struct camera fit_camera(const struct fit *fit, float fov_deg)
{
    const struct framing_view *view = fit->view;
    const struct camera_basis *basis = &fit->basis;
    const float slope_y = fill * tanf(glm_rad(fov_deg) / 2.0f);
    const float slope_x = slope_y * view->aspect;
    const float nearest = find_extent(fit, glms_vec3_zero(), 1.0f).high;
    const float size = box_diagonal(fit->framing->box);
    float distance = fmaxf(fitted_distance(fit, basis->right, slope_x),
                           fitted_distance(fit, basis->up, slope_y));
    distance = fmaxf(distance, nearest + (size > 0.0f ? 0.01f * size : 1.0f));
    vec3s eye = glms_vec3_muladds(basis->forward, -distance, fit->origin);
    if (!view->target) {
        eye = glms_vec3_muladds(basis->right, centred(fit, basis->right, slope_x, distance), eye);
        eye = glms_vec3_muladds(basis->up, centred(fit, basis->up, slope_y, distance), eye);
    }
    return (struct camera){
        .eye = eye,
        .target = glms_vec3_muladds(basis->forward, distance, eye),
        .fov_deg = fov_deg,
    };
}

/* Returns true if the point is inside the box, with a margin. */
static bool is_inside(const struct box *box, vec3s point)
{
    const vec3s margin = glms_vec3_scale(glms_vec3_sub(box->max, box->min), 0.05f);
    const struct box inner = { glms_vec3_add(box->min, margin), glms_vec3_sub(box->max, margin) };
    const struct box at = { point, point };
    return box_contains(&inner, &at);
}

struct camera framing_camera(const struct framing *framing, const struct framing_view *view)
{
    const vec3s center = box_center(framing->box);
    const struct camera axes = camera_orbit(azimuth_deg, elevation_deg, 1.0f, (vec3s){ 0 }, 1.0f);
    const struct fit fit = {
        .framing = framing,
        .view = view,
        .basis = camera_basis(&axes),
        .origin = view->target ? *view->target : center,
    };
    const bool has_room = box_diagonal(framing->room) > 0.0f;
    if (view->fov_deg > 0.0f)
        return fit_camera(&fit, view->fov_deg);
    struct camera camera = fit_camera(&fit, default_fov_deg);
    for (float fov = default_fov_deg; has_room && fov <= widest_fov_deg; fov += 4.0f) {
        camera = fit_camera(&fit, fov);
        if (is_inside(&framing->room, camera.eye))
            return camera;
    }
    return camera;
}
