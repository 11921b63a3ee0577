/* model_mesh.c: the meshes that assimp has read. */
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"
#include "src/scene/import/model_assimp.h"

_Static_assert(sizeof(struct aiVector3D) == 3 * sizeof(float), "an array of them is one of floats");
_Static_assert(sizeof(struct aiColor4D) == 4 * sizeof(float), "an array of them is one of floats");

static enum status bad_mesh(const struct model_assimp *assimp, uint32_t index, const char *what)
{
    log_error("%s: mesh %u \"%s\": %s", assimp->import->path, index,
              assimp->scene->mMeshes[index]->mName.data, what);
    return STATUS_DATA;
}

/* Returns a mesh without its triangles. */
static struct model_shape shape_of(const struct model_assimp *assimp, uint32_t index,
                                   char name[static 64])
{
    const struct aiMesh *mesh = assimp->scene->mMeshes[index];
    const struct model_material *material = &assimp->materials[mesh->mMaterialIndex];
    const struct aiVector3D *uvs = mesh->mTextureCoords[material->uv_index];
    const bool is_bare = mesh->mColors[0] && !mesh->mNormals && material->is_made_up;
    (void)snprintf(name, 64, "mesh %u \"%.40s\"", index, mesh->mName.data);
    return (struct model_shape){
        .name = name,
        .positions = &mesh->mVertices[0].x,
        .normals = mesh->mNormals ? &mesh->mNormals[0].x : NULL,
        .colors = mesh->mColors[0] ? &mesh->mColors[0][0].r : NULL,
        .uvs = uvs ? &uvs[0].x : NULL,
        .uv_stride = 3,
        .is_flipped = true,
        .vertex_count = mesh->mNumVertices,
        .color = material->color,
        .material =
            (uvs ? material->layer : 0) | (is_bare && material->layer == 0 ? MESH_UNLIT : 0u),
    };
}

static enum status check_mesh(const struct model_assimp *assimp, uint32_t index)
{
    const struct aiMesh *mesh = assimp->scene->mMeshes[index];
    char name[64];
    if (mesh->mMaterialIndex >= assimp->scene->mNumMaterials)
        return bad_mesh(assimp, index, "its material does not exist");
    const vec3s color = assimp->materials[mesh->mMaterialIndex].color;
    if (!isfinite(color.x) || !isfinite(color.y) || !isfinite(color.z))
        return bad_mesh(assimp, index, "the material's colour is not finite");
    if (mesh->mNumVertices > 0 && !mesh->mVertices)
        return bad_mesh(assimp, index, "its vertices have no positions");
    for (uint32_t i = 0; i < mesh->mNumFaces; i++) {
        for (uint32_t k = 0; k < mesh->mFaces[i].mNumIndices; k++) {
            if (mesh->mFaces[i].mIndices[k] >= mesh->mNumVertices)
                return bad_mesh(assimp, index,
                                "a face has the index of a vertex that does not exist");
        }
    }
    const struct model_shape shape = shape_of(assimp, index, name);
    return model_shape_check(assimp->import, &shape);
}

enum status model_mesh_check(const struct model_assimp *assimp)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; status == STATUS_OK && i < assimp->scene->mNumMeshes; i++)
        status = check_mesh(assimp, i);
    return status;
}

static uint32_t triangle_count(const struct aiMesh *mesh)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->mNumFaces; i++)
        count += mesh->mFaces[i].mNumIndices == 3;
    return count;
}

/* Whether a material is transmissive: then such meshes are the objects. */
static bool has_transmission(const struct model_assimp *assimp)
{
    for (uint32_t i = 0; i < assimp->scene->mNumMeshes; i++) {
        const struct aiMesh *mesh = assimp->scene->mMeshes[i];
        if (triangle_count(mesh) > 0 &&
            assimp->materials[mesh->mMaterialIndex].material.transmission > 0)
            return true;
    }
    return false;
}

/* Returns whether the file gives any mesh a material. */
static bool has_materials(const struct model_assimp *assimp)
{
    for (uint32_t i = 0; i < assimp->scene->mNumMeshes; i++) {
        const struct aiMesh *mesh = assimp->scene->mMeshes[i];
        if (triangle_count(mesh) > 0 && !assimp->materials[mesh->mMaterialIndex].is_made_up)
            return true;
    }
    return false;
}

/* Lists an object whose triangles begin where the part ends. */
static enum status add_object(struct model_build *build, const struct model_assimp *assimp,
                              const struct aiMesh *mesh)
{
    struct model *model = build->model;
    struct object *grown =
        realloc(model->objects, (model->object_count + (size_t)1) * sizeof(*grown));
    if (!grown)
        return log_out_of_memory(assimp->import->path);
    model->objects = grown;
    struct object *object = &grown[model->object_count++];
    *object = (struct object){
        .first_index = (uint32_t)build->index_count[MODEL_OBJECT],
        .index_count = 3 * triangle_count(mesh),
        .material = mesh->mMaterialIndex,
    };
    (void)snprintf(object->name, sizeof(object->name), "%.*s", MATERIAL_NAME_SIZE - 1,
                   mesh->mName.data);
    model->has_ior = true;
    if (model->object_count == 1)
        model->ior = assimp->materials[mesh->mMaterialIndex].material.ior;
    return STATUS_OK;
}

static enum status list_materials(const struct model_assimp *assimp, struct model *model)
{
    const uint32_t count = assimp->scene->mNumMaterials;
    if (count > MESH_SURFACE_MAX) {
        log_error("%s: expected at most %u materials, got %u", assimp->import->path,
                  MESH_SURFACE_MAX, count);
        return STATUS_DATA;
    }
    model->materials = calloc(count + (size_t)1, sizeof(*model->materials));
    if (!model->materials)
        return log_out_of_memory(assimp->import->path);
    model->material_count = count;
    for (uint32_t i = 0; i < count; i++)
        model->materials[i] = assimp->materials[i].material;
    return STATUS_OK;
}

/* Adds an instance of a mesh. */
static enum status add(struct model_build *build, enum model_part part, bool is_split,
                       const struct model_assimp *assimp, uint32_t index, mat4s model_from_mesh)
{
    const struct aiMesh *mesh = assimp->scene->mMeshes[index];
    char name[64];
    struct model_shape shape = shape_of(assimp, index, name);
    uint32_t *indices = malloc(3 * sizeof(*indices) * (triangle_count(mesh) + (size_t)1));
    if (!indices)
        return log_out_of_memory(assimp->import->path);
    for (uint32_t i = 0; i < mesh->mNumFaces; i++) {
        for (uint32_t k = 0; mesh->mFaces[i].mNumIndices == 3 && k < 3; k++)
            indices[shape.index_count++] = mesh->mFaces[i].mIndices[k];
    }
    shape.indices = indices;
    enum status status = STATUS_OK;
    if (is_split)
        shape.material |= (mesh->mMaterialIndex + 1) << MESH_SURFACE_SHIFT;
    if (is_split && part == MODEL_OBJECT)
        status = add_object(build, assimp, mesh);
    if (status == STATUS_OK)
        status = model_build_add(build, part, &shape, model_from_mesh);
    free(indices);
    return status;
}

/* Counts the instances of meshes with triangles, or adds them. */
static enum status walk(struct model_build *build, enum model_part everything_is, bool is_split,
                        const struct model_assimp *assimp, bool is_counting)
{
    for (uint32_t i = 0; i < assimp->node_count; i++) {
        const struct model_node *node = &assimp->nodes[i];
        for (uint32_t k = 0; k < node->node->mNumMeshes; k++) {
            const uint32_t index = node->node->mMeshes[k];
            const struct aiMesh *mesh = assimp->scene->mMeshes[index];
            const uint32_t triangles = triangle_count(mesh);
            const bool is_clear = assimp->materials[mesh->mMaterialIndex].material.transmission > 0;
            const enum model_part part = !is_split  ? everything_is
                                         : is_clear ? MODEL_OBJECT
                                                    : MODEL_SURROUNDINGS;
            enum status status = STATUS_OK;
            if (triangles > 0 && is_counting)
                status =
                    model_build_count(build, part, mesh->mNumVertices, 3 * (uint64_t)triangles);
            else if (triangles > 0)
                status = add(build, part, is_split, assimp, index, node->model_from_node);
            if (status != STATUS_OK)
                return status;
        }
    }
    return STATUS_OK;
}

enum status model_mesh_build(const struct model_assimp *assimp, struct model *model,
                             enum model_part everything_is)
{
    struct model_build build;
    model_build_init(&build, assimp->import, model);
    const bool by_materials = everything_is == MODEL_BY_MATERIALS;
    const bool is_split = has_transmission(assimp) || (by_materials && has_materials(assimp));
    const enum model_part part = by_materials ? MODEL_OBJECT : everything_is;
    enum status status = walk(&build, part, is_split, assimp, true);
    if (status == STATUS_OK)
        status = model_build_allocate(&build);
    if (status == STATUS_OK)
        status = walk(&build, part, is_split, assimp, false);
    if (status == STATUS_OK)
        status = is_split ? list_materials(assimp, model) : model_build_bare_object(&build);
    return status == STATUS_OK ? model_build_end(&build) : status;
}
