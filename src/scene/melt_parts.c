/* melt_parts.c: parts that are connected, and how they move. */
#include "src/scene/melt_parts.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/weld.h"

/* Depth of its middle, in halves of the ice's width, at which a part begins to shrink; that of
 * small parts is half their reach. */
#define SHRINKS_AT 0.06f

/* What is left of a part that is gone: its triangles still have normals. */
#define LEAST 1e-3f

/* Share of the ice's height, from below, along which water climbs it. */
#define LOWEST 0.25f

/* Share of the way to water's edge that ice covers at most; it bulges above the rest. */
#define WITHIN 0.9f

/* How deep a film fills hollows that it runs over, by how deep it was. */
#define HOLLOW 3.0f

enum {
    BEARINGS = 64,
};

/* A part of an object. */
struct part {
    struct box box;
    vec3s middle; /* that of its points */
    float reach;  /* distance of the farthest point from there */
    uint32_t count;
};

struct parts {
    struct weld weld;
    uint32_t *heads;  /* of each point: another one of its part, or itself */
    struct part *all; /* of those points that are their own heads */
};

static uint32_t head_of(uint32_t *heads, uint32_t point)
{
    while (heads[point] != point) {
        heads[point] = heads[heads[point]];
        point = heads[point];
    }
    return point;
}

static void parts_finish(struct parts *parts)
{
    weld_finish(&parts->weld);
    free(parts->heads);
    free(parts->all);
}

/* Returns the part of a vertex, or NULL if the vertex is not of the object. */
static struct part *part_of(const struct parts *parts, uint32_t vertex)
{
    const uint32_t point = parts->weld.points[vertex];
    return point == WELD_NONE ? NULL : &parts->all[head_of(parts->heads, point)];
}

static void measure(struct parts *parts, const struct mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct part *part = part_of(parts, i);
        const vec3s p = mesh->vertices[i].position;
        if (!part)
            continue;
        part->box.min = part->count ? glms_vec3_minv(part->box.min, p) : p;
        part->box.max = part->count ? glms_vec3_maxv(part->box.max, p) : p;
        part->middle = glms_vec3_add(part->middle, p);
        part->count++;
    }
    for (uint32_t i = 0; i < parts->weld.count; i++) {
        struct part *part = &parts->all[i];
        part->middle = glms_vec3_divs(part->middle, fmaxf((float)part->count, 1.0f));
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct part *part = part_of(parts, i);
        if (part)
            part->reach =
                fmaxf(part->reach, glms_vec3_distance(part->middle, mesh->vertices[i].position));
    }
}

static bool parts_init(struct parts *parts, const struct mesh *mesh, const struct object *object)
{
    *parts = (struct parts){ 0 };
    if (!weld_init(&parts->weld, mesh, object->first_index, object->index_count))
        return false;
    parts->heads = malloc((parts->weld.count + (size_t)1) * sizeof(*parts->heads));
    parts->all = calloc(parts->weld.count + (size_t)1, sizeof(*parts->all));
    if (!parts->heads || !parts->all) {
        parts_finish(parts);
        return false;
    }
    for (uint32_t i = 0; i < parts->weld.count; i++)
        parts->heads[i] = i;
    for (uint32_t i = 0; i < parts->weld.corner_count; i++) {
        const uint32_t *corners = parts->weld.corners;
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        parts->heads[head_of(parts->heads, corners[i])] = head_of(parts->heads, corners[next]);
    }
    measure(parts, mesh);
    return true;
}

float melt_parts_depth(const struct depth_field *field, vec3s point)
{
    for (int k = 0; k < 3; k++) {
        if (!(point.raw[k] > field->box.min.raw[k] && point.raw[k] < field->box.max.raw[k]))
            return 0.0f;
    }
    return field->most * depth_field_at(field, point);
}

/* Finds how deep the ice is, and was. */
static bool find_depths(struct melt_parts_ice *ice, const struct mesh *mesh)
{
    const struct mesh after = object_part(ice->object, mesh);
    const struct mesh before = object_part(ice->object, ice->grown);
    return ice->depth.texels ||
           (depth_field_init(&ice->depth, &after) && depth_field_init(&ice->depth_before, &before));
}

bool melt_parts_shrink(struct model *model, uint32_t object, struct melt_parts_ice *ice)
{
    struct mesh *mesh = &model->object;
    struct parts parts;
    if (!parts_init(&parts, mesh, &model->objects[object]))
        return false;
    const bool done = find_depths(ice, mesh);
    for (uint32_t i = 0; i < mesh->vertex_count && done; i++) {
        const struct part *part = part_of(&parts, i);
        if (!part)
            continue;
        vec3s middle = part->middle;
        middle.y += ice->rise;
        if (!(melt_parts_depth(&ice->depth_before, middle) > 0.0f))
            continue;
        const float due = fminf(0.5f * part->reach, SHRINKS_AT * ice->half);
        const float depth = melt_parts_depth(&ice->depth, middle);
        const float share = fmaxf(glm_smoothstep(0.0f, due, depth), LEAST);
        const vec3s from = glms_vec3_sub(mesh->vertices[i].position, part->middle);
        mesh->vertices[i].position = glms_vec3_muladds(from, share, middle);
    }
    parts_finish(&parts);
    return done;
}

/* Whether the ice stands on a part of an object, or in it. */
static bool is_below(const struct part *part, const struct box *ice)
{
    const vec3s foot = box_center(*ice);
    const float hair = 0.02f * (ice->max.y - ice->min.y);
    return part->count && foot.x > part->box.min.x && foot.x < part->box.max.x &&
           foot.z > part->box.min.z && foot.z < part->box.max.z && part->box.max.y < foot.y &&
           part->box.max.y > ice->min.y - hair;
}

/* How far something reaches from an upright axis, by direction. */
struct reach {
    vec3s foot; /* on the axis */
    float out[BEARINGS];
};

static float bearing_of(const struct reach *reach, vec3s p)
{
    const float turn = atan2f(p.z - reach->foot.z, p.x - reach->foot.x) / 6.28318531f;
    return (turn - floorf(turn)) * (float)BEARINGS;
}

static void reach_put(struct reach *reach, vec3s p)
{
    float *out = &reach->out[(uint32_t)bearing_of(reach, p) % BEARINGS];
    *out = fmaxf(*out, hypotf(p.x - reach->foot.x, p.z - reach->foot.z));
}

/* Gives directions of no point the reach of the nearest ones. */
static void reach_fill(struct reach *reach)
{
    const struct reach known = *reach;
    for (uint32_t i = 0; i < BEARINGS; i++) {
        for (uint32_t k = 1; k <= BEARINGS / 2 && !(reach->out[i] > 0.0f); k++)
            reach->out[i] =
                fmaxf(known.out[(i + k) % BEARINGS], known.out[(i + BEARINGS - k) % BEARINGS]);
    }
}

/* Returns the reach in the direction of a point. */
static float reach_at(const struct reach *reach, vec3s p)
{
    const float at = bearing_of(reach, p) + (float)BEARINGS - 0.5f;
    const uint32_t before = (uint32_t)at;
    return glm_lerp(reach->out[before % BEARINGS], reach->out[(before + 1) % BEARINGS],
                    at - (float)before);
}

/* Returns how far the lowest part of an object reaches. */
static struct reach reach_of(const struct object *object, const struct mesh *mesh, vec3s foot)
{
    const struct box box = object_box(object, mesh);
    const float low = box.min.y + LOWEST * (box.max.y - box.min.y);
    struct reach reach = { .foot = foot };
    for (uint32_t i = 0; i < object->index_count; i++) {
        const vec3s p = mesh->vertices[mesh->indices[object->first_index + i]].position;
        if (p.y <= low)
            reach_put(&reach, p);
    }
    reach_fill(&reach);
    return reach;
}

/* Water that has climbed the ice stays there: what is nearer than the ice's surface moves with it,
 * and so does what is close outside, but the farther, the more it spreads. */
static float spread_from(float out, float before, float after, float edge, float share)
{
    if (!(before > 0.0f && edge > 0.0f))
        return share * out;
    const float from = fminf(before, WITHIN * edge);
    if (out < from)
        return out * after / from;
    const float way = (out - from) / (edge - from);
    const float least = after + out - from;
    return glm_lerp(least, fmaxf(share * edge, least), way * way);
}

/* Spreads a part; the ice reaches as far as `before` and `after` tell. */
static void spread_part(const struct parts *parts, const struct part *part, struct mesh *mesh,
                        const struct reach *before, const struct reach *after, float spread)
{
    const vec3s foot = before->foot;
    const vec3s sides = glms_vec3_sub(part->box.max, part->box.min);
    const float radius = 0.25f * (sides.x + sides.z);
    const float share = hypotf(radius, spread) / fmaxf(radius, 1e-20f);
    struct reach edge = { .foot = foot };
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (part_of(parts, i) == part)
            reach_put(&edge, mesh->vertices[i].position);
    }
    reach_fill(&edge);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        vec3s *p = &mesh->vertices[i].position;
        if (part_of(parts, i) != part)
            continue;
        const float out = hypotf(p->x - foot.x, p->z - foot.z);
        const float to =
            spread_from(out, reach_at(before, *p), reach_at(after, *p), reach_at(&edge, *p), share);
        const float grown = to / fmaxf(out, 1e-20f);
        p->x = foot.x + grown * (p->x - foot.x);
        p->z = foot.z + grown * (p->z - foot.z);
    }
}

/* Spreads those parts of an object of a mesh that are below the ice. */
static bool spread(struct mesh *mesh, const struct object *object, const struct model *model,
                   const struct melt_parts_ice *ice)
{
    const vec3s foot = box_center(ice->object->box);
    const struct reach before = reach_of(ice->object, ice->grown, foot);
    const struct reach after = reach_of(ice->object, &model->object, foot);
    struct parts parts;
    if (!parts_init(&parts, mesh, object))
        return false;
    for (uint32_t i = 0; i < parts.weld.count; i++) {
        if (is_below(&parts.all[i], &ice->object->box))
            spread_part(&parts, &parts.all[i], mesh, &before, &after, ice->spread);
    }
    parts_finish(&parts);
    return true;
}

bool melt_parts_spread(struct model *model, uint32_t object, const struct melt_parts_ice *ice)
{
    return spread(&model->object, &model->objects[object], model, ice);
}

/* ---- films on what is around the objects ---- */

static bool is_film(const struct model *model, const struct mesh_vertex *vertex)
{
    const uint32_t index = vertex->material >> MESH_SURFACE_SHIFT;
    return index && model->materials[index - 1].flags & MATERIAL_IS_FILM;
}

/* The triangles of the surroundings that are films, or are not; the vertices are those of all. */
static bool choose(struct mesh *chosen, const struct model *model, bool are_films)
{
    const struct mesh *all = &model->surroundings;
    *chosen = *all;
    chosen->indices = malloc((all->index_count + (size_t)1) * sizeof(*chosen->indices));
    chosen->index_count = 0;
    if (!chosen->indices)
        return false;
    for (uint32_t i = 0; i < all->index_count; i++) {
        if (is_film(model, &all->vertices[all->indices[i]]) == are_films)
            chosen->indices[chosen->index_count++] = all->indices[i];
    }
    return true;
}

/* Returns the height of the highest triangle at a place, or -INFINITY. */
static float ground_at(const struct mesh *ground, float x, float z)
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

/* How texture coordinates grow with places. */
struct growth {
    vec2s by_x, by_z;
};

/* Returns that of vertices whose coordinates grow evenly, by least squares. */
static struct growth growth_of(const struct mesh *mesh)
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
        return (struct growth){ 0 };
    return (struct growth){
        glms_vec2_divs(glms_vec2_sub(glms_vec2_scale(by_x, zz), glms_vec2_scale(by_z, xz)), area),
        glms_vec2_divs(glms_vec2_sub(glms_vec2_scale(by_z, xx), glms_vec2_scale(by_x, xz)), area),
    };
}

/* Turns normals of films as their triangles have turned. `turned` is a copy of them, with normals
 * that its triangles had before. */
static void turn_normals(const struct model *model, struct mesh *films, struct mesh *turned)
{
    for (uint32_t i = 0; i < films->vertex_count; i++) {
        struct mesh_vertex *v = &films->vertices[i];
        if (is_film(model, v))
            v->normal = glms_vec3_sub(v->normal, turned->vertices[i].normal);
        turned->vertices[i].position = v->position;
    }
    mesh_make_normals(turned);
    for (uint32_t i = 0; i < films->vertex_count; i++) {
        struct mesh_vertex *v = &films->vertices[i];
        if (!is_film(model, v))
            continue;
        v->normal = glms_vec3_normalize(glms_vec3_add(v->normal, turned->vertices[i].normal));
    }
}

/* Moves films' textures and heights after vertices that were elsewhere before. Stone that stood out
 * of the water does not make it thinner elsewhere: `level` is the ground's height below the ice.
 * Hollows are filled, the deeper, the deeper the water was: it stays level, but for its rim. */
static void follow_ground(struct mesh *films, const struct mesh *before,
                          const struct growth *growth, const struct mesh *ground, float level)
{
    for (uint32_t i = 0; i < films->vertex_count; i++) {
        struct mesh_vertex *v = &films->vertices[i];
        const vec3s from = before->vertices[i].position;
        const float dx = v->position.x - from.x, dz = v->position.z - from.z;
        if (fabsf(dx) + fabsf(dz) <= 0.0f)
            continue;
        const float deep = from.y - fminf(ground_at(ground, from.x, from.z), level);
        const float filled = deep > 0.0f ? HOLLOW * deep : deep;
        const float fall = ground_at(ground, v->position.x, v->position.z) + filled - from.y;
        v->uv = glms_vec2_muladds(growth->by_x, dx, glms_vec2_muladds(growth->by_z, dz, v->uv));
        if (fall < 0.0f && isfinite(fall))
            v->position.y += fall;
    }
}

bool melt_parts_spread_films(struct model *model, const struct melt_parts_ice *ice)
{
    struct mesh films, ground = { 0 }, before = { 0 };
    bool done = choose(&films, model, true) && choose(&ground, model, false);
    const struct object object = { .index_count = films.index_count };
    if (done && films.index_count) {
        const struct growth growth = growth_of(&films);
        done = mesh_append(&before, &films) && spread(&films, &object, model, ice);
        if (done) {
            mesh_make_normals(&before);
            const vec3s foot = box_center(ice->object->box);
            follow_ground(&films, &before, &growth, &ground, ground_at(&ground, foot.x, foot.z));
            turn_normals(model, &films, &before);
        }
    }
    free(films.indices);
    free(ground.indices);
    mesh_finish(&before);
    return done;
}

void melt_parts_finish(struct melt_parts_ice *ice)
{
    depth_field_finish(&ice->depth);
    depth_field_finish(&ice->depth_before);
}
