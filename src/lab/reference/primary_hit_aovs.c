/* primary_hit_aovs.c: fills the layers (AOVs) of the primary hit, such as depth and normal. */
#include "src/lab/reference/primary_hit_aovs.h"
#include <cglm/struct.h>

enum {
    SKIPPED_MAX = 256, /* transparent surfaces along a camera ray */
};

static bool is_visible(const struct primary_hit_layers *first, const struct embree_scene_hit *hit)
{
    if (hit->kind == EMBREE_SCENE_SURROUNDINGS)
        return !(radiance_transmittance(first->radiance, &hit->surface) > 0.5f);
    return hit->kind != EMBREE_SCENE_AIR;
}

/* Finds the first visible surface along a camera ray. Skips textured planes of milky air, and
 * surfaces with alpha below 0.5. Returns false if no surface is found. */
static bool find_visible(const struct primary_hit_layers *first, const struct embree_scene_ray *ray,
                         struct embree_scene_hit *hit)
{
    struct embree_scene_ray next = *ray;
    next.from = EMBREE_SCENE_NO_ORIGIN;
    next.near = first->embree_scene->epsilon;
    for (uint32_t i = 0; i < SKIPPED_MAX; i++) {
        if (is_visible(first, hit))
            return true;
        next.origin = hit->surface.position;
        if (!embree_scene_intersect(first->embree_scene, &next, hit))
            return false;
    }
    return false;
}

/* Returns the position of a hit point in the previous frame, in the local space of the mesh. */
static vec3s previous_point(const struct primary_hit_layers *first,
                            const struct embree_scene_hit *hit)
{
    const struct scene *scene = first->radiance->scene;
    const struct mesh *mesh = first->embree_scene->meshes[hit->kind].mesh;
    const uint32_t *corners = &mesh->indices[(size_t)hit->triangle * 3];
    const size_t offset =
        hit->kind == EMBREE_SCENE_SURROUNDINGS ? scene->model.object.vertex_count : (size_t)0;
    const float weights[3] = { 1.0f - hit->u - hit->v, hit->u, hit->v };
    vec3s point = glms_vec3_zero();
    for (int k = 0; k < 3; k++) {
        const vec3s corner = scene->previous_positions
                                 ? glms_vec3(scene->previous_positions[offset + corners[k]])
                                 : mesh->vertices[corners[k]].position;
        point = glms_vec3_muladds(corner, weights[k], point);
    }
    return point;
}

vec2s primary_hit_layers_motion(const struct primary_hit_layers *first,
                                const struct embree_scene_hit *hit)
{
    const struct first_surface_previous *e = first->earlier;
    const struct globals *g = first->radiance->globals;
    const vec3s previous = previous_point(first, hit);
    vec4s before = glms_vec4(previous, 1.0f);
    if (hit->kind == EMBREE_SCENE_OBJECT)
        before = glms_mat4_mulv(e->world_from_object, before);
    else if (hit->surface.material & MESH_ORBITS)
        before = glms_mat4_mulv(e->world_from_movers, before);
    const vec4s now = glms_mat4_mulv(g->clip_from_world, glms_vec4(hit->surface.position, 1.0f));
    before = glms_mat4_mulv(e->clip_from_world, before);
    if (!(before.w > 0.0f))
        return glms_vec2_zero();
    return (vec2s){ { (now.x / now.w - before.x / before.w) * e->half_size.x,
                      (now.y / now.w - before.y / before.w) * e->half_size.y } };
}

float primary_hit_layers_object(const struct primary_hit_layers *first,
                                const struct embree_scene_hit *hit)
{
    const struct model *model = &first->radiance->scene->model;
    const struct mesh *mesh = first->embree_scene->meshes[hit->kind].mesh;
    if (hit->kind == EMBREE_SCENE_OBJECT)
        return (float)(hit->object + 1);
    return (float)(model->object_count + 1 +
                   model_surroundings_find_object(model, mesh->indices[(size_t)hit->triangle * 3]));
}

void primary_hit_layers_fill(const struct primary_hit_layers *first,
                             const struct embree_scene_ray *ray, vec3s forward,
                             const struct embree_scene_hit *closest,
                             struct reference_ray_values *values)
{
    struct embree_scene_hit hit = *closest;
    if (!find_visible(first, ray, &hit))
        return;
    const bool is_object = hit.kind == EMBREE_SCENE_OBJECT;
    values->z = glms_vec3_dot(glms_vec3_sub(hit.surface.position, ray->origin), forward);
    values->normal = hit.surface.normal;
    values->position = hit.surface.position;
    if (!is_object && hit.kind != EMBREE_SCENE_SURROUNDINGS) /* the camera is inside the ice */
        return;
    values->albedo = radiance_albedo(first->radiance, &hit.surface);
    values->object = primary_hit_layers_object(first, &hit);
    values->last = values->object;
    if (first->earlier)
        values->motion = primary_hit_layers_motion(first, &hit);
}
