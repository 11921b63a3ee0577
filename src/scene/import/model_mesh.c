/* model_mesh.c: merges the meshes of a model file, one instance for each node. */
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"
#include "src/scene/import/model_import.h"

enum {
    PART_COUNT = 2, /* enum model_part */
};

/* A mesh that is being filled. */
struct part {
    struct mesh *mesh;
    uint64_t vertex_count, index_count; /* so far */
    uint32_t clamped_count;             /* vertices whose colour was clamped */
};

struct build {
    const struct model_import *import;
    struct model *model;
    struct part parts[PART_COUNT];
    enum model_part everything_is;
    bool is_split; /* transmission decides the part of each mesh */
};

/* An instance of a mesh of the file in a part. */
struct placement {
    const struct aiMesh *source;
    mat4s model_from_mesh;
    mat3s normal_from_mesh;
    vec3s color;
    uint32_t material;
    uint32_t uv_index;
    bool is_mirrored;
};

static enum status bad_vertex(const struct model_import *import, uint32_t mesh, uint32_t vertex,
                              const char *what)
{
    log_error("%s: mesh %u \"%s\": vertex %u: %s", import->path, mesh,
              import->scene->mMeshes[mesh]->mName.data, vertex, what);
    return STATUS_DATA;
}

static bool is_finite(struct aiVector3D v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static const struct model_material *material_of(const struct model_import *import,
                                                const struct aiMesh *mesh)
{
    return &import->materials[mesh->mMaterialIndex];
}

static enum status check_vertices(const struct model_import *import, uint32_t index)
{
    const struct aiMesh *mesh = import->scene->mMeshes[index];
    const struct aiVector3D *uvs =
        mesh->mTextureCoords[import->materials[mesh->mMaterialIndex].uv_index];
    const struct aiColor4D *colors = mesh->mColors[0];
    for (uint32_t i = 0; i < mesh->mNumVertices; i++) {
        if (!is_finite(mesh->mVertices[i]))
            return bad_vertex(import, index, i, "the position is not finite");
        if (mesh->mNormals && !is_finite(mesh->mNormals[i]))
            return bad_vertex(import, index, i, "the normal is not finite");
        if (uvs && !(isfinite(uvs[i].x) && isfinite(uvs[i].y)))
            return bad_vertex(import, index, i, "the texture coordinates are not finite");
        if (colors && !(isfinite(colors[i].r) && isfinite(colors[i].g) && isfinite(colors[i].b)))
            return bad_vertex(import, index, i, "the colour is not finite");
    }
    return STATUS_OK;
}

enum status model_mesh_check(const struct model_import *import)
{
    for (uint32_t index = 0; index < import->scene->mNumMeshes; index++) {
        const struct aiMesh *mesh = import->scene->mMeshes[index];
        if (mesh->mMaterialIndex >= import->scene->mNumMaterials) {
            log_error("%s: mesh %u \"%s\": material %u does not exist", import->path, index,
                      mesh->mName.data, mesh->mMaterialIndex);
            return STATUS_DATA;
        }
        vec3s color = material_of(import, mesh)->color;
        if (!isfinite(color.x) || !isfinite(color.y) || !isfinite(color.z)) {
            log_error("%s: mesh %u \"%s\": the material's colour is not finite", import->path,
                      index, mesh->mName.data);
            return STATUS_DATA;
        }
        for (uint32_t i = 0; i < mesh->mNumFaces; i++) {
            for (uint32_t k = 0; k < mesh->mFaces[i].mNumIndices; k++) {
                if (mesh->mFaces[i].mIndices[k] < mesh->mNumVertices)
                    continue;
                return bad_vertex(import, index, mesh->mFaces[i].mIndices[k],
                                  "a face refers to it, but it does not exist");
            }
        }
        enum status status = check_vertices(import, index);
        if (status != STATUS_OK)
            return status;
    }
    return STATUS_OK;
}

static uint32_t triangle_count(const struct aiMesh *mesh)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->mNumFaces; i++)
        count += mesh->mFaces[i].mNumIndices == 3;
    return count;
}

static bool has_transmission(const struct model_import *import)
{
    for (uint32_t i = 0; i < import->scene->mNumMeshes; i++) {
        if (material_of(import, import->scene->mMeshes[i])->is_transmissive)
            return true;
    }
    return false;
}

static enum status read_ior(const struct model_import *import,
                            const struct model_material *material, struct model *model)
{
    if (model->has_ior)
        return STATUS_OK;
    if (material->ior == 0) {
        model->ior = material->material.ior;
        model->has_ior = material->is_transmissive;
        return STATUS_OK;
    }
    if (!(material->ior >= 1 && material->ior <= 4)) {
        log_error("%s: expected an index of refraction from 1 to 4, got %g", import->path,
                  (double)material->ior);
        return STATUS_DATA;
    }
    model->ior = material->ior;
    model->has_ior = true;
    return STATUS_OK;
}

/* Returns the transform of normals: the transposed inverse without its scale. It exists even where
 * a scale is 0. */
static mat3s normal_matrix(mat3s m, bool is_mirrored)
{
    mat3s normal = { .col = {
                         glms_vec3_cross(m.col[1], m.col[2]),
                         glms_vec3_cross(m.col[2], m.col[0]),
                         glms_vec3_cross(m.col[0], m.col[1]),
                     } };
    return glms_mat3_scale(normal, is_mirrored ? -1.0F : 1.0F);
}

static struct placement place(const struct model_import *import, const struct aiMesh *source,
                              mat4s model_from_mesh)
{
    const struct model_material *material = material_of(import, source);
    mat3s linear = glms_mat4_pick3(model_from_mesh);
    bool is_mirrored = glms_mat3_det(linear) < 0;
    bool is_bare = source->mColors[0] && !source->mNormals && !import->is_gltf &&
                   material->is_made_up && material->layer == 0;
    uint32_t texture = 0;
    if (material->layer > 0 && source->mTextureCoords[material->uv_index])
        texture = material->layer | (material->flags & MESH_CUTOUT);
    return (struct placement){
        .source = source,
        .model_from_mesh = model_from_mesh,
        .normal_from_mesh = normal_matrix(linear, is_mirrored),
        .color = material->color,
        .material = texture | (is_bare ? MESH_UNLIT : material->flags & MESH_UNLIT),
        .uv_index = material->uv_index,
        .is_mirrored = is_mirrored,
    };
}

static vec3s vec3_from(struct aiVector3D v)
{
    return (vec3s){ { v.x, v.y, v.z } };
}

/* Adds 1 to *clamped if it clamps the colour. Returns false if the position is too far away. */
static bool fill_vertex(struct mesh_vertex *vertex, const struct placement *place, uint32_t i,
                        uint32_t *clamped)
{
    const struct aiMesh *source = place->source;
    vec3s position = glms_mat4_mulv3(place->model_from_mesh, vec3_from(source->mVertices[i]), 1);
    for (int k = 0; k < 3; k++) {
        if (!(fabsf(position.raw[k]) <= (float)MODEL_COORDINATE_MAX))
            return false;
    }
    vertex->position = glms_vec3_adds(position, 0); /* turns -0 to 0, so that they compare equal */

    if (source->mNormals) {
        vec3s normal = glms_mat3_mulv(place->normal_from_mesh, vec3_from(source->mNormals[i]));
        float length = glms_vec3_norm(normal);
        if (length > 0 && isfinite(length))
            vertex->normal = glms_vec3_divs(normal, length);
    }
    vertex->color = place->color;
    if (source->mColors[0]) {
        struct aiColor4D color = source->mColors[0][i];
        vertex->color = glms_vec3_mul(place->color, (vec3s){ { color.r, color.g, color.b } });
        *clamped += model_color_clamp(&vertex->color, place->material & MESH_UNLIT);
    }
    const struct aiVector3D *uvs = source->mTextureCoords[place->uv_index];
    if (uvs) /* assimp's (0, 0) is the bottom left in every format */
        vertex->uv = (vec2s){ { uvs[i].x, 1 - uvs[i].y } };
    vertex->material = place->material;
    return true;
}

static enum status append(struct part *part, const struct model_import *import, uint32_t mesh_index,
                          const struct placement *place)
{
    const struct aiMesh *source = place->source;
    uint32_t base = (uint32_t)part->vertex_count;
    for (uint32_t i = 0; i < source->mNumVertices; i++) {
        if (!fill_vertex(&part->mesh->vertices[base + i], place, i, &part->clamped_count))
            return bad_vertex(import, mesh_index, i, "the position is beyond 1000000 units");
    }
    part->vertex_count += source->mNumVertices;
    for (uint32_t i = 0; i < source->mNumFaces; i++) {
        const struct aiFace *face = &source->mFaces[i];
        if (face->mNumIndices != 3)
            continue;
        uint32_t *indices = &part->mesh->indices[part->index_count];
        indices[0] = base + face->mIndices[0];
        indices[1] = base + face->mIndices[place->is_mirrored ? 2 : 1];
        indices[2] = base + face->mIndices[place->is_mirrored ? 1 : 2];
        part->index_count += 3;
    }
    return STATUS_OK;
}

static struct part *part_of(struct build *build, const struct aiMesh *mesh)
{
    if (!build->is_split)
        return &build->parts[build->everything_is];
    return &build->parts[material_of(build->import, mesh)->is_transmissive ? MODEL_OBJECT
                                                                           : MODEL_SURROUNDINGS];
}

static enum status count(struct build *build, struct model *model)
{
    const struct model_import *import = build->import;
    for (uint32_t i = 0; i < import->node_count; i++) {
        const struct aiNode *node = import->nodes[i].node;
        for (uint32_t k = 0; k < node->mNumMeshes; k++) {
            const struct aiMesh *mesh = import->scene->mMeshes[node->mMeshes[k]];
            uint32_t triangles = triangle_count(mesh);
            if (triangles == 0)
                continue;
            struct part *part = part_of(build, mesh);
            part->vertex_count += mesh->mNumVertices;
            part->index_count += 3 * (uint64_t)triangles;
            if (part->vertex_count > MODEL_ELEMENT_MAX || part->index_count > MODEL_ELEMENT_MAX) {
                log_error("%s: expected at most %d vertices", import->path, MODEL_ELEMENT_MAX);
                return STATUS_DATA;
            }
            if (part->mesh != &model->object)
                continue;
            enum status status = read_ior(import, material_of(import, mesh), model);
            if (status != STATUS_OK)
                return status;
        }
    }
    return STATUS_OK;
}

/* Adds the object of a node whose triangles begin where the part ends. */
static enum status add_object(struct build *build, const struct aiNode *node,
                              const struct aiMesh *mesh)
{
    struct model *model = build->model;
    const uint32_t first = (uint32_t)build->parts[MODEL_OBJECT].index_count;
    struct object *grown =
        realloc(model->objects, (model->object_count + (size_t)1) * sizeof(*grown));
    if (!grown)
        return log_out_of_memory(build->import->path);
    model->objects = grown;
    model->objects[model->object_count++] = (struct object){
        .first_index = first,
        .index_count = 3 * triangle_count(mesh),
        .material = mesh->mMaterialIndex,
    };
    snprintf(grown[model->object_count - 1].name, MATERIAL_NAME_SIZE, "%.*s",
             MATERIAL_NAME_SIZE - 1, node->mName.data);
    return STATUS_OK;
}

static enum status fill(struct build *build)
{
    const struct model_import *import = build->import;
    for (uint32_t i = 0; i < import->node_count; i++) {
        const struct model_node *node = &import->nodes[i];
        for (uint32_t k = 0; k < node->node->mNumMeshes; k++) {
            uint32_t index = node->node->mMeshes[k];
            const struct aiMesh *mesh = import->scene->mMeshes[index];
            if (triangle_count(mesh) == 0)
                continue;
            struct placement placement = place(import, mesh, node->model_from_node);
            struct part *part = part_of(build, mesh);
            enum status status = STATUS_OK;
            if (build->is_split && part == &build->parts[MODEL_OBJECT])
                status = add_object(build, node->node, mesh);
            if (status == STATUS_OK)
                status = append(part, import, index, &placement);
            if (status != STATUS_OK)
                return status;
        }
    }
    return STATUS_OK;
}

/* The materials of the objects: those of the file, or one for all that it calls an object. */
static enum status list_materials(struct build *build)
{
    const struct model_import *import = build->import;
    struct model *model = build->model;
    const uint32_t count =
        build->is_split ? import->scene->mNumMaterials : model->object.index_count > 0;
    if (!count)
        return STATUS_OK;
    model->materials = calloc(count, sizeof(*model->materials));
    if (!model->materials)
        return log_out_of_memory(import->path);
    model->material_count = count;
    for (uint32_t i = 0; build->is_split && i < count; i++)
        model->materials[i] = import->materials[i].material;
    if (build->is_split)
        return STATUS_OK;
    model->materials[0] = material_make("ice");
    model->materials[0].flags = MATERIAL_IS_BARE;
    model->materials[0].transmission = 1;
    model->materials[0].roughness = 0;
    model->objects = calloc(1, sizeof(*model->objects));
    if (!model->objects)
        return log_out_of_memory(import->path);
    model->objects[0].index_count = model->object.index_count;
    model->object_count = 1;
    return STATUS_OK;
}

enum status model_mesh_build(struct model_import *import, struct model *model,
                             enum model_part everything_is)
{
    struct build build = {
        .import = import,
        .model = model,
        .everything_is = everything_is,
        .is_split = has_transmission(import),
        .parts[MODEL_OBJECT].mesh = &model->object,
        .parts[MODEL_SURROUNDINGS].mesh = &model->surroundings,
    };
    enum status status = count(&build, model);
    if (status != STATUS_OK)
        return status;
    uint64_t index_count = 0;
    for (int i = 0; i < PART_COUNT; i++) {
        struct part *part = &build.parts[i];
        index_count += part->index_count;
        if (!mesh_init(part->mesh, (uint32_t)part->vertex_count, (uint32_t)part->index_count))
            return log_out_of_memory(import->path);
        part->vertex_count = 0;
        part->index_count = 0;
    }
    if (index_count == 0) {
        log_error("%s: expected a model with triangles, got none; export its faces", import->path);
        return STATUS_DATA;
    }
    status = fill(&build);
    if (status == STATUS_OK)
        status = list_materials(&build);
    if (status != STATUS_OK)
        return status;
    for (int i = 0; i < PART_COUNT; i++)
        import->clamped_vertices += build.parts[i].clamped_count;
    if (!model_join_vertices(&model->object) || !model_join_vertices(&model->surroundings))
        return log_out_of_memory(import->path);
    return STATUS_OK;
}
