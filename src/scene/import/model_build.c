/* model_build.c: merges a file's transformed meshes into the object and surroundings meshes. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/importer.h"

static bool are_finite(const float *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(numbers[i]))
            return false;
    }
    return true;
}

static enum status bad_vertex(const struct model_import *import, const struct model_shape *shape,
                              uint32_t vertex, const char *what)
{
    log_error("%s: %s: vertex %u: %s", import->path, shape->name, vertex, what);
    return STATUS_DATA;
}

enum status model_shape_check(const struct model_import *import, const struct model_shape *shape)
{
    for (uint32_t i = 0; i < shape->index_count; i++) {
        if (shape->indices[i] >= shape->vertex_count)
            return bad_vertex(import, shape, shape->indices[i],
                              "a triangle has the index of a vertex that does not exist");
    }
    for (size_t i = 0; i < shape->vertex_count; i++) {
        const uint32_t vertex = (uint32_t)i;
        if (!are_finite(&shape->positions[3 * i], 3))
            return bad_vertex(import, shape, vertex, "the position is not finite");
        if (shape->normals && !are_finite(&shape->normals[3 * i], 3))
            return bad_vertex(import, shape, vertex, "the normal is not finite");
        if (shape->uvs && !are_finite(&shape->uvs[shape->uv_stride * i], 2))
            return bad_vertex(import, shape, vertex, "the texture coordinates are not finite");
        if (shape->other_uvs && !are_finite(&shape->other_uvs[2 * i], 2))
            return bad_vertex(import, shape, vertex, "the texture coordinates are not finite");
        if (shape->tangents && !are_finite(&shape->tangents[4 * i], 4))
            return bad_vertex(import, shape, vertex, "the tangent is not finite");
        if (shape->colors && !are_finite(&shape->colors[4 * i], 3))
            return bad_vertex(import, shape, vertex, "the colour is not finite");
    }
    return STATUS_OK;
}

static void extend_by_positions(double low[static 3], double high[static 3], const float *positions,
                                uint32_t vertex_count)
{
    for (size_t i = 0; i < vertex_count; i++) {
        for (size_t k = 0; k < 3; k++) {
            low[k] = fmin(low[k], (double)positions[3 * i + k]);
            high[k] = fmax(high[k], (double)positions[3 * i + k]);
        }
    }
}

void model_build_extend(struct model_build *build, enum model_role role, const float *positions,
                        uint32_t vertex_count, const struct affine *model_from_shape)
{
    double low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    extend_by_positions(low, high, positions, vertex_count);
    for (unsigned i = 0; i < 8; i++) {
        double corner[3] = { 0 };
        for (int k = 0; k < 3 && vertex_count > 0; k++)
            corner[k] = i >> k & 1 ? high[k] : low[k];
        affine_transform(model_from_shape, corner);
        for (int k = 0; k < 3; k++) {
            build->low[role][k] = fmin(build->low[role][k], corner[k]);
            build->high[role][k] = fmax(build->high[role][k], corner[k]);
        }
    }
}

void model_build_init(struct model_build *build, struct model_import *import, struct model *model)
{
    *build = (struct model_build){
        .import = import,
        .model = model,
        .meshes[MODEL_OBJECT] = &model->object,
        .meshes[MODEL_SURROUNDINGS] = &model->surroundings,
    };
    for (int i = 0; i < MODEL_ROLE_COUNT; i++) {
        for (int k = 0; k < 3; k++) {
            build->low[i][k] = HUGE_VAL;
            build->high[i][k] = -HUGE_VAL;
        }
    }
}

enum status model_build_count(struct model_build *build, enum model_role role,
                              uint64_t vertex_count, uint64_t index_count)
{
    build->vertex_count[role] += vertex_count;
    build->index_count[role] += index_count;
    if (build->vertex_count[role] <= MODEL_ELEMENT_MAX &&
        build->index_count[role] <= MODEL_ELEMENT_MAX)
        return STATUS_OK;
    log_error("%s: expected at most %d vertices", build->import->path, MODEL_ELEMENT_MAX);
    return STATUS_DATA;
}

/* Maximum distance of a model from the origin of its file, in diagonals of its bounding box. Beyond
 * it, single precision would be too coarse for the model, so its coordinates are made relative. */
static const double far_ratio = 64;

/* Returns the diagonal of a box of doubles, and its largest absolute coordinate. */
static double measure_box(const double low[static 3], const double high[static 3], double *reach)
{
    double sum = 0;
    *reach = 0;
    for (int k = 0; k < 3; k++) {
        sum += (high[k] - low[k]) * (high[k] - low[k]);
        *reach = fmax(*reach, fmax(fabs(low[k]), fabs(high[k])));
    }
    return sqrt(sum);
}

/* Chooses the origin: near the objects' centre (without any, the surroundings') if that is far from
 * the file's origin. The origin is a multiple of a power of two above the size of the model, so
 * that a model which is moved by round numbers keeps its relative coordinates. */
static void choose_origin(struct model_build *build)
{
    const int role = build->index_count[MODEL_OBJECT] > 0 ? MODEL_OBJECT : MODEL_SURROUNDINGS;
    const double *low = build->low[role], *high = build->high[role];
    double *origin = build->model->origin, reach;
    const double diagonal = measure_box(low, high, &reach);
    if (build->import->origin) {
        memcpy(origin, build->import->origin, sizeof(build->model->origin));
        return;
    }
    if (!(low[0] <= high[0]) || !(reach > far_ratio * diagonal) || !isfinite(reach))
        return;
    const double step = exp2(ceil(log2(fmax(diagonal, 1e-6 * reach))));
    for (int k = 0; k < 3; k++) {
        const double middle = 0.5 * low[k] + 0.5 * high[k];
        origin[k] = fmax(-MODEL_ORIGIN_MAX, fmin(round(middle / step) * step, MODEL_ORIGIN_MAX));
    }
}

enum status model_build_allocate(struct model_build *build)
{
    uint64_t index_count = 0;
    choose_origin(build);
    for (int i = 0; i < MODEL_ROLE_COUNT; i++) {
        index_count += build->index_count[i];
        if (!mesh_init(build->meshes[i], (uint32_t)build->vertex_count[i],
                       (uint32_t)build->index_count[i]))
            return log_out_of_memory(build->import->path);
        if (build->has_extras[i] && !mesh_add_extras(build->meshes[i]))
            return log_out_of_memory(build->import->path);
        build->vertex_count[i] = 0;
        build->index_count[i] = 0;
    }
    if (index_count > 0)
        return STATUS_OK;
    log_error("%s: expected a model with triangles, got none; export its faces",
              build->import->path);
    return STATUS_DATA;
}

/* Returns the matrix that transforms normals: the cofactor matrix. It is the inverse transpose up
 * to scale, but also exists for a singular matrix. */
static mat3s normal_matrix(mat3s m, bool is_mirrored)
{
    mat3s normal = { .col = {
                         glms_vec3_cross(m.col[1], m.col[2]),
                         glms_vec3_cross(m.col[2], m.col[0]),
                         glms_vec3_cross(m.col[0], m.col[1]),
                     } };
    return glms_mat3_scale(normal, is_mirrored ? -1.0F : 1.0F);
}

static vec3s vec3_at(const float *numbers, size_t i)
{
    return (vec3s){ { numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2] } };
}

/* Fills in a vertex, and counts clamped colours. Returns false if the position is out of range. */
static bool fill_vertex(struct mesh_vertex *vertex, const struct model_shape *shape,
                        const struct affine *model_from_shape, const mat3s *normal_from_shape,
                        size_t i, uint32_t *clamped)
{
    double position[3];
    for (size_t k = 0; k < 3; k++)
        position[k] = (double)shape->positions[3 * i + k];
    affine_transform(model_from_shape, position);
    for (int k = 0; k < 3; k++) {
        if (!(fabs(position[k]) <= MODEL_COORDINATE_MAX))
            return false;
        vertex->position.raw[k] = (float)position[k] + 0.0F; /* makes -0 bitwise equal to 0 */
    }
    if (shape->normals) {
        vec3s normal = glms_mat3_mulv(*normal_from_shape, vec3_at(shape->normals, i));
        float length = glms_vec3_norm(normal);
        if (length > 0 && isfinite(length))
            vertex->normal = glms_vec3_divs(normal, length);
    }
    vertex->color = shape->color;
    if (shape->colors) {
        const float *color = &shape->colors[4 * i];
        vertex->color = glms_vec3_mul(shape->color, (vec3s){ { color[0], color[1], color[2] } });
        *clamped += model_color_clamp(&vertex->color, shape->material & MESH_UNLIT);
    }
    if (shape->uvs) {
        const float *uv = &shape->uvs[shape->uv_stride * i];
        vertex->uv = (vec2s){ { uv[0], shape->is_flipped ? 1 - uv[1] : uv[1] } };
    }
    vertex->material = shape->material;
    return true;
}

/* Sets the tangent and the second texture coordinates. A mirroring transform flips the bitangent.
 * Tangents of length 0 are ignored. */
static void fill_extra(struct mesh_extra *extra, const struct model_shape *shape,
                       const mat3s *linear, bool is_mirrored, size_t i)
{
    if (shape->other_uvs)
        extra->uv = (vec2s){ { shape->other_uvs[2 * i], shape->other_uvs[2 * i + 1] } };
    if (!shape->tangents)
        return;
    const float *t = &shape->tangents[4 * i];
    const vec3s tangent = glms_mat3_mulv(*linear, (vec3s){ { t[0], t[1], t[2] } });
    const float length = glms_vec3_norm(tangent);
    if (!(length > 0 && isfinite(length)))
        return;
    extra->tangent = glms_vec3_divs(tangent, length);
    extra->side = (t[3] < 0) == is_mirrored ? 1 : -1;
}

/* Counts degenerate triangles of a shape whose own vertices are so far from its origin that single
 * precision may have rounded different vertices to the same position. */
static void count_collapsed(struct model_import *import, const struct model_shape *shape)
{
    double low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    double reach;
    extend_by_positions(low, high, shape->positions, shape->vertex_count);
    const double diagonal = measure_box(low, high, &reach);
    if (!(reach > far_ratio * diagonal))
        return;
    for (uint32_t i = 0; i < shape->index_count; i += 3) {
        for (uint32_t k = 0; k < 3; k++) {
            const vec3s a = vec3_at(shape->positions, shape->indices[i + k]);
            const vec3s b = vec3_at(shape->positions, shape->indices[i + (k + 1) % 3]);
            if (glms_vec3_eqv(a, b)) {
                import->collapsed_triangles++;
                break;
            }
        }
    }
}

enum status model_build_add(struct model_build *build, enum model_role role,
                            const struct model_shape *shape, const struct affine *model_from_shape)
{
    static const double no_origin[3];
    struct mesh *mesh = build->meshes[role];
    const mat3s linear = glms_mat4_pick3(affine_to_mat4(model_from_shape, no_origin));
    const bool is_mirrored = glms_mat3_det(linear) < 0;
    const mat3s normal_from_shape = normal_matrix(linear, is_mirrored);
    const uint32_t base = (uint32_t)build->vertex_count[role];
    uint32_t *indices = &mesh->indices[build->index_count[role]];
    if (role == MODEL_SURROUNDINGS && build->surroundings_name) {
        if (!model_surroundings_add_object(build->model, build->surroundings_name, base))
            return log_out_of_memory(build->import->path);
        build->surroundings_name = NULL;
    }
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        if (!fill_vertex(&mesh->vertices[base + i], shape, model_from_shape, &normal_from_shape, i,
                         &build->import->clamped_vertices))
            return bad_vertex(build->import, shape, i,
                              "the position is beyond 1000000 units from the scene's centre");
        if (mesh->extras)
            fill_extra(&mesh->extras[base + i], shape, &linear, is_mirrored, i);
    }
    for (uint32_t i = 0; i < shape->index_count; i += 3) {
        indices[i] = base + shape->indices[i];
        indices[i + 1] = base + shape->indices[i + (is_mirrored ? 2 : 1)];
        indices[i + 2] = base + shape->indices[i + (is_mirrored ? 1 : 2)];
    }
    count_collapsed(build->import, shape);
    build->vertex_count[role] += shape->vertex_count;
    build->index_count[role] += shape->index_count;
    return STATUS_OK;
}

enum status model_build_add_object(struct model_build *build, const struct object *object,
                                   const struct model_build_object *params)
{
    struct model *model = build->model;
    if (model->object_count == build->object_capacity) {
        const size_t capacity = 2 * (size_t)build->object_capacity + 16;
        struct object *objects = realloc(model->objects, capacity * sizeof(*objects));
        if (objects)
            model->objects = objects;
        struct model_build_object *added = realloc(build->objects, capacity * sizeof(*added));
        if (added)
            build->objects = added;
        if (!objects || !added)
            return log_out_of_memory(build->import->path);
        build->object_capacity = (uint32_t)capacity;
    }
    struct object *to = &model->objects[model->object_count];
    *to = *object;
    to->first_index = (uint32_t)build->index_count[MODEL_OBJECT];
    build->objects[model->object_count] = *params;
    build->objects[model->object_count++].first_vertex =
        (uint32_t)build->vertex_count[MODEL_OBJECT];
    return STATUS_OK;
}

enum status model_build_default_object(struct model_build *build)
{
    struct model *model = build->model;
    if (model->object.index_count == 0)
        return STATUS_OK;
    struct material *grown =
        realloc(model->materials, (model->material_count + (size_t)1) * sizeof(*grown));
    if (grown)
        model->materials = grown;
    model->objects = calloc(1, sizeof(*model->objects));
    build->objects = calloc(1, sizeof(*build->objects));
    if (!grown || !model->objects || !build->objects)
        return log_out_of_memory(build->import->path);
    struct material *bare = &grown[model->material_count];
    *bare = material_make("ice");
    bare->flags = MATERIAL_FROM_SETTINGS;
    bare->transmission = 1;
    bare->roughness = 0;
    model->objects[0].index_count = model->object.index_count;
    model->objects[0].material = model->material_count++;
    model->object_count = 1;
    build->objects[0].vertex_count = model->object.vertex_count;
    return STATUS_OK;
}

enum status model_build_end(struct model_build *build)
{
    struct model *model = build->model;
    if (!model_drop_doubled_faces(model, &build->import->doubled_triangles))
        return log_out_of_memory(build->import->path);
    const enum status status = model_build_close_objects(build);
    if (status != STATUS_OK)
        return status;
    if (!model_weld_vertices(&model->object, NULL, 0) ||
        !model_weld_vertices(&model->surroundings, model->surroundings_starts,
                             model->surroundings_object_count))
        return log_out_of_memory(build->import->path);
    return STATUS_OK;
}

void model_build_finish(struct model_build *build)
{
    free(build->objects);
    build->objects = NULL;
}

bool model_color_clamp(vec3s *color, bool is_unlit)
{
    const float max = is_unlit ? (float)MODEL_RADIANCE_MAX : 1;
    bool is_clamped = false;
    for (int k = 0; k < 3; k++) {
        const float value = color->raw[k];
        if (!isfinite(value) || (value >= 0 && value <= max))
            continue;
        color->raw[k] = value > max ? max : 0;
        is_clamped = true;
    }
    return is_clamped;
}

void model_build_warn(const struct model_import *import)
{
    const struct shell_counts *shells = &import->shells;
    if (import->doubled_triangles > 0)
        log_note("%s: faces of refractive objects that occur again with the opposite winding, and "
                 "were left out: %u",
                 import->path, import->doubled_triangles);
    if (shells->shared > 0)
        log_note("%s: faces inside refractive objects, where two shells touch, that were left out: "
                 "%u",
                 import->path, shells->shared);
    if (shells->flipped > 0)
        log_note("%s: shells that are wound inside out, and were flipped: %u", import->path,
                 shells->flipped);
    if (shells->unified > 0)
        log_note("%s: shells that are wound inconsistently, and were turned outwards: %u",
                 import->path, shells->unified);
    if (import->collapsed_triangles > 0)
        log_warning("%s: %u triangles have collapsed, because their vertices are too far from the "
                    "origin for the precision of the file; move the geometry to its origin, and "
                    "place it by the transform of its node",
                    import->path, import->collapsed_triangles);
    if (import->clamped_materials > 0 || import->clamped_vertices > 0)
        log_warning(
            "%s: colours outside the range 0 to 1 (unlit vertices: 0 to %d) were clamped in %u "
            "materials and %u vertices",
            import->path, MODEL_RADIANCE_MAX, import->clamped_materials, import->clamped_vertices);
}
