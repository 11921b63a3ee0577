/* model_material.c: the materials that assimp has read. */
#include <assimp/material.h>
#include <cglm/struct.h>
#include <math.h>
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

static float read_number(const struct aiMaterial *source, const char *key, float fallback)
{
    float number = fallback;
    (void)aiGetMaterialFloat(source, key, 0, 0, &number);
    return number;
}

/* Whether the illumination model of a .mtl file refracts: glass, Fresnel and refraction. */
static bool is_glass(const struct aiMaterial *source)
{
    int model = 0;
    (void)aiGetMaterialInteger(source, "$mat.illum", 0, 0, &model);
    return model == 4 || model == 6 || model == 7 || model == 9;
}

/*
 * Translates Kd, Ns, d, Tf, Ni and illum. A material is transmissive that has a refracting illum, a
 * d below 1, or a Tf with a Ni: what d leaves passes, or all of it, tinted by Tf. Without a Ni
 * above 1 it is a thin wall. Without Ns it is smooth.
 */
static struct material translate(const struct aiMaterial *source, vec3s color)
{
    struct aiString name = { 0 };
    struct aiColor4D filter = { 1, 1, 1, 1 };
    (void)aiGetMaterialString(source, "?mat.name", 0, 0, &name);
    (void)aiGetMaterialColor(source, "$clr.transparent", 0, 0, &filter);
    struct material material = material_make(name.data);
    const float opacity = read_number(source, "$mat.opacity", 1);
    const float index = read_number(source, "$mat.refracti", 1);
    const float exponent = fmaxf(read_number(source, "$mat.shininess", 0), 0);
    const bool is_filter = filter.r < 1 || filter.g < 1 || filter.b < 1;
    material.base_color = color;
    material.roughness = powf(2 / (exponent + 2), 0.25F); /* the width is its square */
    if (!(is_glass(source) || opacity < 1 || (is_filter && index > 1)))
        return material;
    material.base_color = (vec3s){ { filter.r, filter.g, filter.b } };
    material.transmission = opacity < 1 ? 1 - opacity : 1;
    material.roughness = exponent > 0 ? material.roughness : 0;
    material.thickness = index > 1 ? 1 : 0;
    material.ior = index > 1 ? index : material.ior;
    material.flags |= index > 1 ? MATERIAL_HAS_IOR : 0u;
    (void)material_clamp(&material);
    (void)model_color_clamp(&material.base_color, false);
    return material;
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
        material->material =
            material->is_made_up ? material_make("") : translate(source, material->color);
        assimp->import->clamped_materials += model_color_clamp(&material->color, false);
        struct aiString name;
        material->is_textured = model_material_texture(source, &name, &material->uv_index);
        if (!material->is_textured)
            material->uv_index = 0;
    }
    return true;
}
