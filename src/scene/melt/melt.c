/* melt.c: melts the ice of a model, and updates everything that depends on its shape. */
#include "src/scene/melt/melt.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"
#include "src/scene/generate/noise.h"
#include "src/scene/geometry/distance_field.h"
#include "src/scene/geometry/vertex_weld.h"
#include "src/scene/melt/melt_curvature_flow.h"
#include "src/scene/melt/melt_inclusions_and_water.h"

#define ICE_IOR_MIN   1.3f /* refractive index ranges of ice, water and air */
#define ICE_IOR_MAX   1.32f
#define WATER_IOR_MAX 1.345f
#define AIR_IOR_MAX   1.1f

#define FROST_MELTED          0.03f /* lost volume fraction at which frost has vanished */
#define HOLLOW                0.02f /* depth of melt hollows, in half widths */
#define HOLLOW_CELL           0.36f /* width of hollows, in half widths */
#define FINE_HOLLOW_DEPTH     0.45f /* depth of finer hollows, relative to the coarse ones */
#define FINE_HOLLOW_FREQUENCY 2.1f
#define HOLLOWS_COMPLETE      0.1f /* lost volume fraction at which hollows are complete */
#define CRACK_OPENING_DEPTH   0.1f /* relative depth below which cracks open */
/* widening of cracks at the surface of fully melted ice, in gap widths */
#define CRACK_WIDENING     20.0f
#define SUBMERGED_FRACTION 0.917f /* submerged fraction of floating ice (density ratio) */
#define PUDDLE_DEPTH       0.164f /* meltwater thickness, in half widths; 2.3 mm for a 28 mm cube */
#define WATER_PER_ICE      0.917f /* volume of water per volume of ice */

/* Returns the depth of cellular noise at a point, 0 to 1: round hollows with sharp ridges. */
static float hollow_depth(vec3s at)
{
    const vec3s cell = { { floorf(at.x), floorf(at.y), floorf(at.z) } };
    float nearest2 = 4.0f;
    for (int i = 0; i < 27; i++) {
        const int offset[3] = { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 };
        vec3s other = cell;
        for (int k = 0; k < 3; k++)
            other.raw[k] += (float)offset[k];
        uint32_t hash = 40;
        for (int k = 0; k < 3; k++)
            hash = noise_hash(hash ^ (uint32_t)(int32_t)other.raw[k]);
        vec3s middle;
        for (int k = 0; k < 3; k++)
            middle.raw[k] = other.raw[k] + (float)(hash >> 8 * k & 255) / 255.0f;
        nearest2 = fminf(nearest2, glms_vec3_distance2(at, middle));
    }
    return fmaxf(1.0f - nearest2, 0.0f);
}

float melted_frost_factor(const struct melted *melted)
{
    return 1.0f - glm_smoothstep(0.0f, FROST_MELTED, melted->lost_fraction);
}

float melted_hollow_factor(const struct melted *melted)
{
    return 1.0f + 2.0f * melted->lost_fraction;
}

/* Closed mesh of ice that melts. */
struct ice {
    struct vertex_weld vertex_weld;
    struct melt_curvature_flow flow;
    double half; /* half the width of a cube with the ice's initial volume */
    struct box before;
    bool floats;
    float rise; /* vertical displacement after melting */
    float lost; /* lost volume fraction */
};

/* Welds the mesh's vertices and copies their positions. Returns false when out of memory. */
static bool ice_init(struct ice *ice, const struct mesh *mesh, const struct object *object,
                     bool floats)
{
    *ice = (struct ice){ .floats = floats };
    if (!vertex_weld_init(&ice->vertex_weld, mesh, object->first_index, object->index_count))
        return false;
    ice->flow = (struct melt_curvature_flow){
        .points = calloc(ice->vertex_weld.count + (size_t)1, sizeof(*ice->flow.points)),
        .count = ice->vertex_weld.count,
        .corners = ice->vertex_weld.corners,
        .corner_count = ice->vertex_weld.corner_count,
    };
    for (uint32_t i = 0; i < mesh->vertex_count && ice->flow.points; i++) {
        for (int k = 0; k < 3 && ice->vertex_weld.points[i] != VERTEX_WELD_NONE; k++)
            ice->flow.points[ice->vertex_weld.points[i]][k] =
                (double)mesh->vertices[i].position.raw[k];
    }
    return ice->flow.points != NULL;
}

static void ice_finish(struct ice *ice)
{
    free(ice->flow.points);
    vertex_weld_finish(&ice->vertex_weld);
}

/* Computes angle-weighted point normals. Returns false when out of memory. */
static bool find_normals(const struct melt_curvature_flow *flow, vec3s *normals)
{
    struct mesh mesh;
    if (!mesh_init(&mesh, flow->count, flow->corner_count))
        return false;
    for (uint32_t i = 0; i < flow->count; i++) {
        for (int k = 0; k < 3; k++)
            mesh.vertices[i].position.raw[k] = (float)flow->points[i][k];
    }
    for (uint32_t i = 0; i < flow->corner_count; i++)
        mesh.indices[i] = flow->corners[i];
    mesh_make_normals(&mesh);
    for (uint32_t i = 0; i < flow->count; i++)
        normals[i] = mesh.vertices[i].normal;
    mesh_finish(&mesh);
    return true;
}

static struct box box_of(const struct melt_curvature_flow *flow)
{
    struct box box = { { { INFINITY, INFINITY, INFINITY } },
                       { { -INFINITY, -INFINITY, -INFINITY } } };
    for (uint32_t i = 0; i < flow->count; i++) {
        for (int k = 0; k < 3; k++) {
            box.min.raw[k] = fminf(box.min.raw[k], (float)flow->points[i][k]);
            box.max.raw[k] = fmaxf(box.max.raw[k], (float)flow->points[i][k]);
        }
    }
    return box;
}

/* Presses melt hollows into the surface, except near its base. */
static void press_hollows(struct ice *ice, const vec3s *normals)
{
    const float lost = ice->lost;
    const struct box box = box_of(&ice->flow);
    const float cell = HOLLOW_CELL * (float)ice->half;
    const float depth = HOLLOW * (float)ice->half * (1.0f + 2.0f * lost) *
                        glm_smoothstep(0.0f, HOLLOWS_COMPLETE, lost) *
                        cbrtf(fmaxf(1.0f - lost, 0.0f));
    const float base_height = fmaxf(0.1f * (box.max.y - box.min.y), 1e-30f);
    for (uint32_t i = 0; i < ice->flow.count; i++) {
        double *point = ice->flow.points[i];
        const vec3s at = { { (float)point[0] / cell, (float)point[1] / cell,
                             (float)point[2] / cell } };
        const float pressed =
            hollow_depth(at) +
            FINE_HOLLOW_DEPTH * hollow_depth(glms_vec3_scale(at, FINE_HOLLOW_FREQUENCY));
        const float above = glm_smoothstep(0.0f, base_height, (float)point[1] - box.min.y);
        for (int k = 0; k < 3; k++)
            point[k] -= (double)(depth * above * pressed * normals[i].raw[k]);
    }
}

/* Returns the vertical displacement that keeps the ice on its base or afloat at its waterline. */
static float displacement_of(const struct ice *ice)
{
    const struct box after = box_of(&ice->flow);
    const float submerged = ice->floats ? SUBMERGED_FRACTION : 0.0f;
    return glm_lerp(ice->before.min.y, ice->before.max.y, submerged) -
           glm_lerp(after.min.y, after.max.y, submerged);
}

/* Writes the welded points back to `mesh`. Adds the ice's vertical displacement in both meshes. */
static void write_back(const struct ice *ice, const vec3s *normals, struct mesh *mesh,
                       struct mesh *unmelted)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const uint32_t at = ice->vertex_weld.points[i];
        struct mesh_vertex *vertex = &mesh->vertices[i];
        if (at == VERTEX_WELD_NONE)
            continue;
        for (int k = 0; k < 3; k++)
            vertex->position.raw[k] = (float)ice->flow.points[at][k];
        vertex->position.y += ice->rise;
        vertex->normal = normals[at];
        unmelted->vertices[i].position.y += ice->rise;
        if (mesh->extras)
            /* tangents of the unmelted surface no longer apply */
            mesh->extras[i].tangent = glms_vec3_zero();
    }
}

/* Melts a mesh by a volume fraction, then moves its faces inwards by `further` half widths. */
static bool melt_closed_mesh(struct ice *ice, struct mesh *mesh, struct mesh *unmelted,
                             float lost_fraction, float further)
{
    double lost = 0;
    vec3s *normals = malloc((ice->flow.count + (size_t)1) * sizeof(*normals));
    ice->before = box_of(&ice->flow);
    ice->half = melt_curvature_flow_half_width(&ice->flow);
    bool done =
        normals &&
        melt_curvature_flow_run(&ice->flow, (double)lost_fraction, (double)further, &lost) &&
        find_normals(&ice->flow, normals);
    ice->lost = (float)lost;
    if (done) {
        press_hollows(ice, normals);
        done = find_normals(&ice->flow, normals);
    }
    if (done) {
        ice->rise = displacement_of(ice);
        write_back(ice, normals, mesh, unmelted);
    }
    free(normals);
    return done;
}

static const struct material *material_of(const struct model *model, uint32_t object)
{
    return &model->materials[model->objects[object].material];
}

static bool has_ior(const struct model *model, uint32_t object, float ior_min, float ior_max)
{
    const struct material *material = material_of(model, object);
    return !(material->flags & MATERIAL_FROM_SETTINGS) && material->ior >= ior_min &&
           material->ior < ior_max;
}

static bool is_ice(const struct model *model, uint32_t object, const struct melting *melting)
{
    const bool is_one = material_of(model, object)->flags & MATERIAL_FROM_SETTINGS ||
                        has_ior(model, object, ICE_IOR_MIN, ICE_IOR_MAX);
    return !melting->is_none && (melting->is_all || is_one);
}

/* Returns true if an object's centre is inside water. */
static bool is_floating(const struct model *model, uint32_t object)
{
    const vec3s middle = box_center(model->objects[object].box);
    for (uint32_t i = 0; i < model->object_count; i++) {
        const bool is_in_box =
            box_contains(&model->objects[i].box, &(struct box){ middle, middle });
        if (is_in_box && has_ior(model, i, ICE_IOR_MAX, WATER_IOR_MAX) &&
            object_contains(&model->objects[i], &model->object, middle))
            return true;
    }
    return false;
}

/* Updates the air inside the ice, and the water below and around the ice. */
static bool update_surroundings(struct model *model, const struct mesh *unmelted,
                                const struct ice *ice, const struct object *of)
{
    struct melt_air_and_water_ice parts = {
        .object = of,
        .unmelted = unmelted,
        .half = (float)ice->half,
        .rise = ice->rise,
        .spread =
            sqrtf(WATER_PER_ICE * ice->lost * 8.0f / (PUDDLE_DEPTH * GLM_PIf)) * (float)ice->half,
    };
    bool done = true;
    for (uint32_t i = 0; i < model->object_count && done; i++) {
        if (has_ior(model, i, 0.0f, AIR_IOR_MAX))
            done = melt_air_and_water_shrink_air(model, i, &parts);
        else if (has_ior(model, i, ICE_IOR_MAX, WATER_IOR_MAX))
            done = melt_air_and_water_spread_components(model, i, &parts);
    }
    done = done && melt_air_and_water_spread_layers(model, &parts);
    melt_air_and_water_finish(&parts);
    return done;
}

static bool melt_object(struct model *model, const struct object *object, bool floats,
                        const struct melting *melting, float time, struct melted *melted)
{
    struct ice ice;
    const bool done =
        ice_init(&ice, &model->object, object, floats) &&
        melt_closed_mesh(&ice, &model->object, &melted->unmelted, melting->lost_fraction,
                         fmaxf(melting->speed * time, 0.0f)) &&
        update_surroundings(model, &melted->unmelted, &ice, object);
    melted->lost_fraction = melted->lost_fraction > 0.0f ? melted->lost_fraction : ice.lost;
    ice_finish(&ice);
    return done;
}

/* Scales the roughness of ice materials, since a melting surface is wet and therefore smooth.
 * Returns false when out of memory. */
static bool smooth_wet_ice(struct model *model, const struct melting *melting,
                           const struct melted *melted)
{
    bool *is_of_ice = calloc(model->material_count + (size_t)1, sizeof(*is_of_ice));
    for (uint32_t i = 0; is_of_ice && i < model->object_count; i++)
        is_of_ice[model->objects[i].material] |= is_ice(model, i, melting);
    for (uint32_t k = 0; is_of_ice && k < model->material_count; k++)
        model->materials[k].roughness *= is_of_ice[k] ? melted_frost_factor(melted) : 1.0f;
    const bool done = is_of_ice;
    free(is_of_ice);
    return done;
}

/* Melts all ice. Returns false when out of memory. */
static bool melt_all(struct model *model, const struct melting *melting, float time,
                     struct melted *melted)
{
    struct object whole = { .index_count = model->object.index_count };
    bool done = mesh_append(&melted->unmelted, &model->object);
    if (!model->object_count) /* a model without an object list is the ice in a pool */
        done = done && melt_object(model, &whole, true, melting, time, melted);
    for (uint32_t i = 0; i < model->object_count && done; i++) {
        if (is_ice(model, i, melting))
            done = melt_object(model, &model->objects[i], is_floating(model, i), melting, time,
                               melted);
    }
    for (uint32_t i = 0; i < model->object_count; i++)
        model->objects[i].box = object_box(&model->objects[i], &model->object);
    melted->box = mesh_box(&melted->unmelted);
    return done && smooth_wet_ice(model, melting, melted);
}

enum status melt_model(struct model *model, const struct melting *melting, float time,
                       struct melted *melted)
{
    bool has_ice = !model->object_count && model->object.index_count && !melting->is_none;
    *melted = (struct melted){ 0 };
    for (uint32_t i = 0; i < model->object_count; i++)
        has_ice = has_ice || is_ice(model, i, melting);
    if (!has_ice && !(time > 0.0f) && (melting->lost_fraction > 0.0f || melting->speed > 0.0f))
        log_warning("ice.melt, motion.melt: no effect, since the scene has no ice (an index of "
                    "refraction from 1.3 to 1.32)");
    if (!has_ice || !(melting->lost_fraction > 0.0f || melting->speed * time > 0.0f))
        return STATUS_OK;
    if (melt_all(model, melting, time, melted))
        return STATUS_OK;
    melted_finish(melted);
    return log_out_of_memory("melting ice");
}

/* Shortens a capsule bubble at its shallower end until it is inside the ice, by bisection. */
static void shorten_capsule(const struct distance_field *depth, struct bubble *bubble)
{
    enum {
        HALVINGS = 12
    };

    const vec3s ends[2] = {
        glms_vec3_muladds(bubble->axis, -bubble->stretch, bubble->center),
        glms_vec3_muladds(bubble->axis, bubble->stretch, bubble->center),
    };
    const bool is_second =
        melt_air_and_water_depth(depth, ends[1]) > melt_air_and_water_depth(depth, ends[0]);
    const vec3s deep = ends[is_second], shallow = ends[!is_second];
    /* The capsule fits in the ice with the fraction `whole` of its length, but not with `cut`. */
    float whole = 0.0f, cut = 1.0f;
    if (melt_air_and_water_depth(depth, shallow) >= bubble->radius)
        return;
    for (int i = 0; i < HALVINGS; i++) {
        const float fraction = 0.5f * (whole + cut);
        const vec3s at = glms_vec3_lerp(deep, shallow, fraction);
        *(melt_air_and_water_depth(depth, at) >= bubble->radius ? &whole : &cut) = fraction;
    }
    bubble->center = glms_vec3_lerp(deep, shallow, 0.5f * whole);
    bubble->stretch *= whole;
}

bool melt_bubbles(struct bubbles *bubbles, const struct mesh *object)
{
    struct distance_field depth;
    uint32_t left = 0;
    if (!distance_field_init(&depth, object))
        return false;
    for (uint32_t i = 0; i < bubbles->count; i++) {
        struct bubble *bubble = &bubbles->all[i];
        const float longer = bubble->is_capsule ? 0.0f : fmaxf(bubble->stretch, 0.0f);
        if (bubble->is_capsule)
            shorten_capsule(&depth, bubble);
        const float scale =
            melt_air_and_water_depth(&depth, bubble->center) / (bubble->radius + longer);
        if (scale < 0.05f)
            continue;
        bubble->radius *= fminf(scale, 1.0f);
        bubble->stretch *= fminf(scale, 1.0f);
        bubbles->all[left++] = *bubble;
    }
    bubbles->count = left;
    distance_field_finish(&depth);
    return true;
}

bool melt_cracks(struct mesh *cracks, const struct mesh *object, float lost_fraction)
{
    struct distance_field depth;
    if (!distance_field_init(&depth, object))
        return false;
    for (uint32_t i = 0; i < cracks->vertex_count; i++) {
        struct mesh_vertex *vertex = &cracks->vertices[i];
        const float deep = melt_air_and_water_depth(&depth, vertex->position);
        const float near = 1.0f - glm_smoothstep(0.0f, CRACK_OPENING_DEPTH * depth.max_depth, deep);
        const float scale = 1.0f + CRACK_WIDENING * lost_fraction * near;
        vertex->color = glms_vec3_scale(vertex->color, scale * scale);
    }
    distance_field_finish(&depth);
    return true;
}

void melted_finish(struct melted *melted)
{
    mesh_finish(&melted->unmelted);
    *melted = (struct melted){ 0 };
}
