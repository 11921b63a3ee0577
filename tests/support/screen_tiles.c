/* screen_tiles.c: lists for each screen tile the triangles that may cover it. */
#include "tests/support/screen_tiles.h"

#include <stdlib.h>

#include "tests/support/assertions.h"

enum {
    TILE = 8, /* width and height in pixels */
};

static const double pi = 3.14159265358979323846;

/* Range of tile columns and rows, inclusive; empty if low > high. */
struct bounds {
    int64_t low[2], high[2];
};

/* Projects a point to image coordinates, in pixels from the top left. */
static void project(const struct picture_request *request, struct vec point, double at[2])
{
    const struct camera *camera = &request->camera;
    const struct vec world_up = { 0, 1, 0 };
    const struct vec given = vec_from(camera->up);
    const struct vec forward =
        vec_unit(vec_add(vec_from(camera->target), -1, vec_from(camera->eye)));
    const struct vec right = vec_unit(vec_cross(forward, vec_norm(given) > 0 ? given : world_up));
    const struct vec from = vec_add(point, -1, vec_from(camera->eye));
    const double depth = vec_dot(from, forward);
    const double scale = request->height / (2 * tan((double)camera->fov_deg * pi / 360)) / depth;
    assert_true(depth > 0);
    at[0] = request->width / 2.0 + vec_dot(from, right) * scale;
    at[1] = request->height / 2.0 - vec_dot(from, vec_cross(right, forward)) * scale;
}

/* Returns the tiles of a triangle's bounds, enlarged by 0.01 pixels against rounding errors. */
static struct bounds bounds_of(const struct mesh *mesh, uint32_t corner,
                               const struct picture_request *request)
{
    const uint32_t size[2] = { request->width, request->height };
    double low[2] = { HUGE_VAL, HUGE_VAL };
    double high[2] = { -HUGE_VAL, -HUGE_VAL };
    struct bounds bounds;
    for (uint32_t k = 0; k < 3; k++) {
        double at[2];
        project(request, vec_from(mesh->vertices[mesh->indices[corner + k]].position), at);
        for (size_t axis = 0; axis < 2; axis++) {
            low[axis] = fmin(low[axis], at[axis] - 0.01);
            high[axis] = fmax(high[axis], at[axis] + 0.01);
        }
    }
    for (size_t axis = 0; axis < 2; axis++) {
        bounds.low[axis] = (int64_t)(fmax(low[axis], 0) / TILE);
        bounds.high[axis] =
            high[axis] < 0 ? -1 : (int64_t)(fmin(high[axis], size[axis] - 1) / TILE);
    }
    return bounds;
}

/* Counting sort: counts a triangle in its tiles or, with `corners`, lists it there. */
static void add_triangle(struct tiles *tiles, uint32_t corner, uint32_t *corners)
{
    const struct bounds b = bounds_of(tiles->mesh, corner, tiles->request);
    for (int64_t y = b.low[1]; y <= b.high[1]; y++) {
        for (int64_t x = b.low[0]; x <= b.high[0]; x++) {
            uint32_t *count = &tiles->first[y * tiles->columns + x];
            if (corners)
                corners[--*count] = corner;
            else
                ++*count;
        }
    }
}

void screen_tiles_init(struct tiles *tiles, const struct mesh *mesh,
                       const struct picture_request *request)
{
    const uint32_t columns = (request->width + TILE - 1) / TILE;
    const uint32_t rows = (request->height + TILE - 1) / TILE;
    *tiles = (struct tiles){ mesh, request, columns, NULL, NULL };
    const size_t count = (size_t)columns * rows;
    tiles->first = calloc(count + 1, sizeof(*tiles->first));
    assert_non_null(tiles->first);
    for (uint32_t i = 0; i < mesh->index_count; i += 3)
        add_triangle(tiles, i, NULL);
    for (size_t t = 1; t <= count; t++)
        tiles->first[t] += tiles->first[t - 1]; /* end of each list for now */
    tiles->corners = calloc((size_t)tiles->first[count] + 1, sizeof(*tiles->corners));
    assert_non_null(tiles->corners);
    for (uint32_t i = 0; i < mesh->index_count; i += 3)
        add_triangle(tiles, i, tiles->corners);
}

void screen_tiles_finish(struct tiles *tiles)
{
    free(tiles->first);
    free(tiles->corners);
    *tiles = (struct tiles){ 0 };
}

/* Returns the ray parameter of the intersection with a triangle; negative if there is none. */
static double intersect(const struct mesh *mesh, uint32_t index, struct vec eye, struct vec ray)
{
    const struct vec a = vec_from(mesh->vertices[mesh->indices[index]].position);
    const struct vec b = vec_from(mesh->vertices[mesh->indices[index + 1]].position);
    const struct vec c = vec_from(mesh->vertices[mesh->indices[index + 2]].position);
    const struct vec ab = vec_add(b, -1, a);
    const struct vec ac = vec_add(c, -1, a);
    const struct vec across = vec_cross(ray, ac);
    const double area = vec_dot(ab, across);
    const struct vec from = vec_add(eye, -1, a);
    const double u = vec_dot(from, across) / area;
    const struct vec up = vec_cross(from, ab);
    const double v = vec_dot(ray, up) / area;
    if (!(u >= 0 && v >= 0 && u + v <= 1))
        return -1;
    return vec_dot(ac, up) / area;
}

size_t screen_tiles_trace(const struct tiles *tiles, size_t i, double *hits, size_t hits_max)
{
    const struct picture_request *request = tiles->request;
    const struct vec eye = vec_from(request->camera.eye);
    const struct vec ray = picture_pixel_ray(request, i);
    const size_t tile = i / request->width / TILE * tiles->columns + i % request->width / TILE;
    size_t count = 0;
    for (uint32_t k = tiles->first[tile]; k < tiles->first[tile + 1]; k++) {
        const double t = intersect(tiles->mesh, tiles->corners[k], eye, ray);
        if (t < 0)
            continue;
        assert_true(count < hits_max);
        hits[count++] = t;
    }
    return count;
}
