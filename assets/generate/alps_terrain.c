/*
 * alps_terrain.c: generates a mountain height field by noise and erosion.
 *
 * Ridged multifractal noise (Musgrave 1994) and slope-damped fBm (Quilez 2008) give the shape.
 * Droplet-based hydraulic erosion (Beyer 2015) then carves valleys, and thermal erosion limits
 * slopes to the angle of repose.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "assets/generate/alps.h"

enum {
    BRUSH = 3,
    BRUSH_NODES = (2 * BRUSH + 1) * (2 * BRUSH + 1),
    DROP_STEPS = 48,
    SLIDES = 24
};

static const float inner_width = 28000.0F, outer_width = 110000.0F; /* metres */
static const float peak = 3700.0F; /* height of the peaks above the lake, metres */
static const float repose = 0.80F; /* steepest slope of scree, rise per run */

static uint32_t hash(uint32_t x, uint32_t z, uint32_t seed)
{
    uint32_t h = x * 0x9E3779B1U ^ z * 0x85EBCA77U ^ seed * 0xC2B2AE3DU;
    h = (h ^ h >> 15) * 0x2C1B3C6DU;
    h = (h ^ h >> 12) * 0x297A2D39U;
    return h ^ h >> 15;
}

static float random_unit(uint32_t *state)
{
    *state = *state * 747796405U + 2891336453U;
    const uint32_t word = (*state >> (*state >> 28) % 8 ^ *state) * 277803737U;
    return (float)(word >> 8) / 16777216.0F;
}

static float corner(int x, int z, uint32_t seed)
{
    return (float)(hash((uint32_t)x, (uint32_t)z, seed) >> 8) / 8388608.0F - 1.0F;
}

/* Returns value noise within -1 and 1 in .x, its derivatives in .y and .z. */
static vec3s value_noise(float x, float z, uint32_t seed)
{
    const float fx = floorf(x), fz = floorf(z), u = x - fx, v = z - fz;
    const int ix = (int)fx, iz = (int)fz;
    const float a = corner(ix, iz, seed), b = corner(ix + 1, iz, seed);
    const float c = corner(ix, iz + 1, seed), d = corner(ix + 1, iz + 1, seed);
    const float su = u * u * u * (u * (u * 6.0F - 15.0F) + 10.0F);
    const float sv = v * v * v * (v * (v * 6.0F - 15.0F) + 10.0F);
    const float du = 30.0F * u * u * (u * (u - 2.0F) + 1.0F);
    const float dv = 30.0F * v * v * (v * (v - 2.0F) + 1.0F);
    const float k = a - b - c + d;
    return (vec3s){ {
        a + (b - a) * su + (c - a) * sv + k * su * sv,
        du * ((b - a) + k * sv),
        dv * ((c - a) + k * su),
    } };
}

float alps_noise(float x, float z, float wavelength, int octaves, uint32_t seed)
{
    float sum = 0.0F, share = 0.5F, px = x / wavelength, pz = z / wavelength;
    for (int i = 0; i < octaves; i++, share *= 0.5F) {
        sum += share * value_noise(px, pz, seed + (uint32_t)i).x;
        const float turned = 2.0F * (0.8F * px - 0.6F * pz);
        pz = 2.0F * (0.6F * px + 0.8F * pz);
        px = turned;
    }
    return sum;
}

/* fBm with smooth slopes and rough crests: octaves are damped where the sum is steep (Quilez). */
static float damped_noise(float x, float z, float wavelength, int octaves, uint32_t seed)
{
    float sum = 0.0F, share = 0.5F, dx = 0.0F, dz = 0.0F, px = x / wavelength, pz = z / wavelength;
    for (int i = 0; i < octaves; i++, share *= 0.5F) {
        const vec3s n = value_noise(px, pz, seed + (uint32_t)i);
        dx += n.y;
        dz += n.z;
        sum += share * n.x / (1.0F + 0.5F * (dx * dx + dz * dz));
        const float turned = 2.0F * (0.8F * px - 0.6F * pz);
        pz = 2.0F * (0.6F * px + 0.8F * pz);
        px = turned;
    }
    return sum;
}

static float ridged_noise(float x, float z, float wavelength, int octaves, uint32_t seed)
{
    float sum = 0.0F, weight = 1.0F, share = 0.5F, px = x / wavelength, pz = z / wavelength;
    for (int i = 0; i < octaves; i++, share *= 0.52F) {
        float ridge = 1.0F - fabsf(value_noise(px, pz, seed + (uint32_t)i).x);
        ridge = ridge * ridge * weight;
        weight = glm_clamp(2.0F * ridge, 0.0F, 1.0F);
        sum += share * ridge;
        const float turned = 2.0F * (0.8F * px - 0.6F * pz);
        pz = 2.0F * (0.6F * px + 0.8F * pz);
        px = turned;
    }
    return sum;
}

/* Returns the height before erosion: a lake in the middle, meadows and hills around it, then
 * mountains; rotated so that the finest peaks are beside the sun. */
static float base_height(float east, float south)
{
    const float x = -0.174F * east - 0.985F * south, z = 0.985F * east - 0.174F * south;
    const float from_eye = sqrtf(x * x + z * z);
    const float bend = 900.0F;
    const float wx = x + bend * alps_noise(x, z, 5200.0F, 3, 11);
    const float wz = z + bend * alps_noise(x, z, 5200.0F, 3, 17);
    const float broad = 0.5F + 0.5F * alps_noise(x, z, 9000.0F, 2, 5);
    const float shore = ALPS_LAKE_SHORE * (1.0F + 0.45F * alps_noise(x, z, 700.0F, 3, 3));
    const float land = glm_smoothstep(shore * 0.8F, shore * 1.6F, from_eye);
    const float mountains = glm_smoothstep(3000.0F, 12500.0F, from_eye) * (0.45F + 0.75F * broad);
    const float rough = 0.65F * ridged_noise(wx, wz, 5600.0F, 8, 23) +
                        0.35F * (0.6F + damped_noise(wx, wz, 4200.0F, 9, 41));
    const float hills = 40.0F * (0.6F + alps_noise(x, z, 900.0F, 6, 71)) +
                        650.0F * glm_smoothstep(600.0F, 3000.0F, from_eye) *
                            (0.75F + damped_noise(wx, wz, 3000.0F, 7, 73));
    return -6.0F + land * (10.0F + hills) + peak * mountains * rough;
}

static float at(const struct alps_grid *grid, int x, int z)
{
    const int last = (int)grid->side - 1;
    x = x < 0 ? 0 : x > last ? last : x;
    z = z < 0 ? 0 : z > last ? last : z;
    return grid->heights[(size_t)z * grid->side + (size_t)x];
}

/* Catmull-Rom spline for bicubic interpolation of the grid. */
static float spline(float a, float b, float c, float d, float t)
{
    return b + 0.5F * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

static float grid_height(const struct alps_grid *grid, float x, float z, float *flow)
{
    const float px = (x / grid->width + 0.5F) * (float)(grid->side - 1);
    const float pz = (z / grid->width + 0.5F) * (float)(grid->side - 1);
    const int ix = (int)floorf(px), iz = (int)floorf(pz);
    const float u = px - (float)ix, v = pz - (float)iz;
    float rows[4];
    for (int i = 0; i < 4; i++)
        rows[i] = spline(at(grid, ix - 1, iz + i - 1), at(grid, ix, iz + i - 1),
                         at(grid, ix + 1, iz + i - 1), at(grid, ix + 2, iz + i - 1), u);
    const int last = (int)grid->side - 1;
    const int fx = ix < 0 ? 0 : ix > last ? last : ix, fz = iz < 0 ? 0 : iz > last ? last : iz;
    *flow = grid->flow[(size_t)fz * grid->side + (size_t)fx];
    return spline(rows[0], rows[1], rows[2], rows[3], v);
}

float alps_height(const struct alps *alps, float x, float z, float *flow)
{
    const float edge = fmaxf(fabsf(x), fabsf(z)) / alps->inner.width;
    const float share = glm_smoothstep(0.36F, 0.48F, edge);
    float outer_flow = 0.0F, outer = 0.0F, inner = 0.0F;
    *flow = 0.0F;
    if (share < 1.0F)
        inner = grid_height(&alps->inner, x, z, flow);
    if (share > 0.0F)
        outer = grid_height(&alps->outer, x, z, &outer_flow);
    *flow += share * (outer_flow - *flow);
    return inner + share * (outer - inner);
}

/* Returns the bilinearly interpolated height in .x, slope in .y and .z, in units of cells. */
static vec3s slope_at(const struct alps_grid *grid, float x, float z)
{
    const int ix = (int)x, iz = (int)z;
    const float u = x - (float)ix, v = z - (float)iz;
    const float a = at(grid, ix, iz), b = at(grid, ix + 1, iz);
    const float c = at(grid, ix, iz + 1), d = at(grid, ix + 1, iz + 1);
    return (vec3s){ {
        (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v,
        (b - a) * (1 - v) + (d - c) * v,
        (c - a) * (1 - u) + (d - b) * u,
    } };
}

static void deposit(struct alps_grid *grid, float x, float z, float amount)
{
    const size_t ix = (size_t)x, iz = (size_t)z, side = grid->side;
    const float u = x - (float)ix, v = z - (float)iz;
    float *h = &grid->heights[iz * side + ix];
    h[0] += amount * (1 - u) * (1 - v);
    h[1] += amount * u * (1 - v);
    h[side] += amount * (1 - u) * v;
    h[side + 1] += amount * u * v;
}

/* Computes cone-shaped weights for eroding soil around a node. Returns the sum of the weights. */
static float cone(const struct alps_grid *grid, int x, int z, float *shares)
{
    const int last = (int)grid->side - 1;
    float whole = 0.0F;
    for (int k = 0; k < BRUSH_NODES; k++) {
        const int i = k % (2 * BRUSH + 1) - BRUSH, j = k / (2 * BRUSH + 1) - BRUSH;
        const bool inside = x + i >= 0 && z + j >= 0 && x + i <= last && z + j <= last;
        shares[k] = inside ? fmaxf(0.0F, BRUSH - sqrtf((float)(i * i + j * j))) : 0.0F;
        whole += shares[k];
    }
    return whole;
}

static void erode(struct alps_grid *grid, int x, int z, float amount)
{
    float shares[BRUSH_NODES];
    const float whole = cone(grid, x, z, shares);
    for (int k = 0; k < BRUSH_NODES; k++) {
        const int i = k % (2 * BRUSH + 1) - BRUSH, j = k / (2 * BRUSH + 1) - BRUSH;
        if (shares[k] > 0.0F)
            grid->heights[(size_t)(z + j) * grid->side + (size_t)(x + i)] -=
                amount * shares[k] / whole;
    }
}

/* Simulates one droplet of hydraulic erosion; heights are in units of cells. */
static void simulate_droplet(struct alps_grid *grid, uint32_t *random)
{
    const float edge = (float)(grid->side - 2);
    float x = random_unit(random) * edge, z = random_unit(random) * edge;
    float dx = 0.0F, dz = 0.0F, speed = 1.0F, water = 1.0F, soil = 0.0F;
    for (int step = 0; step < DROP_STEPS; step++) {
        const vec3s here = slope_at(grid, x, z);
        dx = dx * 0.05F - here.y * 0.95F;
        dz = dz * 0.05F - here.z * 0.95F;
        const float length = sqrtf(dx * dx + dz * dz);
        if (length < 1e-6F || here.x < 0.0F) /* flat, or in the lake */
            break;
        dx /= length;
        dz /= length;
        const float nx = x + dx, nz = z + dz;
        if (nx < 1.0F || nz < 1.0F || nx >= edge || nz >= edge)
            break;
        const float fall = here.x - slope_at(grid, nx, nz).x;
        const float room = fmaxf(fall * speed * water * 4.0F, 0.01F);
        if (soil > room || fall < 0.0F) {
            const float left = fall < 0.0F ? fminf(-fall, soil) : (soil - room) * 0.3F;
            soil -= left;
            deposit(grid, x, z, left);
        } else {
            const float taken = fminf((room - soil) * 0.3F, fall);
            soil += taken;
            erode(grid, (int)x, (int)z, taken);
        }
        grid->flow[(size_t)z * grid->side + (size_t)x] += water;
        speed = sqrtf(fmaxf(0.0F, speed * speed + fall * 4.0F));
        water *= 0.99F;
        x = nx;
        z = nz;
    }
}

/* Moves part of the material in excess of the steepest slope to lower neighbours. */
static void slide_cell(float *height, ptrdiff_t row, float steepest)
{
    const ptrdiff_t neighbours[] = { 1, row, -1, -row };
    for (int i = 0; i < 4; i++) {
        float *other = height + neighbours[i];
        const float excess = fmaxf(0.0F, *height - *other - steepest);
        *height -= 0.25F * excess;
        *other += 0.25F * excess;
    }
}

static void thermal_erosion(struct alps_grid *grid, float steepest)
{
    for (uint32_t z = 1; z + 1 < grid->side; z++)
        for (uint32_t x = 1; x + 1 < grid->side; x++)
            slide_cell(&grid->heights[(size_t)z * grid->side + x], (ptrdiff_t)grid->side, steepest);
}

static bool make_grid(struct alps_grid *grid, float width, uint32_t side, uint32_t droplets)
{
    const size_t count = (size_t)side * side;
    *grid = (struct alps_grid){
        .side = side,
        .width = width,
        .heights = malloc(count * sizeof(float)),
        .flow = calloc(count, sizeof(float)),
    };
    if (!grid->heights || !grid->flow)
        return false;
    const float cell = width / (float)(side - 1);
    for (uint32_t z = 0; z < side; z++)
        for (uint32_t x = 0; x < side; x++)
            grid->heights[(size_t)z * side + x] =
                base_height((float)x * cell - 0.5F * width, (float)z * cell - 0.5F * width) / cell;
    uint32_t random = 1;
    for (uint32_t i = 0; i < droplets; i++)
        simulate_droplet(grid, &random);
    for (int i = 0; i < SLIDES; i++)
        thermal_erosion(grid, repose);
    for (size_t i = 0; i < count; i++)
        grid->heights[i] *= cell;
    return true;
}

bool alps_make(struct alps *alps, uint32_t side)
{
    *alps = (struct alps){ 0 };
    const uint32_t nodes = side * side;
    return make_grid(&alps->inner, inner_width, side, nodes) &&
           make_grid(&alps->outer, outer_width, side, nodes / 4);
}

void alps_free(struct alps *alps)
{
    free(alps->inner.heights);
    free(alps->inner.flow);
    free(alps->outer.heights);
    free(alps->outer.flow);
}
