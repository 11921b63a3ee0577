/* trace.c: a scene's trees, media and poses for rays on the device. */
#include "src/frame/trace.h"
#include <math.h>
#include <string.h>
#include "src/frame/media.h"
#include "src/scene/material_rows.h"
#include "src/scene/surface_light.h"
#include "src/settings/scene_settings.h"
#include "src/tech/cracks.h"
#include "src/tech/ice_caustics.h"
#include "src/tech/refract_trace.h"

/* Surfaces of less roughness are smooth; src/reference/whitted.c has the same limit. */
#define ROUGHNESS_MIN 1e-3f

static uint32_t object_count(const struct scene *scene)
{
    return frame_media_count(scene) - 1;
}

/* Whether a corner of the surroundings is within `reach` of a point. */
static bool is_near(const struct mesh *mesh, vec3s point, float reach)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (glms_vec3_distance2(mesh->vertices[i].position, point) < reach * reach)
            return true;
    }
    return false;
}

bool frame_trace_lights_surroundings(const struct scene *scene, const struct settings *settings)
{
    const struct ground_params *ground = settings_of(settings, &ground_settings);
    return ground->light == GROUND_TRACED && material_rows_has_lit(&scene->model.surroundings);
}

bool frame_trace_meets_surroundings(const struct scene *scene, const struct settings *settings)
{
    const struct trace_params *params = settings_of(settings, &trace_settings);
    const struct model *model = &scene->model;
    if (params->surroundings != TRACE_AUTO)
        return params->surroundings == TRACE_RAYS;
    if (frame_trace_lights_surroundings(scene, settings))
        return true;
    if (frame_trace_constant(scene, settings) & (TRACE_HAS_SHINE | TRACE_HAS_DRESS))
        return true;
    return object_count(scene) > 1 ||
           is_near(&model->surroundings, box_center(scene->box), box_diagonal(scene->box));
}

/* Returns the bits that tell of the objects' media. */
static uint32_t objects_constant(const struct scene *scene, const struct settings *settings)
{
    const uint32_t count = object_count(scene);
    uint32_t bits = count > 1 ? TRACE_HAS_MEDIA : 0;
    bits |= count > TREE_SHELLS_FEW ? TRACE_HAS_MANY : 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct frame_medium medium = frame_medium_at(scene, settings, i);
        bits |= medium.is_thin ? TRACE_HAS_MEDIA : 0;
        bits |= medium.roughness > ROUGHNESS_MIN ? TRACE_HAS_ROUGH : 0;
        bits |= medium.shine > 0.0f ? TRACE_HAS_SHINE : 0;
        bits |= glms_vec3_min(medium.tint) < 1.0f ? TRACE_HAS_TINT : 0;
        bits |= medium.is_dressed ? TRACE_HAS_DRESS | TRACE_HAS_SHINE : 0;
    }
    return bits;
}

uint32_t frame_trace_constant(const struct scene *scene, const struct settings *settings)
{
    const struct motion_params *motion = settings_of(settings, &motion_settings);
    const struct model *model = &scene->model;
    const uint32_t count = object_count(scene);
    uint32_t bits = objects_constant(scene, settings);
    bits |= scene->bubbles.count || scene->cracks.index_count ? TRACE_HAS_INCLUSIONS : 0;
    for (uint32_t i = 0; i < scene->bubbles.count; i++)
        bits |= bubble_is_sphere(&scene->bubbles.all[i]) ? 0 : TRACE_HAS_SHAPES;
    if (count == 1 && scene->tree && scene->tree->is_closed && !(bits & TRACE_HAS_MEDIA))
        bits |= scene->is_convex ? TRACE_IS_CONVEX | TRACE_HAS_CULLING : TRACE_HAS_CULLING;
    for (uint32_t i = 0; i < model->material_count; i++) {
        if (model->materials[i].flags & (MATERIAL_IS_CUTOUT | MATERIAL_IS_BLENDED))
            bits |= TRACE_HAS_HOLES;
    }
    bits |= ice_caustics.is_on(settings) ? TRACE_HAS_SUN : 0;
    bits |= frame_trace_lights_surroundings(scene, settings) ? TRACE_HAS_GROUND : 0;
    bits |= scene->material_rows ? TRACE_HAS_MATERIALS : 0;
    bits |= model->object.extras || model->surroundings.extras ? TRACE_HAS_EXTRAS : 0;
    if (fabsf(motion->ice) > 0.0f || fabsf(motion->objects) > 0.0f)
        bits |= TRACE_HAS_MOTION;
    return bits;
}

static vec4s with(vec3s xyz, float w)
{
    return (vec4s){ { xyz.x, xyz.y, xyz.z, w } };
}

static void fill_medium(vec4s *texels, const struct frame_medium *medium)
{
    texels[TRACE_IOR] =
        (vec4s){ { medium->ior[0], medium->ior[1], medium->ior[2], medium->roughness } };
    texels[TRACE_ABSORB] = with(medium->absorption, medium->shine);
    texels[TRACE_TINT] = with(medium->tint, medium->is_thin ? 1.0f : 0.0f);
}

static bool is_in_bubble(const struct bubbles *bubbles, vec3s point)
{
    for (uint32_t i = 0; i < bubbles->count; i++) {
        if (bubble_holds(&bubbles->all[i], point))
            return true;
    }
    return false;
}

void frame_trace_fill(struct trace_frame *trace, const struct frame_view *view,
                      const struct globals *globals)
{
    const struct trace_params *params = settings_of(view->settings, &trace_settings);
    const struct tree *tree = view->scene->tree;
    const struct cracks_params *cracks_of = settings_of(view->settings, &cracks_settings);
    *trace = (struct trace_frame){
        .sample_index = view->sample,
        .branch = params->branch,
        .hair = 1e-4f * globals->radius,
        .one = 1,
        .ice = view->scene->model.object_count ? view->scene->model.objects[0].rank : 1,
        .crack_slope = cracks_of->look.bump,
        .media_at = tree->media,
    };
    if (frame_trace_lights_surroundings(view->scene, view->settings))
        trace->guide = surface_light_guide(&view->scene->environment, view->scene->surface_light);
    for (uint32_t i = 0; i < TREE_PART_COUNT; i++)
        trace->roots[i] = tree->roots[i];
    for (uint32_t i = 0; i < frame_media_count(view->scene); i++) {
        const struct frame_medium medium = frame_medium_at(view->scene, view->settings, i);
        fill_medium(&trace->media[(size_t)tree_medium(tree, medium.rank) * TRACE_MEDIUM], &medium);
    }
    const mat4s object_from_world = glms_mat4_inv(globals->world_from_object);
    const vec3s eye = glms_mat4_mulv3(object_from_world, view->camera.eye, 1.0f);
    const struct tree_shells inside = tree_immerse(tree, eye);
    trace->is_in_bubble = is_in_bubble(&view->scene->bubbles, eye);
    memcpy(trace->inside, inside.words, sizeof(trace->inside));
}
