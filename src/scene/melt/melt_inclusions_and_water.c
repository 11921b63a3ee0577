/* melt_inclusions_and_water.c: moves air pockets and water with the melting ice. */
#include "src/scene/melt/melt_inclusions_and_water.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/geometry/vertex_weld.h"

/* Depth at which an air pocket's centre begins to shrink the pocket, in half widths of the ice. The
 * depth is at most half the pocket's radius. */
#define SHRINKS_AT 0.06f

#define SCALE_MIN 1e-3f /* minimum scale of an air pocket, which keeps normals valid */

#define WET_FRACTION 0.25f /* fraction of the ice's height that climbing water wets */

#define COVERED_MAX 0.9f /* maximum fraction of the water's radius that ice covers */

/* Size of the ice, relative to its initial one, below which the meniscus around it flattens. */
#define MENISCUS_FLATTENS 0.3f

/* Water is level between these fractions of the way from the ice to the water's edge. */
#define LEVEL_FROM 0.3f
#define LEVEL_TO   0.7f

#define HOLLOW 3.0f /* maximum factor by which a water layer thickens over hollows of the ground */

enum {
    BEARINGS = 64,
};

/* Connected component of an object. */
struct component {
    struct box box;
    vec3s center;  /* mean of the component's vertices */
    float outline; /* distance of the farthest vertex from `center` */
    uint32_t count;
};

struct components {
    struct vertex_weld vertex_weld;
    uint32_t *parents;     /* union-find parent of each welded point */
    struct component *all; /* component of each root point */
};

static uint32_t find_root(uint32_t *parents, uint32_t point)
{
    while (parents[point] != point) {
        parents[point] = parents[parents[point]];
        point = parents[point];
    }
    return point;
}

static void components_finish(struct components *components)
{
    vertex_weld_finish(&components->vertex_weld);
    free(components->parents);
    free(components->all);
}

/* Returns the connected component of a vertex, or NULL if the object lacks the vertex. */
static struct component *component_of(const struct components *components, uint32_t vertex)
{
    const uint32_t point = components->vertex_weld.points[vertex];
    return point == VERTEX_WELD_NONE ? NULL
                                     : &components->all[find_root(components->parents, point)];
}

static void measure(struct components *components, const struct mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct component *component = component_of(components, i);
        const vec3s p = mesh->vertices[i].position;
        if (!component)
            continue;
        component->box.min = component->count ? glms_vec3_minv(component->box.min, p) : p;
        component->box.max = component->count ? glms_vec3_maxv(component->box.max, p) : p;
        component->center = glms_vec3_add(component->center, p);
        component->count++;
    }
    for (uint32_t i = 0; i < components->vertex_weld.count; i++) {
        struct component *component = &components->all[i];
        component->center = glms_vec3_divs(component->center, fmaxf((float)component->count, 1.0f));
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct component *component = component_of(components, i);
        if (component)
            component->outline =
                fmaxf(component->outline,
                      glms_vec3_distance(component->center, mesh->vertices[i].position));
    }
}

static bool components_init(struct components *components, const struct mesh *mesh,
                            const struct object *object)
{
    *components = (struct components){ 0 };
    if (!vertex_weld_init(&components->vertex_weld, mesh, object->first_index, object->index_count))
        return false;
    components->parents =
        malloc((components->vertex_weld.count + (size_t)1) * sizeof(*components->parents));
    components->all = calloc(components->vertex_weld.count + (size_t)1, sizeof(*components->all));
    if (!components->parents || !components->all) {
        components_finish(components);
        return false;
    }
    for (uint32_t i = 0; i < components->vertex_weld.count; i++)
        components->parents[i] = i;
    for (uint32_t i = 0; i < components->vertex_weld.corner_count; i++) {
        const uint32_t *corners = components->vertex_weld.corners;
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        components->parents[find_root(components->parents, corners[i])] =
            find_root(components->parents, corners[next]);
    }
    measure(components, mesh);
    return true;
}

float melt_air_and_water_depth(const struct distance_field *field, vec3s point)
{
    for (int k = 0; k < 3; k++) {
        if (!(point.raw[k] > field->box.min.raw[k] && point.raw[k] < field->box.max.raw[k]))
            return 0.0f;
    }
    return field->max_depth * distance_field_at(field, point);
}

/* Computes distance fields of the ice after and before melting. */
static bool find_depths(struct melt_air_and_water_ice *ice, const struct mesh *mesh)
{
    const struct mesh after = object_mesh(ice->object, mesh);
    const struct mesh before = object_mesh(ice->object, ice->unmelted);
    return ice->depth.texels || (distance_field_init(&ice->depth, &after) &&
                                 distance_field_init(&ice->depth_before, &before));
}

bool melt_air_and_water_shrink_air(struct model *model, uint32_t object,
                                   struct melt_air_and_water_ice *ice)
{
    struct mesh *mesh = &model->object;
    struct components components;
    if (!components_init(&components, mesh, &model->objects[object]))
        return false;
    const bool done = find_depths(ice, mesh);
    for (uint32_t i = 0; i < mesh->vertex_count && done; i++) {
        const struct component *component = component_of(&components, i);
        if (!component)
            continue;
        vec3s center = component->center;
        center.y += ice->rise;
        if (!(melt_air_and_water_depth(&ice->depth_before, center) > 0.0f))
            continue;
        const float start_depth = fminf(0.5f * component->outline, SHRINKS_AT * ice->half);
        const float depth = melt_air_and_water_depth(&ice->depth, center);
        const float scale = fmaxf(glm_smoothstep(0.0f, start_depth, depth), SCALE_MIN);
        const vec3s from = glms_vec3_sub(mesh->vertices[i].position, component->center);
        mesh->vertices[i].position = glms_vec3_muladds(from, scale, center);
    }
    components_finish(&components);
    return done;
}

/* Returns true if the ice stands on or in a connected component of water. */
static bool is_below(const struct component *component, const struct box *ice)
{
    const vec3s base = box_center(*ice);
    const float epsilon = 0.02f * (ice->max.y - ice->min.y);
    return component->count && base.x > component->box.min.x && base.x < component->box.max.x &&
           base.z > component->box.min.z && base.z < component->box.max.z &&
           component->box.max.y < base.y && component->box.max.y > ice->min.y - epsilon;
}

/* Radii of a shape around a vertical axis, one per horizontal direction. */
struct outline {
    vec3s base;
    float out[BEARINGS];
};

static float bearing(const struct outline *outline, vec3s p)
{
    const float angle = atan2f(p.z - outline->base.z, p.x - outline->base.x) / 6.28318531f;
    return (angle - floorf(angle)) * (float)BEARINGS;
}

static void outline_add(struct outline *outline, vec3s p)
{
    float *out = &outline->out[(uint32_t)bearing(outline, p) % BEARINGS];
    *out = fmaxf(*out, hypotf(p.x - outline->base.x, p.z - outline->base.z));
}

/* Sets the radius in directions without vertices to the radius in the nearest other direction. */
static void outline_fill(struct outline *outline)
{
    const struct outline known = *outline;
    for (uint32_t i = 0; i < BEARINGS; i++) {
        for (uint32_t k = 1; k <= BEARINGS / 2 && !(outline->out[i] > 0.0f); k++)
            outline->out[i] =
                fmaxf(known.out[(i + k) % BEARINGS], known.out[(i + BEARINGS - k) % BEARINGS]);
    }
}

/* Returns the outline's interpolated radius in the direction of a point. */
static float outline_at(const struct outline *outline, vec3s p)
{
    const float at = bearing(outline, p) + (float)BEARINGS - 0.5f;
    const uint32_t before = (uint32_t)at;
    return glm_lerp(outline->out[before % BEARINGS], outline->out[(before + 1) % BEARINGS],
                    at - (float)before);
}

/* Returns the outline of the lower WET_FRACTION of an object. */
static struct outline outline_of(const struct object *object, const struct mesh *mesh, vec3s base)
{
    const struct box box = object_box(object, mesh);
    const float low = box.min.y + WET_FRACTION * (box.max.y - box.min.y);
    struct outline outline = { .base = base };
    for (uint32_t i = 0; i < object->index_count; i++) {
        const vec3s p = mesh->vertices[mesh->indices[object->first_index + i]].position;
        if (p.y <= low)
            outline_add(&outline, p);
    }
    outline_fill(&outline);
    return outline;
}

/* Returns the new horizontal radius of a water vertex. Below the ice, water moves with the ice's
 * outline. Outside, the motion blends smoothly into the motion of the water's edge. The blend is
 * flat at the edge, because the outline is coarser than its bays. */
static float spread_radius(float out, float before, float after, float edge, float scale)
{
    if (!(before > 0.0f && edge > 0.0f))
        return scale * out;
    const float from = fminf(before, COVERED_MAX * edge);
    if (out < from)
        return out * after / from;
    const float t = (out - from) / (edge - from);
    const float pushed = after + out - from;
    return glm_lerp(pushed, fmaxf(scale * edge, pushed), glm_smoothstep(0.0f, 1.0f, t));
}

/* Water around melting ice. */
struct puddle {
    struct outline before, after; /* of the ice, before and after melting */
    struct outline edge;          /* of the water, before melting */
    float spread;                 /* radius of the area that the meltwater covers, metres */
};

/* Returns the water level between the meniscus at the ice and the rim, or INFINITY if the component
 * has no vertices there. */
static float level_of(const struct components *components, const struct component *component,
                      const struct mesh *mesh, const struct puddle *puddle)
{
    const vec3s base = puddle->before.base;
    float sum = 0.0f;
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const vec3s p = mesh->vertices[i].position;
        if (component_of(components, i) != component)
            continue;
        const float ice = outline_at(&puddle->before, p);
        const float from_ice = (hypotf(p.x - base.x, p.z - base.z) - ice) /
                               fmaxf(outline_at(&puddle->edge, p) - ice, 1e-20f);
        const bool is_open =
            from_ice > LEVEL_FROM && from_ice < LEVEL_TO && mesh->vertices[i].normal.y > 0.0f;
        sum += is_open ? p.y : 0.0f;
        count += is_open;
    }
    return count ? sum / (float)count : INFINITY;
}

/* Spreads water horizontally around melting ice. Flattens the meniscus as the ice vanishes. */
static void spread_component(const struct components *components, const struct component *component,
                             struct mesh *mesh, struct puddle *puddle)
{
    const vec3s base = puddle->before.base;
    const vec3s sides = glms_vec3_sub(component->box.max, component->box.min);
    const float radius = 0.25f * (sides.x + sides.z);
    const float scale = hypotf(radius, puddle->spread) / fmaxf(radius, 1e-20f);
    puddle->edge = (struct outline){ .base = base };
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (component_of(components, i) == component)
            outline_add(&puddle->edge, mesh->vertices[i].position);
    }
    outline_fill(&puddle->edge);
    const float level = level_of(components, component, mesh, puddle);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        vec3s *p = &mesh->vertices[i].position;
        if (component_of(components, i) != component)
            continue;
        const float out = hypotf(p->x - base.x, p->z - base.z);
        const float before = outline_at(&puddle->before, *p);
        const float after = outline_at(&puddle->after, *p);
        const float edge = outline_at(&puddle->edge, *p);
        const float to = spread_radius(out, before, after, edge, scale);
        const float steep = glm_smoothstep(0.0f, MENISCUS_FLATTENS, after / fmaxf(before, 1e-20f));
        if (out < glm_lerp(before, edge, LEVEL_FROM) && p->y > level)
            p->y = level + steep * (p->y - level);
        const float unmelted = to / fmaxf(out, 1e-20f);
        p->x = base.x + unmelted * (p->x - base.x);
        p->z = base.z + unmelted * (p->z - base.z);
    }
}

/* Spreads those connected components of a water object on or in which the ice stands. */
static bool spread(struct mesh *mesh, const struct object *object, const struct model *model,
                   const struct melt_air_and_water_ice *ice)
{
    const vec3s base = box_center(ice->object->box);
    struct puddle puddle = {
        .before = outline_of(ice->object, ice->unmelted, base),
        .after = outline_of(ice->object, &model->object, base),
        .spread = ice->spread,
    };
    struct components components;
    if (!components_init(&components, mesh, object))
        return false;
    for (uint32_t i = 0; i < components.vertex_weld.count; i++) {
        if (is_below(&components.all[i], &ice->object->box))
            spread_component(&components, &components.all[i], mesh, &puddle);
    }
    components_finish(&components);
    return true;
}

bool melt_air_and_water_spread_components(struct model *model, uint32_t object,
                                          const struct melt_air_and_water_ice *ice)
{
    return spread(&model->object, &model->objects[object], model, ice);
}

static bool is_water_layer(const struct model *model, const struct mesh_vertex *vertex)
{
    const uint32_t index = vertex->material >> MESH_SURFACE_SHIFT;
    return index && model->materials[index - 1].flags & MATERIAL_IS_WATER_LAYER;
}

/* Selects the water layers of the surroundings, or all else. *selected borrows the vertices. */
static bool select_triangles(struct mesh *selected, const struct model *model,
                             bool are_water_layers)
{
    const struct mesh *all = &model->surroundings;
    *selected = *all;
    selected->indices = malloc((all->index_count + (size_t)1) * sizeof(*selected->indices));
    selected->index_count = 0;
    if (!selected->indices)
        return false;
    for (uint32_t i = 0; i < all->index_count; i++) {
        if (is_water_layer(model, &all->vertices[all->indices[i]]) == are_water_layers)
            selected->indices[selected->index_count++] = all->indices[i];
    }
    return true;
}

/* Returns the height of the highest triangle at (x, z); -INFINITY if there is none. */
static float ground_height(const struct mesh *ground, float x, float z)
{
    float height = -INFINITY;
    for (uint32_t i = 0; i < ground->index_count; i += 3) {
        vec3s p[3];
        for (int k = 0; k < 3; k++)
            p[k] = ground->vertices[ground->indices[i + (uint32_t)k]].position;
        if (fminf(p[0].x, fminf(p[1].x, p[2].x)) > x || fmaxf(p[0].x, fmaxf(p[1].x, p[2].x)) < x ||
            fminf(p[0].z, fminf(p[1].z, p[2].z)) > z || fmaxf(p[0].z, fmaxf(p[1].z, p[2].z)) < z)
            continue;
        const float ax = p[1].x - p[0].x, az = p[1].z - p[0].z;
        const float bx = p[2].x - p[0].x, bz = p[2].z - p[0].z;
        const float area = ax * bz - az * bx;
        const float u = ((x - p[0].x) * bz - (z - p[0].z) * bx) / area;
        const float v = (ax * (z - p[0].z) - az * (x - p[0].x)) / area;
        if (u >= -1e-3f && v >= -1e-3f && u + v <= 1.001f)
            height = fmaxf(height, p[0].y + u * (p[1].y - p[0].y) + v * (p[2].y - p[0].y));
    }
    return height;
}

/* Gradients of texture coordinates with respect to position. */
struct uv_gradient {
    vec2s by_x, by_z;
};

/* Returns the least-squares gradient of texture coordinates that depend linearly on position. */
static struct uv_gradient uv_gradient_of(const struct mesh *mesh)
{
    const float count = fmaxf((float)mesh->index_count, 1.0f);
    float x = 0, z = 0, xx = 0, xz = 0, zz = 0;
    vec2s by_x = glms_vec2_zero(), by_z = glms_vec2_zero();
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        x += mesh->vertices[mesh->indices[i]].position.x / count;
        z += mesh->vertices[mesh->indices[i]].position.z / count;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const struct mesh_vertex *v = &mesh->vertices[mesh->indices[i]];
        const float dx = v->position.x - x, dz = v->position.z - z;
        xx += dx * dx;
        xz += dx * dz;
        zz += dz * dz;
        by_x = glms_vec2_add(by_x, glms_vec2_scale(v->uv, dx));
        by_z = glms_vec2_add(by_z, glms_vec2_scale(v->uv, dz));
    }
    const float area = xx * zz - xz * xz;
    if (!(area > 1e-6f * xx * zz))
        return (struct uv_gradient){ 0 };
    return (struct uv_gradient){
        glms_vec2_divs(glms_vec2_sub(glms_vec2_scale(by_x, zz), glms_vec2_scale(by_z, xz)), area),
        glms_vec2_divs(glms_vec2_sub(glms_vec2_scale(by_z, xx), glms_vec2_scale(by_x, xz)), area),
    };
}

/* Rotates the normals of moved water layers. `rotated` has the geometric normals before the move.
 */
static void rotate_normals(const struct model *model, struct mesh *layers, struct mesh *rotated)
{
    for (uint32_t i = 0; i < layers->vertex_count; i++) {
        struct mesh_vertex *v = &layers->vertices[i];
        if (is_water_layer(model, v))
            v->normal = glms_vec3_sub(v->normal, rotated->vertices[i].normal);
        rotated->vertices[i].position = v->position;
    }
    mesh_make_normals(rotated);
    for (uint32_t i = 0; i < layers->vertex_count; i++) {
        struct mesh_vertex *v = &layers->vertices[i];
        if (!is_water_layer(model, v))
            continue;
        v->normal = glms_vec3_normalize(glms_vec3_add(v->normal, rotated->vertices[i].normal));
    }
}

/* Moves texture coordinates of water layers with their vertices. Lowers moved vertices where the
 * ground falls. `level` is the ground height below the ice. On higher ground, a layer's thickness
 * is measured from `level`. */
static void follow_ground(struct mesh *layers, const struct mesh *before,
                          const struct uv_gradient *uv_gradient, const struct mesh *ground,
                          float level)
{
    for (uint32_t i = 0; i < layers->vertex_count; i++) {
        struct mesh_vertex *v = &layers->vertices[i];
        const vec3s from = before->vertices[i].position;
        const float dx = v->position.x - from.x, dz = v->position.z - from.z;
        if (fabsf(dx) + fabsf(dz) <= 0.0f)
            continue;
        const float deep = from.y - fminf(ground_height(ground, from.x, from.z), level);
        const float filled = deep > 0.0f ? HOLLOW * deep : deep;
        const float drop = ground_height(ground, v->position.x, v->position.z) + filled - from.y;
        v->uv = glms_vec2_muladds(uv_gradient->by_x, dx,
                                  glms_vec2_muladds(uv_gradient->by_z, dz, v->uv));
        if (drop < 0.0f && isfinite(drop))
            v->position.y += drop;
    }
}

bool melt_air_and_water_spread_layers(struct model *model, const struct melt_air_and_water_ice *ice)
{
    struct mesh layers, ground = { 0 }, before = { 0 };
    bool done = select_triangles(&layers, model, true) && select_triangles(&ground, model, false);
    const struct object object = { .index_count = layers.index_count };
    if (done && layers.index_count) {
        const struct uv_gradient uv_gradient = uv_gradient_of(&layers);
        done = mesh_append(&before, &layers) && spread(&layers, &object, model, ice);
        if (done) {
            mesh_make_normals(&before);
            const vec3s base = box_center(ice->object->box);
            follow_ground(&layers, &before, &uv_gradient, &ground,
                          ground_height(&ground, base.x, base.z));
            rotate_normals(model, &layers, &before);
        }
    }
    free(layers.indices);
    free(ground.indices);
    mesh_finish(&before);
    return done;
}

void melt_air_and_water_finish(struct melt_air_and_water_ice *ice)
{
    distance_field_finish(&ice->depth);
    distance_field_finish(&ice->depth_before);
}
