/* model_material.c: reads the materials of a model file. */
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_import.h"

static bool read_float(const struct aiMaterial *source, const char *key, float *value)
{
    unsigned count = 1;
    return aiGetMaterialFloatArray(source, key, 0, 0, value, &count) == aiReturn_SUCCESS &&
           count == 1;
}

static bool is_string(const struct aiMaterial *source, const char *key, const char *text)
{
    struct aiString value = { 0 };
    return aiGetMaterialString(source, key, 0, 0, &value) == aiReturn_SUCCESS &&
           strcmp(value.data, text) == 0;
}

static bool is_made_up(const struct model_import *import, const struct aiMaterial *source)
{
    struct aiString name = { 0 };
    if (import->is_gltf)
        return false;
    if (aiGetMaterialString(source, "?mat.name", 0, 0, &name) != aiReturn_SUCCESS)
        return !import->is_gltf;
    return strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0;
}

static vec3s read_color(const struct aiMaterial *source)
{
    struct aiColor4D color = { 1, 1, 1, 1 };
    if (aiGetMaterialColor(source, AI_MATKEY_BASE_COLOR, &color) != aiReturn_SUCCESS)
        aiGetMaterialColor(source, AI_MATKEY_COLOR_DIFFUSE, &color);
    return (vec3s){ { color.r, color.g, color.b } };
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

void model_color_warn(const struct model_import *import)
{
    if (import->clamped_materials > 0 || import->clamped_vertices > 0)
        log_warning("%s: colours are clamped to 0 to 1, unlit vertex colours to 0 to %d: of %u "
                    "materials and %u vertices",
                    import->path, MODEL_RADIANCE_MAX, import->clamped_materials,
                    import->clamped_vertices);
}

/* What the extensions of transmission, volume and index say. */
static void read_medium(const struct aiMaterial *source, struct model_material *material,
                        float transmission)
{
    struct material *medium = &material->material;
    struct aiColor4D tint = { 1, 1, 1, 1 };
    struct aiString name = { 0 };
    aiGetMaterialString(source, "?mat.name", 0, 0, &name);
    *medium = material_make(name.data);
    medium->transmission = transmission;
    if (material->ior >= 1) {
        medium->ior = material->ior;
        medium->flags |= MATERIAL_HAS_IOR;
    }
    read_float(source, "$mat.roughnessFactor", &medium->roughness);
    read_float(source, "$mat.volume.thicknessFactor", &medium->thickness);
    read_float(source, "$mat.volume.attenuationDistance", &medium->attenuation_distance);
    aiGetMaterialColor(source, "$mat.volume.attenuationColor", 0, 0, &tint);
    medium->attenuation_color = (vec3s){ { tint.r, tint.g, tint.b } };
    medium->base_color = material->color;
    material_clamp(medium);
}

static void read_gltf(const struct aiMaterial *source, struct model_material *material)
{
    int shading = 0;
    unsigned count = 1;
    aiGetMaterialIntegerArray(source, AI_MATKEY_SHADING_MODEL, &shading, &count);
    if (shading == aiShadingMode_NoShading) /* KHR_materials_unlit */
        material->flags |= MESH_UNLIT;
    if (is_string(source, "$mat.gltf.alphaMode", "MASK"))
        material->flags |= MESH_CUTOUT;

    float transmission = 0;
    if (read_float(source, "$mat.transmission.factor", &transmission))
        material->is_transmissive = transmission > 0;
    /* Present only with KHR_materials_ior; without it, glTF's default of 1.5 is not used. */
    read_float(source, "$mat.refracti", &material->ior);
    read_medium(source, material, transmission);
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

bool model_material_read(struct model_import *import)
{
    uint32_t count = import->scene->mNumMaterials;
    import->materials = calloc(count > 0 ? count : 1, sizeof(*import->materials));
    if (!import->materials)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        const struct aiMaterial *source = import->scene->mMaterials[i];
        struct model_material *material = &import->materials[i];
        material->is_made_up = is_made_up(import, source);
        material->color = material->is_made_up ? glms_vec3_one() : read_color(source);
        import->clamped_materials += model_color_clamp(&material->color, false);
        struct aiString name;
        material->is_textured = model_material_texture(source, &name, &material->uv_index);
        if (!material->is_textured)
            material->uv_index = 0;
        if (import->is_gltf)
            read_gltf(source, material);
    }
    return true;
}
