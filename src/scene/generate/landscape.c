/* landscape.c: generates a valley of flat-shaded facets. Facets and patches of different colours
 * keep the surroundings recognisable through refraction. */
#include "src/scene/generate/generate.h"

#include <cglm/struct.h>
#include <math.h>

#include "src/scene/generate/noise.h"

static const float half_width = 30;
static const float floor_level = -1.35F;

struct grid {
    uint32_t columns, rows;
};

static struct grid choose_grid(uint32_t triangles)
{
    /* columns and rows in the proportion 30 : 39 (Seipel and Nivfors 2006) */
    double cells = fmax(fmin(triangles, GENERATE_TRIANGLES_MAX) / 2, 1);
    double rows = fmax(1, round(sqrt(cells * 39 / 30)));
    double columns = fmax(1, round(cells / rows));
    return (struct grid){ (uint32_t)columns, (uint32_t)rows };
}

static float smooth_step(float from, float to, float x)
{
    float t = glm_clamp((x - from) / (to - from), 0, 1);
    return t * t * (3 - 2 * t);
}

static float height_at(float x, float z)
{
    vec3s p = { { x, 0, z } };
    float distance = sqrtf(x * x + z * z);
    float hills = smooth_step(6, 29, distance);
    float ridges = 1 - fabsf(noise_fractal(glms_vec3_scale(p, 0.085F), 4, 21));
    float rolling = noise_fractal(glms_vec3_scale(p, 0.17F), 2, 22);
    return floor_level + 0.04F * rolling + hills * (1.5F + 7.5F * ridges + 0.9F * rolling);
}

static vec3s point_at(struct grid grid, uint32_t column, uint32_t row)
{
    float x = 2 * (float)column / (float)grid.columns - 1;
    float z = 2 * (float)row / (float)grid.rows - 1;
    /* jitters inner points, to hide the grid */
    vec3s shift = noise_vector((vec3s){ { (float)column, 0, (float)row } }, 23);
    if (column > 0 && column < grid.columns)
        x += 0.5F * shift.x / (float)grid.columns;
    if (row > 0 && row < grid.rows)
        z += 0.5F * shift.z / (float)grid.rows;
    x *= half_width;
    z *= half_width;
    return (vec3s){ { x, height_at(x, z), z } };
}

static vec3s mix(vec3s from, vec3s to, float from_x, float to_x, float x)
{
    return glms_vec3_lerp(from, to, smooth_step(from_x, to_x, x));
}

/* Returns a facet's colour: meadows in the valley, forest and autumn trees on slopes, rock, snow.
 */
static vec3s facet_color(vec3s center, vec3s normal)
{
    static const vec3s grass = { { 0.085F, 0.150F, 0.042F } };
    static const vec3s straw = { { 0.340F, 0.270F, 0.115F } };
    static const vec3s heather = { { 0.205F, 0.125F, 0.180F } };
    static const vec3s forest = { { 0.022F, 0.065F, 0.040F } };
    static const vec3s autumn = { { 0.330F, 0.125F, 0.030F } };
    static const vec3s rock = { { 0.190F, 0.180F, 0.185F } };
    static const vec3s snow = { { 0.85F, 0.89F, 0.95F } };
    float meadow_field = noise_fractal(glms_vec3_scale(center, 0.23F), 2, 31);
    float heather_field = noise_fractal(glms_vec3_scale(center, 0.31F), 2, 32);
    float tree_field = noise_fractal(glms_vec3_scale(center, 0.16F), 3, 33);
    float grain = noise_value(glms_vec3_scale(center, 3.1F), 34);
    float height = center.y - floor_level + 0.5F * grain;

    vec3s color = mix(grass, straw, -0.1F, 0.35F, meadow_field);
    color = mix(color, heather, 0.3F, 0.5F, heather_field);
    vec3s trees = mix(forest, autumn, 0.05F, 0.3F, tree_field);
    color = mix(color, trees, 1.4F, 2.2F, height);
    color = mix(color, rock, 0.22F, 0.38F, 1 - normal.y + 0.1F * grain);
    color = mix(color, rock, 4.6F, 5.6F, height);
    color = mix(color, snow, 6, 6.8F, height - 2 * (1 - normal.y));
    return glms_vec3_scale(color, 1 + 0.22F * grain);
}

static void add_facet(struct mesh *mesh, uint32_t first, vec3s a, vec3s b, vec3s c)
{
    vec3s normal = glms_vec3_crossn(glms_vec3_sub(b, a), glms_vec3_sub(c, a));
    vec3s center = glms_vec3_scale(glms_vec3_add(glms_vec3_add(a, b), c), 1 / 3.0F);
    const vec3s corners[3] = { a, b, c };
    for (uint32_t k = 0; k < 3; k++) {
        mesh->vertices[first + k] = (struct mesh_vertex){
            .position = corners[k],
            .normal = normal,
            .color = facet_color(center, normal),
        };
        mesh->indices[first + k] = first + k;
    }
}

bool generate_landscape(struct mesh *mesh, uint32_t triangles)
{
    struct grid grid = choose_grid(triangles);
    uint32_t corners = 6 * grid.columns * grid.rows;
    if (!mesh_init(mesh, corners, corners))
        return false;
    uint32_t first = 0;
    for (uint32_t row = 0; row < grid.rows; row++) {
        for (uint32_t column = 0; column < grid.columns; column++, first += 6) {
            vec3s a = point_at(grid, column, row);
            vec3s b = point_at(grid, column, row + 1);
            vec3s c = point_at(grid, column + 1, row + 1);
            vec3s d = point_at(grid, column + 1, row);
            if ((row + column) % 2 == 0) { /* a herringbone pattern hides the grid */
                add_facet(mesh, first, a, b, c);
                add_facet(mesh, first + 3, a, c, d);
            } else {
                add_facet(mesh, first, a, b, d);
                add_facet(mesh, first + 3, b, c, d);
            }
        }
    }
    return true;
}
