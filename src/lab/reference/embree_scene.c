/* embree_scene.c: builds and intersects the Embree scene of meshes and bubbles. */
#include "src/lab/reference/embree_scene.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/tech/frame_media.h"

/* Embree's query context, extended by the traced ray for the intersection filters. */
struct context {
    struct embree_context embree;
    const struct embree_scene_ray *ray;
};

/* Upper estimate of the bytes per triangle during an Embree build. Embree 3.13 needs about 130. */
enum {
    TRIANGLE_SIZE = 256
};

/* Returns the hit passed to a filter. There is only one, because rays are traced one by one. */
static const struct RTCHit *hit_of(const struct RTCFilterFunctionNArguments *args)
{
    return (const struct RTCHit *)(const void *)args->hit;
}

/* Returns the index of the object to which a triangle belongs. */
static uint32_t object_of(const struct embree_scene *embree_scene, uint32_t triangle)
{
    const struct model *model = &embree_scene->radiance->scene->model;
    if (model->object_count < 2)
        return 0;
    return (uint32_t)(object_of_index(model->objects, model->object_count, triangle * 3) -
                      model->objects);
}

static bool is_thin(const struct embree_scene *embree_scene, uint32_t object)
{
    const struct model *model = &embree_scene->radiance->scene->model;
    const struct material *material = &model->materials[model->objects[object].material];
    return !(material->flags & MATERIAL_FROM_SETTINGS) && !(material->thickness > 0.0f);
}

/* Returns true if a ray enumerates the hits at a contact of an object, which include faces of its
 * other shells that the ray enters. */
static bool searches_object(const struct embree_scene *embree_scene,
                            const struct embree_scene_ray *ray, uint32_t object)
{
    return ray->search && object_of(embree_scene, ray->search->found[0]) == object;
}

/* Returns true if a face at a contact belongs to the surface on which the ray starts. */
static bool is_crossed_contact(const struct embree_scene *embree_scene,
                               const struct embree_scene_ray *ray, const struct RTCHit *hit,
                               float distance)
{
    const vec3s facet = glms_vec3_normalize((vec3s){ { hit->Ng_x, hit->Ng_y, hit->Ng_z } });
    const float towards = glms_vec3_dot(facet, ray->dir);
    const bool is_near =
        distance * fmaxf(fabsf(towards), COINCIDENT_COSINE_MIN) < embree_scene->epsilon;
    const uint32_t object = object_of(embree_scene, hit->primID);
    if (is_thin(embree_scene, object))
        return is_near ||
               (ray->is_wrong_side && object == ray->object && (towards > 0.0f) != ray->is_inside);
    if (towards < 0.0f && searches_object(embree_scene, ray, object))
        return false;
    return (is_near || ray->is_wrong_side) &&
           nested_media_set_has(ray->inside, object) != (towards > 0.0f);
}

/* Returns true if a ray ignores a face of an object because of its origin. */
static bool is_ignored(const struct embree_scene *embree_scene, const struct embree_scene_ray *ray,
                       const struct RTCHit *hit, float distance)
{
    if (ray->from == EMBREE_SCENE_NO_ORIGIN || ray->kind != EMBREE_SCENE_OBJECT)
        return false;
    if (hit->primID == ray->from)
        return true;
    if (ray->inside && coincident_shells_has(&embree_scene->radiance->scene->contacts, hit->primID))
        return is_crossed_contact(embree_scene, ray, hit, distance);
    const vec3s facet = { { hit->Ng_x, hit->Ng_y, hit->Ng_z } };
    const bool is_back = glms_vec3_dot(facet, ray->dir) > 0.0f;
    return is_back != ray->is_inside && (ray->is_wrong_side || distance < embree_scene->epsilon) &&
           object_of(embree_scene, hit->primID) == ray->object;
}

static bool is_found(const struct embree_scene_search *search, uint32_t triangle)
{
    const uint32_t count =
        search->count < EMBREE_SCENE_FOUND_MAX ? search->count : EMBREE_SCENE_FOUND_MAX;
    for (uint32_t i = 0; i < count; i++) {
        if (search->found[i] == triangle)
            return true;
    }
    return false;
}

static void filter_object(const struct RTCFilterFunctionNArguments *args)
{
    const struct embree_scene *embree_scene = args->geometryUserPtr;
    const struct embree_scene_ray *ray = ((const struct context *)(const void *)args->context)->ray;
    const struct RTCHit *hit = hit_of(args);
    const float distance = ((const struct RTCRay *)(const void *)args->ray)->tfar;
    if ((ray->search && is_found(ray->search, hit->primID)) ||
        is_ignored(embree_scene, ray, hit, distance))
        args->valid[0] = 0;
}

static struct mesh_vertex interpolated(const struct embree_scene_mesh *scene_mesh,
                                       uint32_t triangle, float u, float v);

/* Intersection filter that rejects hits in holes of cutout materials. */
static void filter_surroundings(const struct RTCFilterFunctionNArguments *args)
{
    const struct embree_scene *embree_scene = args->geometryUserPtr;
    const struct RTCHit *hit = hit_of(args);
    const struct mesh_vertex surface =
        interpolated(&embree_scene->meshes[EMBREE_SCENE_SURROUNDINGS], hit->primID, hit->u, hit->v);
    if (radiance_transmittance(embree_scene->radiance, &surface) >= 1.0f)
        args->valid[0] = 0;
}

/* Intersection filter for cracks and textured planes of air. Rejects hits within epsilon of the
 * ray's origin, because a ray must not hit the surface on which it starts. */
static void filter_sheets(const struct RTCFilterFunctionNArguments *args)
{
    const struct embree_scene *embree_scene = args->geometryUserPtr;
    if (((const struct RTCRay *)(const void *)args->ray)->tfar < embree_scene->epsilon)
        args->valid[0] = 0;
}

static bool has_cutouts(const struct model *model, const struct mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const uint32_t material = mesh->vertices[i].material;
        const uint32_t index = material >> MESH_SURFACE_SHIFT;
        const uint32_t flags = MATERIAL_IS_CUTOUT | MATERIAL_IS_BLENDED;
        if (material & MESH_CUTOUT || (index > 0 && model->materials[index - 1].flags & flags))
            return true;
    }
    return false;
}

static void bound_bubble(const struct RTCBoundsFunctionArguments *args)
{
    const struct embree_scene *embree_scene = args->geometryUserPtr;
    const struct bubble *bubble = &embree_scene->bubbles[args->primID];
    const struct box box = bubble_box(bubble);
    const float margin =
        1e-4f * glms_vec3_distance(box.min, box.max) + 1e-6f * glms_vec3_norm(bubble->center);
    *args->bounds_o = (struct RTCBounds){
        .lower_x = box.min.x - margin,
        .lower_y = box.min.y - margin,
        .lower_z = box.min.z - margin,
        .upper_x = box.max.x + margin,
        .upper_y = box.max.y + margin,
        .upper_z = box.max.z + margin,
    };
}

static vec3s origin_of(const struct RTCRay *ray)
{
    return (vec3s){ { ray->org_x, ray->org_y, ray->org_z } };
}

static vec3s dir_of(const struct RTCRay *ray)
{
    return (vec3s){ { ray->dir_x, ray->dir_y, ray->dir_z } };
}

static void intersect_bubble(const struct RTCIntersectFunctionNArguments *args)
{
    const struct embree_scene *embree_scene = args->geometryUserPtr;
    const struct embree_scene_ray *from =
        ((const struct context *)(const void *)args->context)->ray;
    struct RTCRayHit *rayhit = (struct RTCRayHit *)(void *)args->rayhit;
    const double near = (double)rayhit->ray.tnear;
    double at[2];
    if (!args->valid[0] || !bubble_intersect(&embree_scene->bubbles[args->primID],
                                             origin_of(&rayhit->ray), dir_of(&rayhit->ray), at))
        return;
    const bool is_same_bubble = from->kind == EMBREE_SCENE_BUBBLES && from->from == args->primID;
    if (is_same_bubble && !from->is_inside)
        return;
    const double found = !is_same_bubble && at[0] > near ? at[0] : at[1];
    if (!(found > near && found < (double)rayhit->ray.tfar))
        return;
    rayhit->ray.tfar = (float)found;
    rayhit->hit.geomID = args->geomID;
    rayhit->hit.primID = args->primID;
    rayhit->hit.instID[0] = args->context->instID[0];
}

static mat4s world_from_mesh(const struct embree_scene *embree_scene,
                             const struct embree_scene_mesh *scene_mesh, uint32_t material)
{
    if (scene_mesh != &embree_scene->meshes[EMBREE_SCENE_SURROUNDINGS])
        return embree_scene->radiance->globals->world_from_object;
    return material & MESH_ORBITS ? embree_scene->radiance->globals->world_from_movers
                                  : glms_mat4_identity();
}

/* Adds mesh `index` to the Embree scene, in world space. Returns false when out of memory. */
static bool add_mesh(struct embree_scene *embree_scene, RTCDevice device, uint32_t index)
{
    struct embree_scene_mesh *scene_mesh = &embree_scene->meshes[index];
    const struct mesh *mesh = scene_mesh->mesh;
    if (!mesh->index_count)
        return true;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    vec3s *positions = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3s), mesh->vertex_count);
    uint32_t *indices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(uint32_t), mesh->index_count / 3);
    const bool done = positions && indices;
    for (uint32_t i = 0; done && i < mesh->vertex_count; i++) {
        const struct mesh_vertex *vertex = &mesh->vertices[i];
        positions[i] = glms_mat4_mulv3(world_from_mesh(embree_scene, scene_mesh, vertex->material),
                                       vertex->position, 1.0f);
    }
    if (done)
        memcpy(indices, mesh->indices, mesh->index_count * sizeof(uint32_t));
    scene_mesh->positions = positions;
    rtcSetGeometryUserData(geometry, embree_scene);
    if (index == EMBREE_SCENE_OBJECT)
        rtcSetGeometryIntersectFilterFunction(geometry, filter_object);
    else if (index == EMBREE_SCENE_CRACKS || index == EMBREE_SCENE_AIR)
        rtcSetGeometryIntersectFilterFunction(geometry, filter_sheets);
    else if (has_cutouts(&embree_scene->radiance->scene->model, mesh))
        rtcSetGeometryIntersectFilterFunction(geometry, filter_surroundings);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree_scene->scene, geometry, index);
    rtcReleaseGeometry(geometry);
    return done;
}

/* Adds the bubbles to the Embree scene as user geometry. Returns false when out of memory. */
static bool add_bubbles(struct embree_scene *embree_scene, RTCDevice device)
{
    const struct bubbles *bubbles = &embree_scene->radiance->scene->inclusions.bubbles;
    if (!bubbles->count)
        return true;
    embree_scene->bubbles = malloc(bubbles->count * sizeof(*embree_scene->bubbles));
    if (!embree_scene->bubbles)
        return false;
    for (uint32_t i = 0; i < bubbles->count; i++) {
        const mat4s pose = embree_scene->radiance->globals->world_from_object;
        struct bubble *bubble = &embree_scene->bubbles[i];
        *bubble = bubbles->all[i];
        bubble->center = glms_mat4_mulv3(pose, bubble->center, 1.0f);
        bubble->axis = glms_mat4_mulv3(pose, bubble->axis, 0.0f);
    }
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, bubbles->count);
    rtcSetGeometryUserData(geometry, embree_scene);
    rtcSetGeometryBoundsFunction(geometry, bound_bubble, NULL);
    rtcSetGeometryIntersectFunction(geometry, intersect_bubble);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree_scene->scene, geometry, EMBREE_SCENE_BUBBLES);
    rtcReleaseGeometry(geometry);
    return true;
}

/* Refuses scenes whose build would need more than `memory` bytes, to avoid swapping. */
static enum status check_size(const struct embree_scene *embree_scene, uint64_t memory)
{
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < EMBREE_SCENE_MESH_COUNT; i++)
        triangles += embree_scene->meshes[i].mesh->index_count / 3;
    if (triangles <= memory / TRIANGLE_SIZE)
        return STATUS_OK;
    log_error("--refraction reference: %llu triangles need about %.1f GiB, but only %.1f GiB are "
              "available: reduce object.triangles or landscape.triangles",
              (unsigned long long)triangles, (double)triangles * TRIANGLE_SIZE / 0x1p30,
              (double)memory / 0x1p30);
    return STATUS_TRY_AGAIN;
}

static bool has_textured_object(const struct model *model)
{
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (material_is_textured(&model->materials[model->objects[i].material]))
            return true;
    }
    return false;
}

enum status embree_scene_init(struct embree_scene *embree_scene, RTCDevice device,
                              const struct radiance *radiance, uint64_t memory)
{
    *embree_scene = (struct embree_scene){
        .radiance = radiance,
        .epsilon = fmaxf(1e-4f * radiance->globals->radius, radiance->scene->contacts.epsilon),
        .is_textured = has_textured_object(&radiance->scene->model),
        .meshes[EMBREE_SCENE_OBJECT].mesh = &radiance->scene->model.object,
        .meshes[EMBREE_SCENE_SURROUNDINGS].mesh = &radiance->scene->model.surroundings,
        .meshes[EMBREE_SCENE_CRACKS].mesh = &radiance->scene->inclusions.cracks,
        .meshes[EMBREE_SCENE_AIR].mesh = &radiance->scene->inclusions.air,
    };
    enum status status = check_size(embree_scene, memory);
    if (status != STATUS_OK)
        goto fail;
    rtcGetDeviceError(device); /* clears earlier errors */
    embree_scene->scene = rtcNewScene(device);
    rtcSetSceneFlags(embree_scene->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree_scene->scene, RTC_BUILD_QUALITY_HIGH);
    bool done = true;
    for (uint32_t i = 0; i < EMBREE_SCENE_MESH_COUNT; i++)
        done = done && add_mesh(embree_scene, device, i);
    done = done && add_bubbles(embree_scene, device);
    if (done)
        rtcCommitScene(embree_scene->scene);
    if (done && rtcGetDeviceError(device) == RTC_ERROR_NONE)
        return STATUS_OK;
    log_error("--refraction reference: out of memory for the scene's triangles");
    status = STATUS_TRY_AGAIN;
fail:
    embree_scene_finish(embree_scene);
    return status;
}

void embree_scene_finish(struct embree_scene *embree_scene)
{
    if (embree_scene->scene)
        rtcReleaseScene(embree_scene->scene);
    free(embree_scene->bubbles);
    *embree_scene = (struct embree_scene){ 0 };
}

static void add_scaled(double sum[static 3], double s, vec3s b)
{
    for (int k = 0; k < 3; k++)
        sum[k] += s * (double)b.raw[k];
}

static vec3s rounded(const double v[static 3])
{
    return (vec3s){ { (float)v[0], (float)v[1], (float)v[2] } };
}

/* Interpolates vertex attributes. The position is in world space, the normal in object space. */
static struct mesh_vertex interpolated(const struct embree_scene_mesh *scene_mesh,
                                       uint32_t triangle, float u, float v)
{
    const uint32_t *corners = &scene_mesh->mesh->indices[(size_t)triangle * 3];
    const double weights[3] = { 1.0 - (double)u - (double)v, (double)u, (double)v };
    double position[3] = { 0 };
    double normal[3] = { 0 };
    struct mesh_vertex surface = { .material = scene_mesh->mesh->vertices[corners[0]].material };
    for (int k = 0; k < 3; k++) {
        const struct mesh_vertex *corner = &scene_mesh->mesh->vertices[corners[k]];
        add_scaled(position, weights[k], scene_mesh->positions[corners[k]]);
        add_scaled(normal, weights[k], corner->normal);
        surface.color = glms_vec3_muladds(corner->color, (float)weights[k], surface.color);
        surface.uv = glms_vec2_muladds(corner->uv, (float)weights[k], surface.uv);
    }
    surface.position = rounded(position);
    surface.normal = rounded(normal);
    return surface;
}

/* Interpolates tangent and second uv set in a triangle. */
static struct mesh_extra interpolated_extra(const struct embree_scene_mesh *scene_mesh,
                                            uint32_t triangle, float u, float v)
{
    const uint32_t *corners = &scene_mesh->mesh->indices[(size_t)triangle * 3];
    const float weights[3] = { 1.0f - u - v, u, v };
    struct mesh_extra extra = { 0 };
    for (int k = 0; k < 3; k++) {
        const struct mesh_extra *corner = &scene_mesh->mesh->extras[corners[k]];
        extra.tangent = glms_vec3_muladds(corner->tangent, weights[k], extra.tangent);
        extra.side += weights[k] * corner->side;
        extra.uv = glms_vec2_muladds(corner->uv, weights[k], extra.uv);
    }
    return extra;
}

static vec3s facet_normal(const struct embree_scene_mesh *scene_mesh, uint32_t triangle)
{
    const uint32_t *corners = &scene_mesh->mesh->indices[(size_t)triangle * 3];
    const vec3s *p = scene_mesh->positions;
    return glms_vec3_normalize(glms_vec3_cross(glms_vec3_sub(p[corners[1]], p[corners[0]]),
                                               glms_vec3_sub(p[corners[2]], p[corners[0]])));
}

/* Computes the position derivatives dp/du and dp/dv for uv set 0 or 1. */
static void compute_derivatives(const struct embree_scene_mesh *scene_mesh,
                                struct embree_scene_hit *hit, int set)
{
    const uint32_t *corners = &scene_mesh->mesh->indices[(size_t)hit->triangle * 3];
    vec2s uv[3];
    for (int k = 0; k < 3; k++)
        uv[k] = set == 0 ? scene_mesh->mesh->vertices[corners[k]].uv
                         : scene_mesh->mesh->extras[corners[k]].uv;
    const vec2s first = glms_vec2_sub(uv[1], uv[0]);
    const vec2s second = glms_vec2_sub(uv[2], uv[0]);
    const vec3s *p = scene_mesh->positions;
    const vec3s edges[2] = { glms_vec3_sub(p[corners[1]], p[corners[0]]),
                             glms_vec3_sub(p[corners[2]], p[corners[0]]) };
    const float area = first.x * second.y - second.x * first.y;
    if (!(fabsf(area) > 0.0f))
        return;
    hit->dp_du[set] = glms_vec3_divs(
        glms_vec3_sub(glms_vec3_scale(edges[0], second.y), glms_vec3_scale(edges[1], first.y)),
        area);
    hit->dp_dv[set] = glms_vec3_divs(
        glms_vec3_sub(glms_vec3_scale(edges[1], first.x), glms_vec3_scale(edges[0], second.x)),
        area);
}

static struct embree_scene_hit bubble_hit(const struct embree_scene *embree_scene,
                                          const struct RTCRayHit *rayhit)
{
    const struct RTCRay *ray = &rayhit->ray;
    const struct bubble *bubble = &embree_scene->bubbles[rayhit->hit.primID];
    const struct bubble_face face =
        bubble_face_at(bubble, origin_of(ray), dir_of(ray), (double)ray->tfar);
    return (struct embree_scene_hit){
        .kind = EMBREE_SCENE_BUBBLES,
        .triangle = rayhit->hit.primID,
        .object = frame_media_count(embree_scene->radiance->scene),
        .distance = ray->tfar,
        .facet = face.normal,
        .surface = { .position = face.position, .normal = face.normal },
    };
}

bool embree_scene_is_at_contact(const struct embree_scene *embree_scene,
                                const struct embree_scene_hit *hit)
{
    return hit->kind == EMBREE_SCENE_OBJECT &&
           coincident_shells_has(&embree_scene->radiance->scene->contacts, hit->triangle);
}

bool embree_scene_intersect(const struct embree_scene *embree_scene,
                            const struct embree_scene_ray *ray, struct embree_scene_hit *hit)
{
    struct context context = { .ray = ray };
    struct RTCRayHit rayhit = {
        .ray = {
            .org_x = ray->origin.x,
            .org_y = ray->origin.y,
            .org_z = ray->origin.z,
            .dir_x = ray->dir.x,
            .dir_y = ray->dir.y,
            .dir_z = ray->dir.z,
            .tnear = ray->near,
            .tfar = ray->far > 0.0f ? ray->far : INFINITY,
            .mask = UINT32_MAX,
        },
        .hit = { .geomID = RTC_INVALID_GEOMETRY_ID, .instID[0] = RTC_INVALID_GEOMETRY_ID },
    };
    embree_intersect(embree_scene->scene, &context.embree, &rayhit);
    if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    if (rayhit.hit.geomID == EMBREE_SCENE_BUBBLES) {
        *hit = bubble_hit(embree_scene, &rayhit);
        return true;
    }
    const struct embree_scene_mesh *scene_mesh = &embree_scene->meshes[rayhit.hit.geomID];
    *hit = (struct embree_scene_hit){
        .kind = rayhit.hit.geomID,
        .triangle = rayhit.hit.primID,
        .object = scene_mesh == &embree_scene->meshes[EMBREE_SCENE_OBJECT]
                      ? object_of(embree_scene, rayhit.hit.primID)
                      : 0,
        .u = rayhit.hit.u,
        .v = rayhit.hit.v,
        .distance = rayhit.ray.tfar,
        .facet = facet_normal(scene_mesh, rayhit.hit.primID),
        .surface = interpolated(scene_mesh, rayhit.hit.primID, rayhit.hit.u, rayhit.hit.v),
    };
    const bool has_textures = hit->kind == EMBREE_SCENE_SURROUNDINGS ||
                              (hit->kind == EMBREE_SCENE_OBJECT && embree_scene->is_textured);
    if (has_textures)
        compute_derivatives(scene_mesh, hit, 0);
    if (has_textures && scene_mesh->mesh->extras) {
        compute_derivatives(scene_mesh, hit, 1);
        hit->extra = interpolated_extra(scene_mesh, rayhit.hit.primID, rayhit.hit.u, rayhit.hit.v);
    }
    const mat3s rotation =
        glms_mat4_pick3(world_from_mesh(embree_scene, scene_mesh, hit->surface.material));
    hit->surface.normal = glms_vec3_normalize(glms_mat3_mulv(rotation, hit->surface.normal));
    hit->extra.tangent = glms_mat3_mulv(rotation, hit->extra.tangent);
    return true;
}
