/* stage.c: adds the floor of a stage to a model: material, and colours that fade to the horizon. */
#include "src/scene/stage/stage.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"
#include "src/file/half_float.h"
#include "src/scene/generate/generate.h"
#include "src/scene/stage/stage_textures.h"

const char *const stage_ground_names[] = {
    [STAGE_AUTO] = "auto",     [STAGE_NONE] = "none",   [STAGE_SHADOW] = "shadow",
    [STAGE_STUDIO] = "studio", [STAGE_SLATE] = "slate", [STAGE_WOOD] = "wood",
    [STAGE_COLOR] = NULL,
};

/* Gap between the floor and the subject, in diagonals of the subject. Coincident faces would make
 * intersections ambiguous. */
#define STAGE_GAP 5e-4f
/* Surroundings of a file belong to the subject up to this ratio of the boxes' diagonals. */
#define SUBJECT_RATIO 4.0f

/* ---- analysis of the model ---- */

static struct box box_union(struct box a, struct box b)
{
    return (struct box){ glms_vec3_minv(a.min, b.min), glms_vec3_maxv(a.max, b.max) };
}

struct box stage_subject_box(const struct model *model)
{
    const struct box objects = mesh_box(&model->object);
    const struct box others = mesh_box(&model->surroundings);
    if (!model->object.index_count)
        return others;
    if (!model->surroundings.index_count)
        return objects;
    const struct box all = box_union(objects, others);
    return box_diagonal(all) <= SUBJECT_RATIO * box_diagonal(objects) ? all : objects;
}

/* Returns the box of the surroundings' triangles that are not above a level. */
static struct box box_below(const struct mesh *mesh, float level, bool *is_empty)
{
    struct box box = { glms_vec3_fill(INFINITY), glms_vec3_fill(-INFINITY) };
    *is_empty = true;
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const vec3s *corners[3];
        bool is_below = true;
        for (uint32_t k = 0; k < 3; k++) {
            corners[k] = &mesh->vertices[mesh->indices[i + k]].position;
            is_below = is_below && corners[k]->y <= level;
        }
        for (uint32_t k = 0; k < 3 && is_below; k++) {
            box.min = glms_vec3_minv(box.min, *corners[k]);
            box.max = glms_vec3_maxv(box.max, *corners[k]);
        }
        *is_empty = *is_empty && !is_below;
    }
    return box;
}

/* Returns true if a box extends beyond another one in both horizontal directions of both axes, by a
 * fraction `margin` of the other one's width. */
static bool is_wider(struct box outer, struct box inner, float margin)
{
    const vec3s room = glms_vec3_scale(glms_vec3_sub(inner.max, inner.min), margin);
    return outer.min.x <= inner.min.x - room.x && outer.max.x >= inner.max.x + room.x &&
           outer.min.z <= inner.min.z - room.z && outer.max.z >= inner.max.z + room.z;
}

/* Returns true if a mesh is a room: its faces, weighted by area, look at the centre of its box. */
static bool is_hollow(const struct mesh *mesh)
{
    const vec3s center = box_center(mesh_box(mesh));
    double inwards = 0.0, area = 0.0;
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
        vec3s p[3];
        for (uint32_t k = 0; k < 3; k++)
            p[k] = glms_vec3_sub(mesh->vertices[mesh->indices[i + k]].position, center);
        const vec3s n = glms_vec3_cross(glms_vec3_sub(p[1], p[0]), glms_vec3_sub(p[2], p[0]));
        const vec3s middle = glms_vec3_add(glms_vec3_add(p[0], p[1]), p[2]);
        inwards -= (double)glms_vec3_dot(n, glms_vec3_normalize(middle));
        area += (double)glms_vec3_norm(n);
    }
    return inwards > 0.2 * area;
}

bool stage_has_own_surroundings(const struct model *model)
{
    const struct box objects = mesh_box(&model->object);
    const struct box others = mesh_box(&model->surroundings);
    const float height = objects.max.y - objects.min.y;
    bool is_empty;
    if (!model->object.index_count)
        return is_hollow(&model->surroundings);
    if (!model->surroundings.index_count)
        return false;
    const struct box table =
        box_below(&model->surroundings, objects.min.y + 0.02f * height, &is_empty);
    const bool is_room = is_wider(others, objects, 0.5f) && others.min.y <= objects.min.y &&
                         others.max.y >= objects.max.y;
    return is_room || (!is_empty && is_wider(table, objects, 0.05f));
}

/* ---- colours of the floor ---- */

/* Returns the mean of the panorama's texels of a column at the horizon, over one side's angle. */
static vec3s horizon_radiance(const struct environment *e, uint32_t side)
{
    const float turn = (float)side / GENERATE_STAGE_SIDES + 0.5f + e->turn;
    const uint32_t spread = e->width / (2 * GENERATE_STAGE_SIDES) + 1;
    const uint32_t column = (uint32_t)((turn - floorf(turn)) * (float)e->width);
    vec3s sum = glms_vec3_zero();
    for (uint32_t i = 0; i < 2 * spread; i++) {
        const uint32_t x = (column + e->width + i - spread) % e->width;
        const uint16_t *texel = &e->texels[((size_t)(e->height / 2) * e->width + x) * 4];
        for (int k = 0; k < 3; k++)
            sum.raw[k] += half_to_float(texel[k]);
    }
    return glms_vec3_divs(sum, (float)(2 * spread));
}

/* Returns the radiance of a level white surface in the panorama, lit by its sun as well. */
static vec3s level_light(const struct environment *e)
{
    const uint32_t step = e->width > 512 ? e->width / 512 : 1;
    const float pi = 3.14159265f;
    vec3s sum = glms_vec3_scale(e->sun.light, fmaxf(e->sun.dir.y, 0.0f));
    for (uint32_t y = 0; y < e->height / 2; y += step) {
        const float up = pi * (0.5f - ((float)y + 0.5f * (float)step) / (float)e->height);
        const float weight = fmaxf(sinf(up), 0.0f) * cosf(up) * (float)(step * step) * 2.0f * pi /
                             ((float)e->height * (float)e->width);
        for (uint32_t x = 0; x < e->width; x += step) {
            const uint16_t *texel = &e->texels[((size_t)y * e->width + x) * 4];
            for (int k = 0; k < 3; k++)
                sum.raw[k] += weight * half_to_float(texel[k]);
        }
    }
    return sum;
}

/* Sets the vertex colours at the horizon, at which the floor's radiance is that of the panorama.
 * `mean` is the mean colour of the material's texture. They are those near the subject for a shadow
 * catcher, or without a panorama. */
static void set_horizon(struct generate_stage *stage, const struct environment *e, vec3s mean,
                        bool is_catcher)
{
    const bool fades = e->texels && !is_catcher;
    const vec3s light =
        fades ? glms_vec3_maxv(level_light(e), glms_vec3_fill(1e-6f)) : glms_vec3_one();
    for (uint32_t i = 0; i < GENERATE_STAGE_SIDES; i++)
        stage->far_colors[i] =
            fades ? glms_vec3_div(horizon_radiance(e, i), glms_vec3_mul(light, mean))
                  : stage->near_color;
}

/* ---- materials ---- */

/* Appearance of the kinds of ground. */
struct look {
    vec3s color; /* vertex colour at the subject */
    float roughness, specular, normal_scale;
    float uv_scale; /* texture repetitions per radius of the subject */
    bool is_textured;
};

static const struct look looks[STAGE_GROUND_COUNT] = {
    [STAGE_SHADOW] = { { { 1.0f, 1.0f, 1.0f } }, 1.0f, 0.0f, 0.0f, 1.0f, false },
    [STAGE_STUDIO] = { { { 0.014f, 0.019f, 0.026f } }, 0.22f, 1.0f, 0.0f, 1.0f, false },
    [STAGE_SLATE] = { { { 1.0f, 1.0f, 1.0f } }, 0.42f, 1.0f, 1.0f, 0.25f, true },
    [STAGE_WOOD] = { { { 1.0f, 1.0f, 1.0f } }, 0.42f, 1.0f, 1.0f, 0.25f, true },
    [STAGE_COLOR] = { { { 1.0f, 1.0f, 1.0f } }, 1.0f, 0.0f, 0.0f, 1.0f, false },
};

static void set_texture(struct material_texture *texture)
{
    *texture = (struct material_texture){
        .layer = 1,
        .u_row = { { 1.0f, 0.0f, 0.0f } },
        .v_row = { { 0.0f, 1.0f, 0.0f } },
    };
}

/* Returns the material of a ring. Specular reflection fades with distance, since the colours at the
 * horizon are for diffuse surfaces. */
static struct material material_of(const struct stage_params *stage, uint32_t ring)
{
    struct material material = material_make("stage");
    material.metallic = 0.0f;
    material.roughness = looks[stage->ground].roughness;
    material.specular = looks[stage->ground].specular * (1.0f - generate_stage_fade(ring));
    if (looks[stage->ground].is_textured) {
        set_texture(&material.textures[MATERIAL_BASE_COLOR]);
        set_texture(&material.textures[MATERIAL_NORMAL]);
        material.normal_scale = looks[stage->ground].normal_scale;
    }
    if (stage->ground == STAGE_SHADOW)
        material.flags |= MATERIAL_IS_SHADOW_CATCHER;
    return material;
}

/* Generates the textures of slate or wood; sets `mean` to their mean colour. */
static bool add_textures(struct model *floor, enum stage_ground ground, vec3s *mean)
{
    struct stage_textures made;
    *mean = glms_vec3_one();
    if (!looks[ground].is_textured)
        return true;
    if (!stage_textures_generate(&made, ground == STAGE_WOOD))
        return false;
    floor->textures = (struct texture_layers){ made.colors, STAGE_TEXTURE_SIZE, 1 };
    floor->numbers = (struct texture_layers){ made.normals, STAGE_TEXTURE_SIZE, 1 };
    *mean = made.mean;
    return true;
}

/* Makes the floor a model that consists of surroundings. */
static bool make_model(struct model *floor, const struct stage_params *stage,
                       struct generate_stage *shape, const struct environment *environment)
{
    vec3s mean;
    *floor = (struct model){ .material_count = GENERATE_STAGE_RINGS };
    floor->materials = malloc(GENERATE_STAGE_RINGS * sizeof(*floor->materials));
    bool done = floor->materials && add_textures(floor, stage->ground, &mean);
    if (done) {
        set_horizon(shape, environment, mean, stage->ground == STAGE_SHADOW);
        done = generate_stage(&floor->surroundings, shape) &&
               model_surroundings_add_object(floor, "stage", 0);
    }
    for (uint32_t ring = 0; ring < GENERATE_STAGE_RINGS && done; ring++)
        floor->materials[ring] = material_of(stage, ring);
    if (!done) {
        floor->material_count = 0;
        model_finish(floor);
    }
    return done;
}

enum status stage_add(struct model *model, const struct stage_params *stage, struct box subject,
                      const struct environment *environment)
{
    const float diagonal = box_diagonal(subject);
    struct model floor;
    struct generate_stage shape = {
        .foot = box_center(subject),
        .radius = diagonal > 0.0f ? 0.5f * diagonal : 1.0f,
        .uv_scale = looks[stage->ground].uv_scale,
        .near_color = stage->ground == STAGE_COLOR ? stage->color : looks[stage->ground].color,
    };
    shape.foot.y = subject.min.y - STAGE_GAP * diagonal;
    if (!make_model(&floor, stage, &shape, environment))
        return log_out_of_memory("stage");
    for (int k = 0; k < 3; k++)
        floor.origin[k] = model->origin[k];
    return model_add_surroundings(model, &floor);
}
