/*
 * crack_meshes.c: generates crack sheets inside an object (Seipel and Nivfors 2006, section 3.3). A
 * few generic sheets are scaled to the object's box, randomly rotated, and placed near the centre.
 * Uses only floor and sqrt of the C library, because other functions differ between machines.
 */
#include <cglm/struct.h>
#include <math.h>
#include "shaders/inclusions/cracks.h"
#include "src/scene/generate/generate.h"
#include "src/scene/generate/noise.h"

enum {
    CELLS = 20, /* number of cells along a sheet's side */
    POINTS = (CELLS + 1) * (CELLS + 1),
    MODEL_COUNT = 3,
};

static float bent_height(float x, float y, float r)
{
    (void)r;
    return 0.45F * x * x + 0.12F * x * y - 0.15F;
}

static float twisted_height(float x, float y, float r)
{
    (void)r;
    return 0.7F * x * y + 0.1F * x;
}

/* Returns the height of a bowl with ripples around its centre (conchoidal fracture). */
static float shell_height(float x, float y, float r)
{
    float wave = noise_value((vec3s){ { 5.5F * r, 0.4F * x, 0.4F * y } }, 7);
    return 0.5F * r * r + 0.07F * wave - 0.25F;
}

/* Returns the radius of a sheet's irregular outline in a direction. */
static float outline(vec3s dir, uint32_t seed)
{
    return 0.85F + 0.3F * noise_value(glms_vec3_scale(dir, 1.3F), seed) +
           0.12F * noise_value(glms_vec3_scale(dir, 5.0F), seed + 1);
}

/* Maps a point of the unit square to a disc (elliptical grid mapping), and displaces it. */
static vec3s sheet_point(float u, float v, uint32_t model)
{
    static float (*const heights[MODEL_COUNT])(
        float x, float y, float r) = { bent_height, twisted_height, shell_height };
    vec3s p = { { u * sqrtf(1.0F - v * v / 2.0F), v * sqrtf(1.0F - u * u / 2.0F), 0.0F } };
    float r = glms_vec3_norm(p);
    if (r > 0.0F)
        p = glms_vec3_scale(p, outline(glms_vec3_divs(p, r), 100 * model));
    r = glms_vec3_norm(p);
    p.z = heights[model](p.x, p.y, r) +
          0.05F * noise_fractal(glms_vec3_scale(p, 2.5F), 3, 100 * model + 50);
    return p;
}

static bool make_sheet(struct mesh *mesh, uint32_t model)
{
    if (!mesh_init(mesh, POINTS, 6 * CELLS * CELLS))
        return false;
    for (uint32_t i = 0; i < POINTS; i++) {
        uint32_t row = i / (CELLS + 1);
        uint32_t column = i % (CELLS + 1);
        vec2s uv = { { (float)column / CELLS, (float)row / CELLS } };
        const float u = 2.0F * uv.x - 1.0F, v = 2.0F * uv.y - 1.0F;
        const float gap = (1.0F - u * u) * (1.0F - v * v); /* 1 minus squared disc radius */
        mesh->vertices[i] = (struct mesh_vertex){
            .position = sheet_point(u, v, model),
            .color = { { gap, gap, gap } },
            .uv = uv,
        };
    }
    uint32_t *out = mesh->indices;
    for (uint32_t cell = 0; cell < CELLS * CELLS; cell++) {
        uint32_t a = cell / CELLS * (CELLS + 1) + cell % CELLS;
        const uint32_t corners[] = { a, a + 1, a + CELLS + 2, a, a + CELLS + 2, a + CELLS + 1 };
        for (int k = 0; k < 6; k++)
            *out++ = corners[k];
    }
    mesh_make_normals(mesh);
    return true;
}

/* Returns the next number of a random sequence, from -1 to 1. */
static float random_value(uint32_t *state)
{
    *state += 0x9e3779b9U;
    return (float)(noise_hash(*state) >> 8) / 8388607.5F - 1.0F;
}

/* Returns a random point of the unit ball of `count` dimensions, at least 0.1 from its centre. */
static vec4s random_in_ball(uint32_t *state, int count)
{
    vec4s v = { 0 };
    float norm2 = 0.0F;
    while (norm2 < 0.01F || norm2 > 1.0F) {
        for (int i = 0; i < count; i++)
            v.raw[i] = random_value(state);
        norm2 = glms_vec4_norm2(v);
    }
    return v;
}

static bool add_crack(struct mesh *mesh, const struct mesh *sheet, struct box box,
                      float relative_size, uint32_t *state)
{
    float half = box_diagonal(box) / 2.0F;
    float size = relative_size * half * (0.8F + 0.15F * random_value(state));
    vec4s axis = random_in_ball(state, 4);
    versors rotation = glms_quat_normalize((versors){ { axis.x, axis.y, axis.z, axis.w } });
    vec3s shift = glms_vec3_scale(glms_vec3(random_in_ball(state, 3)), 0.3F * half);
    vec3s at = glms_vec3_add(box_center(box), shift);
    uint32_t first = mesh->vertex_count;
    if (!mesh_append(mesh, sheet))
        return false;
    for (uint32_t i = first; i < mesh->vertex_count; i++) {
        struct mesh_vertex *v = &mesh->vertices[i];
        vec3s rotated = glms_quat_rotatev(rotation, v->position);
        v->position = glms_vec3_muladds(rotated, size, at);
        v->normal = glms_vec3_normalize(glms_quat_rotatev(rotation, v->normal));
    }
    return true;
}

bool generate_cracks(struct mesh *mesh, struct box box, const struct generate_cracks *params,
                     const struct mesh *custom_sheet)
{
    struct mesh sheets[MODEL_COUNT] = { 0 };
    const uint32_t sheet_count = params->count < CRACKS_MAX ? params->count : CRACKS_MAX;
    bool done = true;
    *mesh = (struct mesh){ 0 };
    for (uint32_t i = 0; i < MODEL_COUNT && done; i++)
        done = custom_sheet->index_count || make_sheet(&sheets[i], i);
    for (uint32_t i = 0; i < sheet_count && done; i++) {
        /* independent of the number of cracks */
        uint32_t state = noise_hash(noise_hash(params->seed) ^ i);
        done = add_crack(mesh, custom_sheet->index_count ? custom_sheet : &sheets[i % MODEL_COUNT],
                         box, params->size, &state);
    }
    for (uint32_t i = 0; i < MODEL_COUNT; i++)
        mesh_finish(&sheets[i]);
    if (!done)
        mesh_finish(mesh);
    return done;
}
