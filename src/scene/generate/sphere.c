/* sphere.c: generates a unit UV sphere (longitudes and latitudes). */
#include "src/scene/generate/generate.h"

#include <cglm/struct.h>
#include <math.h>

/* Grid of `rows` bands between latitudes. Each has `columns` quads, or triangles at the poles. */
struct grid {
    uint32_t rows, columns;
};

static struct grid choose_grid(uint32_t triangles)
{
    /* There are 2 * columns * (rows - 1) triangles. Quads are nearly square if columns = 2 rows. */
    double target = fmax(fmin(triangles, GENERATE_TRIANGLES_MAX), 6);
    double rows = fmax(2, round((1 + sqrt(1 + target)) / 2));
    double columns = fmax(3, round(target / (2 * (rows - 1))));
    return (struct grid){ (uint32_t)rows, (uint32_t)columns };
}

static void add_vertex(struct mesh_vertex *vertex, double latitude, double longitude)
{
    vec3s p = { {
        (float)(cos(latitude) * sin(longitude)),
        (float)sin(latitude),
        (float)(cos(latitude) * cos(longitude)),
    } };
    *vertex = (struct mesh_vertex){ .position = p, .normal = p, .color = { { 1, 1, 1 } } };
}

/* Adds a triangle, unless two of its corners are the same pole. */
static uint32_t *add_triangle(uint32_t *out, uint32_t a, uint32_t b, uint32_t c)
{
    if (a == b || b == c || c == a)
        return out;
    out[0] = a;
    out[1] = b;
    out[2] = c;
    return out + 3;
}

/* Returns a vertex index. Row 0 and the last row are the poles, with one vertex each. */
static uint32_t vertex_at(struct grid grid, uint32_t row, uint32_t column)
{
    if (row == 0)
        return 0;
    if (row == grid.rows)
        return 1 + (grid.rows - 1) * grid.columns;
    return 1 + (row - 1) * grid.columns + column % grid.columns;
}

/* Scales the sphere until its facets enclose the unit sphere's volume. Each facet is then partly
 * inside and partly outside the unit sphere. This reduces the error of refracted directions to a
 * third. */
static void fill_volume(struct mesh *mesh)
{
    double volume = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const vec3s a = mesh->vertices[mesh->indices[i]].position;
        const vec3s b = mesh->vertices[mesh->indices[i + 1]].position;
        const vec3s c = mesh->vertices[mesh->indices[i + 2]].position;
        volume += (double)glms_vec3_dot(a, glms_vec3_cross(b, c)) / 6;
    }
    const float radius = (float)cbrt(4 * GLM_PI / 3 / volume);
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].position = glms_vec3_scale(mesh->vertices[i].position, radius);
}

bool generate_sphere(struct mesh *mesh, uint32_t triangles)
{
    struct grid grid = choose_grid(triangles);
    uint32_t ring_vertices = (grid.rows - 1) * grid.columns;
    if (!mesh_init(mesh, ring_vertices + 2, 6 * ring_vertices))
        return false;
    for (uint32_t row = 0; row <= grid.rows; row++)
        for (uint32_t column = 0; column < grid.columns; column++)
            add_vertex(&mesh->vertices[vertex_at(grid, row, column)],
                       GLM_PI * (0.5 - (double)row / grid.rows),
                       2 * GLM_PI * (double)column / grid.columns);
    uint32_t *out = mesh->indices;
    for (uint32_t row = 0; row < grid.rows; row++) {
        for (uint32_t column = 0; column < grid.columns; column++) {
            uint32_t a = vertex_at(grid, row, column);
            uint32_t b = vertex_at(grid, row + 1, column);
            uint32_t c = vertex_at(grid, row + 1, column + 1);
            uint32_t d = vertex_at(grid, row, column + 1);
            out = add_triangle(out, a, b, c);
            out = add_triangle(out, a, c, d);
        }
    }
    fill_volume(mesh);
    return true;
}
