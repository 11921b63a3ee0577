/* model_material.c: the materials that assimp has read. */
#include <assimp/material.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/model_assimp.h"

static bool is_made_up(const struct aiMaterial *source)
{
    struct aiString name = { 0 };
    return aiGetMaterialString(source, "?mat.name", 0, 0, &name) != aiReturn_SUCCESS ||
           strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0;
}

static vec3s read_color(const struct aiMaterial *source)
{
    struct aiColor4D color = { 1, 1, 1, 1 };
    if (aiGetMaterialColor(source, AI_MATKEY_BASE_COLOR, &color) != aiReturn_SUCCESS)
        aiGetMaterialColor(source, AI_MATKEY_COLOR_DIFFUSE, &color);
    return (vec3s){ { color.r, color.g, color.b } };
}

bool model_material_texture(const struct aiMaterial *material, struct aiString *name,
                            uint32_t *uv_index)
{
    *uv_index = 0;
    if (aiGetMaterialTexture(material, aiTextureType_BASE_COLOR, 0, name, NULL, uv_index, NULL,
                             NULL, NULL, NULL) != aiReturn_SUCCESS &&
        aiGetMaterialTexture(material, aiTextureType_DIFFUSE, 0, name, NULL, uv_index, NULL, NULL,
                             NULL, NULL) != aiReturn_SUCCESS)
        return false;
    return *uv_index < AI_MAX_NUMBER_OF_TEXTURECOORDS;
}

bool model_material_read(struct model_assimp *assimp)
{
    uint32_t count = assimp->scene->mNumMaterials;
    assimp->materials = calloc(count > 0 ? count : 1, sizeof(*assimp->materials));
    if (!assimp->materials)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        const struct aiMaterial *source = assimp->scene->mMaterials[i];
        struct model_material *material = &assimp->materials[i];
        material->is_made_up = is_made_up(source);
        material->color = material->is_made_up ? glms_vec3_one() : read_color(source);
        assimp->import->clamped_materials += model_color_clamp(&material->color, false);
        struct aiString name;
        material->is_textured = model_material_texture(source, &name, &material->uv_index);
        if (!material->is_textured)
            material->uv_index = 0;
    }
    return true;
}
