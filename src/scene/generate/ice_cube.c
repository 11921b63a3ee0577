/* ice_cube.c: generates a rounded cube of six grids, displaced by noise. The grids meet without
 * gaps, because the noise depends only on position. Smooth noise avoids self-intersections. */
#include "src/scene/generate/generate.h"

#include <cglm/struct.h>
#include <math.h>

#include "src/scene/generate/noise.h"

static const float rounding = 0.18F; /* edge radius, for a half width of 1 */

static uint32_t choose_cells(uint32_t triangles)
{
    double target = fmin(triangles, GENERATE_TRIANGLES_MAX);
    uint32_t n = (uint32_t)fmax(1, floor(sqrt(target / 12)));
    double fewer = 12.0 * n * n;
    double more = 12.0 * (n + 1) * (n + 1);
    return more - target < target - fewer ? n + 1 : n;
}

/* Returns the vertex index of a surface point in a lattice of (n + 1)^3 points. Layers ascend with
 * at[2]. The first and last layers are full squares. The layers between are rings of 4n points. */
static uint32_t surface_index(const uint32_t at[3], uint32_t n)
{
    uint32_t i = at[0], j = at[1], k = at[2];
    uint32_t layer = (n + 1) * (n + 1);
    if (k == 0)
        return j * (n + 1) + i;
    if (k == n)
        return layer + (n - 1) * 4 * n + j * (n + 1) + i;
    uint32_t ring = layer + (k - 1) * 4 * n;
    if (j == 0 && i < n)
        return ring + i;
    if (i == n && j < n)
        return ring + n + j;
    if (j == n && i > 0)
        return ring + 3 * n - i;
    return ring + 4 * n - j;
}

/* Returns a lattice coordinate. Lattice lines are denser near edges, where curvature is high. */
static float lattice_coordinate(uint32_t i, uint32_t n)
{
    float t = 2 * (float)i / (float)n - 1;
    return t * (1.25F - 0.25F * t * t);
}

static vec3s surface_point(const uint32_t at[3], uint32_t n)
{
    vec3s cube = { {
        lattice_coordinate(at[0], n),
        lattice_coordinate(at[1], n),
        lattice_coordinate(at[2], n),
    } };
    vec3s core = glms_vec3_clamp(cube, rounding - 1, 1 - rounding);
    vec3s outward = glms_vec3_normalize(glms_vec3_sub(cube, core));
    vec3s p = glms_vec3_muladds(outward, rounding, core);
    vec3s displaced = p;
    displaced = glms_vec3_muladds(noise_vector(glms_vec3_scale(p, 0.75F), 11), 0.12F, displaced);
    displaced = glms_vec3_muladds(noise_vector(glms_vec3_scale(p, 2.1F), 12), 0.022F, displaced);
    return glms_vec3_muladds(noise_vector(glms_vec3_scale(p, 4.7F), 13), 0.008F, displaced);
}

/* Adds one side of the cube, perpendicular to `axis` at lattice coordinate 0 or n. */
static uint32_t *add_side(struct mesh *mesh, uint32_t *out, int axis, uint32_t coordinate,
                          uint32_t n)
{
    int right = (axis + 1) % 3;
    int up = (axis + 2) % 3;
    for (uint32_t j = 0; j <= n; j++) {
        for (uint32_t i = 0; i <= n; i++) {
            uint32_t at[3];
            at[axis] = coordinate;
            at[right] = i;
            at[up] = j;
            uint32_t a = surface_index(at, n);
            mesh->vertices[a].position = surface_point(at, n);
            mesh->vertices[a].color = glms_vec3_one();
            if (i == n || j == n)
                continue;
            at[right] = i + 1;
            uint32_t b = surface_index(at, n);
            at[up] = j + 1;
            uint32_t c = surface_index(at, n);
            at[right] = i;
            uint32_t d = surface_index(at, n);
            bool far_side = coordinate == n;
            *out++ = a;
            *out++ = far_side ? b : c;
            *out++ = far_side ? c : b;
            *out++ = a;
            *out++ = far_side ? c : d;
            *out++ = far_side ? d : c;
        }
    }
    return out;
}

bool generate_ice_cube(struct mesh *mesh, uint32_t triangles)
{
    uint32_t n = choose_cells(triangles);
    if (!mesh_init(mesh, 6 * n * n + 2, 36 * n * n))
        return false;
    uint32_t *out = mesh->indices;
    for (int axis = 0; axis < 3; axis++) {
        out = add_side(mesh, out, axis, 0, n);
        out = add_side(mesh, out, axis, n, n);
    }
    mesh_fit(mesh, 1.6F);
    mesh_make_normals(mesh);
    return true;
}
