/* trace_settings.c: settings of the ray tracer and the features that a scene needs from it. */
#include "src/tech/trace/trace_settings.h"
#include <math.h>
#include "shaders/trace/refract_trace.h"
#include "src/scene/gpu_material_table.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_media.h"
#include "src/tech/inclusions/medium_density_fields.h"
#include "src/tech/lighting/ice_caustics.h"

static const char *const surroundings[] = {
    [TRACE_AUTO] = "auto",
    [TRACE_CUBE] = "cube",
    [TRACE_RAYS] = "rays",
    NULL,
};

static const char *const rays_by[] = {
    [TRACE_BY_DEVICE] = "auto",
    [TRACE_BY_BVH] = "tree",
    [TRACE_BY_QUERY] = "query",
    NULL,
};

static const struct setting rows[] = {
    {
        .name = "trace.min_branch",
        .renamed_from = "trace.branch",
        .label = "Minimum branch throughput",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct trace_params, branch),
        .initial = -1,
        .max = 1,
        .has_auto = true,
        .help = "path throughput below which Russian roulette decides whether a reflection is "
                "followed, higher in pixels of more than 64 path segments; smaller values are "
                "slower and less noisy (auto: 0.01 if all objects are clear and rays hit the "
                "surroundings, else 0.1)",
    },
    {
        .name = "trace.surroundings",
        .label = "Surroundings lookup",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct trace_params, surroundings),
        .max = TRACE_RAYS,
        .choices = surroundings,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "radiance of rays that leave the objects: from the environment cube, or traced to "
                "the triangles of the surroundings (auto: depends on the scene)",
    },
    {
        .name = "trace.traversal",
        .renamed_from = "trace.rays",
        .label = "Ray traversal",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct trace_params, rays),
        .max = TRACE_BY_QUERY,
        .choices = rays_by,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "ray traversal: BVH in the shader, or hardware ray queries "
                "(auto: queries if the device has them and is not a CPU)",
    },
    {
        .name = "trace.footprint",
        .label = "Filter by ray footprint",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct trace_params, footprint),
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "filter environment map lookups by ray differentials to reduce fireflies; "
                "the filter narrows with each sample (refraction model trace)",
    },
};

SETTING_GROUP(trace, rows, struct trace_params);

/* Roughness below which a surface counts as smooth; src/lab/reference/whitted.c has the same limit.
 */
#define ROUGHNESS_MIN 1e-3f

static uint32_t object_count(const struct scene *scene)
{
    return frame_media_count(scene) - 1;
}

/* Returns the feature bits that depend on the objects' media. */
static uint32_t objects_constant(const struct scene *scene, const struct settings *settings)
{
    const uint32_t count = object_count(scene);
    uint32_t bits = count > 1 ? TRACE_HAS_MEDIA : 0;
    bits |= count > BVH_MASK_OBJECTS_MAX ? TRACE_HAS_MANY_OBJECTS : 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct frame_medium medium = frame_medium_at(scene, settings, i);
        bits |= medium.is_thin ? TRACE_HAS_MEDIA : 0;
        bits |= medium.roughness > ROUGHNESS_MIN ? TRACE_HAS_ROUGH : 0;
        bits |= medium.opacity > 0.0f ? TRACE_HAS_OPACITY : 0;
        bits |= glms_vec3_min(medium.tint) < 1.0f ? TRACE_HAS_TINT : 0;
        bits |= medium.is_textured ? TRACE_HAS_TEXTURED_OBJECTS | TRACE_HAS_OPACITY : 0;
    }
    return bits;
}

/* Returns the feature bits that depend on materials of single triangles. */
static uint32_t materials_constant(const struct model *model)
{
    uint32_t bits = 0;
    for (uint32_t i = 0; i < model->material_count; i++) {
        const struct material *m = &model->materials[i];
        if (m->flags & (MATERIAL_IS_CUTOUT | MATERIAL_IS_BLENDED))
            bits |= TRACE_HAS_HOLES;
        if (m->flags & MATERIAL_IS_PARTIAL)
            bits |=
                m->roughness > ROUGHNESS_MIN ? TRACE_HAS_ROUGH | TRACE_HAS_TINT : TRACE_HAS_TINT;
    }
    return bits;
}

bool trace_has_diffuse_light(const struct scene *scene, const struct settings *settings)
{
    const struct ground_params *ground = settings_of(settings, &ground_settings);
    return ground->light == GROUND_TRACED && material_table_has_lit(&scene->model.surroundings);
}

bool trace_has_motion(const struct settings *settings)
{
    const struct motion_params *motion = settings_of(settings, &motion_settings);
    return fabsf(motion->ice) > 0.0f || fabsf(motion->objects) > 0.0f;
}

uint32_t trace_features(const struct scene *scene, const struct settings *settings)
{
    const struct model *model = &scene->model;
    const uint32_t count = object_count(scene);
    const bool has_contacts = scene->bvh && scene->bvh->has_contacts;
    uint32_t bits = objects_constant(scene, settings);
    bits |= has_contacts ? TRACE_HAS_MEDIA | TRACE_HAS_CONTACTS : 0;
    bits |= scene->inclusions.bubbles.count || scene->inclusions.cracks.index_count
                ? TRACE_HAS_INCLUSIONS
                : 0;
    for (uint32_t i = 0; i < scene->inclusions.bubbles.count; i++)
        bits |= bubble_is_sphere(&scene->inclusions.bubbles.all[i]) ? 0 : TRACE_HAS_SHAPES;
    if (count == 1 && scene->bvh && scene->bvh->is_closed && !(bits & TRACE_HAS_MEDIA))
        bits |= scene->is_convex ? TRACE_IS_CONVEX | TRACE_HAS_CULLING : TRACE_HAS_CULLING;
    bits |= materials_constant(model);
    bits |= ice_caustics.is_on(settings) ? TRACE_HAS_SUN_MAPS : 0;
    bits |= trace_has_diffuse_light(scene, settings) ? TRACE_HAS_DIFFUSE_LIGHT : 0;
    bits |= medium_field_exists(scene, settings) ? TRACE_HAS_SCATTERING : 0;
    bits |= scene->bvh && scene->bvh->is_stored ? TRACE_HAS_STORAGE_BUFFERS : 0;
    bits |= scene->tables.materials ? TRACE_HAS_MATERIALS : 0;
    bits |= model->object.extras || model->surroundings.extras ? TRACE_HAS_EXTRAS : 0;
    bits |= trace_has_motion(settings) ? TRACE_HAS_MOTION : 0;
    const struct trace_params *params = settings_of(settings, &trace_settings);
    bits |= params->footprint ? TRACE_HAS_RAY_DIFFERENTIALS : 0;
    return bits;
}

/* Returns true if a vertex of the surroundings is within `reach` of a point. */
static bool is_near(const struct mesh *mesh, vec3s point, float reach)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (glms_vec3_distance2(mesh->vertices[i].position, point) < reach * reach)
            return true;
    }
    return false;
}

bool trace_hits_surroundings(const struct scene *scene, const struct settings *settings)
{
    const struct trace_params *params = settings_of(settings, &trace_settings);
    const struct model *model = &scene->model;
    if (params->surroundings != TRACE_AUTO)
        return params->surroundings == TRACE_RAYS;
    if (trace_has_diffuse_light(scene, settings))
        return true;
    if (trace_features(scene, settings) &
        (TRACE_HAS_OPACITY | TRACE_HAS_TEXTURED_OBJECTS | TRACE_HAS_SCATTERING))
        return true;
    return object_count(scene) > 1 ||
           is_near(&model->surroundings, box_center(scene->box), box_diagonal(scene->box));
}

/* Throughput for Russian roulette with trace.min_branch=auto. For clear objects it is below 0.018,
 * the reflectance of ice at normal incidence: the first internal reflection has no noise. */
static const float branch_of_clear = 0.01f, branch_of_others = 0.1f;

float trace_branch_throughput(const struct scene *scene, const struct settings *settings)
{
    const uint32_t unclear = TRACE_HAS_ROUGH | TRACE_HAS_OPACITY | TRACE_HAS_TEXTURED_OBJECTS |
                             TRACE_HAS_SCATTERING | TRACE_HAS_INCLUSIONS;
    const struct trace_params *params = settings_of(settings, &trace_settings);
    if (params->branch >= 0.0f)
        return params->branch;
    const bool is_clear = !(trace_features(scene, settings) & unclear);
    const bool is_low = is_clear && trace_hits_surroundings(scene, settings);
    return is_low ? branch_of_clear : branch_of_others;
}
