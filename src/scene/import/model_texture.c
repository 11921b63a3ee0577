/* model_texture.c: the base colour textures that a file of assimp names. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_assimp.h"

/* Appends the material's texture to the list unless it is there, and sets the material's layer. */
static enum status add(const struct model_assimp *assimp, uint32_t material_index,
                       struct model_picture *pictures, uint32_t *count)
{
    const char *path = assimp->import->path;
    struct aiString name = { 0 };
    uint32_t uv_index;
    model_material_texture(assimp->scene->mMaterials[material_index], &name, &uv_index);
    if (!model_file_clean(name.data, false)) {
        log_error("%s: texture %s: expected a file within the model's folder", path, name.data);
        return STATUS_DATA;
    }
    char *file = model_file_join(path, name.data);
    if (!file)
        return log_out_of_memory(path);
    uint32_t layer = 0;
    while (layer < *count && strcmp(file, pictures[layer].file) != 0)
        layer++;
    if (layer == MODEL_TEXTURE_MAX) {
        log_error("%s: expected at most %d textures", path, MODEL_TEXTURE_MAX);
        free(file);
        return STATUS_DATA;
    }
    if (layer < *count)
        free(file);
    else
        pictures[(*count)++] = (struct model_picture){ .name = file, .file = file };
    assimp->materials[material_index].layer = layer + 1;
    return STATUS_OK;
}

enum status model_texture_load(struct model_assimp *assimp, struct texture_layers *layers)
{
    uint32_t count = 0;
    struct model_picture *pictures = calloc(MODEL_TEXTURE_MAX, sizeof(*pictures));
    if (!pictures)
        return log_out_of_memory(assimp->import->path);
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < assimp->scene->mNumMeshes && status == STATUS_OK; i++) {
        const struct aiMesh *mesh = assimp->scene->mMeshes[i];
        const struct model_material *material = &assimp->materials[mesh->mMaterialIndex];
        if (material->is_textured && material->layer == 0 &&
            mesh->mTextureCoords[material->uv_index])
            status = add(assimp, mesh->mMaterialIndex, pictures, &count);
    }
    if (status == STATUS_OK)
        status = model_picture_load(assimp->import->path, pictures, count, false, layers);
    for (uint32_t i = 0; i < count; i++)
        free(pictures[i].file);
    free(pictures);
    return status;
}
