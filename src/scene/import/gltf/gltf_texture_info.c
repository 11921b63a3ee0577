/* gltf_texture_info.c: reads glTF texture references: samplers, UV sets, transforms. */
#include <math.h>
#include "src/scene/import/gltf/gltf.h"
#include "src/scene/import/model_avif.h"

/* JSON location of a texture reference, in a material or in an object within it. */
struct slot {
    const char *group; /* "" for the material itself */
    const char *key;
};

static const struct slot slots[MATERIAL_TEXTURE_COUNT] = {
    [MATERIAL_BASE_COLOR] = { "pbrMetallicRoughness", "baseColorTexture" },
    [MATERIAL_METALLIC_ROUGHNESS] = { "pbrMetallicRoughness", "metallicRoughnessTexture" },
    [MATERIAL_NORMAL] = { "", "normalTexture" },
    [MATERIAL_OCCLUSION] = { "", "occlusionTexture" },
    [MATERIAL_EMISSION] = { "", "emissiveTexture" },
    [MATERIAL_TRANSMISSION] = { "KHR_materials_transmission", "transmissionTexture" },
    [MATERIAL_THICKNESS] = { "KHR_materials_volume", "thicknessTexture" },
    [MATERIAL_SPECULAR] = { "KHR_materials_specular", "specularTexture" },
    [MATERIAL_SPECULAR_COLOR] = { "KHR_materials_specular", "specularColorTexture" },
    [MATERIAL_COAT] = { "KHR_materials_clearcoat", "clearcoatTexture" },
    [MATERIAL_COAT_ROUGHNESS] = { "KHR_materials_clearcoat", "clearcoatRoughnessTexture" },
};

/* Reads KHR_texture_transform as an affine transform: scale, then rotate, then translate. */
static void read_transform(const struct gltf_object *info, struct gltf_texture *texture)
{
    const struct gltf_object transform = gltf_extension(info, "KHR_texture_transform");
    float offset[2] = { 0 };
    float scale[2] = { 1, 1 };
    (void)gltf_floats(&transform, "offset", offset, 2);
    (void)gltf_floats(&transform, "scale", scale, 2);
    const float angle = gltf_number(&transform, "rotation", 0);
    const float c = cosf(angle);
    const float s = sinf(angle);
    texture->rows[0] = (vec3s){ { c * scale[0], s * scale[1], offset[0] } };
    texture->rows[1] = (vec3s){ { -s * scale[0], c * scale[1], offset[1] } };
    texture->uv_set = (uint32_t)gltf_count(&transform, "texCoord", gltf_count(info, "texCoord", 0));
}

static uint32_t read_wrap(const struct gltf_object *sampler, const char *key)
{
    static const uint32_t wraps[MATERIAL_WRAP_COUNT] = {
        [MATERIAL_REPEAT] = 10497,
        [MATERIAL_MIRROR] = 33648,
        [MATERIAL_CLAMP] = 33071,
    };
    const uint64_t value = gltf_count(sampler, key, wraps[MATERIAL_REPEAT]);
    for (uint32_t i = 0; i < MATERIAL_WRAP_COUNT; i++) {
        if (wraps[i] == value)
            return i;
    }
    (void)gltf_fault(sampler, "%s: expected 10497, 33648 or 33071", key);
    return MATERIAL_REPEAT;
}

/* Reads a sampler's wrap modes. Records NEAREST as undrawn, since filtering is always linear. */
static void read_sampler(const struct gltf_object *sampler, struct gltf_texture *texture)
{
    const uint64_t nearest = 9728;
    texture->wrap_u = read_wrap(sampler, "wrapS");
    texture->wrap_v = read_wrap(sampler, "wrapT");
    if (gltf_count(sampler, "magFilter", 0) == nearest)
        sampler->gltf->undrawn |= 1u << GLTF_NEAREST_FILTER;
}

static void read_texture(const struct gltf_object *info, struct gltf_texture *texture)
{
    struct gltf *gltf = info->gltf;
    const uint32_t index = gltf_index(info, "index", "textures");
    texture->image = gltf_none;
    if (!info->json)
        return;
    if (index == gltf_none) {
        (void)gltf_fault(info, "index: expected a texture");
        return;
    }
    const struct gltf_object object = gltf_element(gltf, "textures", index);
    const struct gltf_object webp = gltf_extension(&object, "EXT_texture_webp");
    const uint32_t sampler = gltf_index(&object, "sampler", "samplers");
    const struct gltf_object avif = gltf_extension(&object, "EXT_texture_avif");
    texture->image = model_avif_is_built() ? gltf_index(&avif, "source", "images") : gltf_none;
    if (texture->image == gltf_none)
        texture->image = gltf_index(&webp, "source", "images");
    if (texture->image == gltf_none)
        texture->image = gltf_index(&object, "source", "images");
    if (sampler != gltf_none) {
        const struct gltf_object sampler_object = gltf_element(gltf, "samplers", sampler);
        read_sampler(&sampler_object, texture);
    }
    if (texture->image == gltf_none && gltf->status == STATUS_OK)
        gltf->undrawn |= 1u << GLTF_NO_IMAGE;
    read_transform(info, texture);
}

/* Makes a texture use the second UV set. Returns false if other coordinates occupy that set. */
static bool use_second_uv_set(struct gltf_material *material, const struct gltf_texture *texture,
                              struct material_texture *out)
{
    if (material->other_uv_set == gltf_none)
        material->other_uv_set = texture->uv_set;
    out->uv_set = 1;
    out->u_row = texture->rows[0];
    out->v_row = texture->rows[1];
    return material->other_uv_set == texture->uv_set;
}

/* Computes the transform from the vertices' texture coordinates to a texture's coordinates. If the
 * material needs a third UV set, returns false. */
static bool compute_transform(struct gltf_material *material, const struct gltf_texture *texture,
                              struct material_texture *out)
{
    const vec3s *from = material->uv_rows;
    const float det = from[0].x * from[1].y - from[0].y * from[1].x;
    if (texture->uv_set != material->uv_set || !(fabsf(det) > 1e-12F))
        return use_second_uv_set(material, texture, out);
    vec3s *to[2] = { &out->u_row, &out->v_row };
    for (int i = 0; i < 2; i++) {
        const vec3s row = texture->rows[i];
        to[i]->x = (row.x * from[1].y - row.y * from[1].x) / det;
        to[i]->y = (row.y * from[0].x - row.x * from[0].y) / det;
        to[i]->z = row.z - to[i]->x * from[0].z - to[i]->y * from[1].z;
    }
    return true;
}

void gltf_texture_info_read(const struct gltf_object *object, struct gltf_material *material)
{
    static const vec3s identity[2] = { { { 1, 0, 0 } }, { { 0, 1, 0 } } };
    struct gltf *gltf = object->gltf;
    material->uv_set = gltf_none;
    material->other_uv_set = gltf_none;
    for (int i = 0; i < MATERIAL_TEXTURE_COUNT; i++) {
        const struct slot *slot = &slots[i];
        const struct gltf_object group = !slot->group[0] ? *object
                                         : slot->group[0] == 'K'
                                             ? gltf_extension(object, slot->group)
                                             : gltf_member(object, slot->group);
        const struct gltf_object info = gltf_member(&group, slot->key);
        struct gltf_texture *texture = &material->textures[i];
        struct material_texture *out = &material->material.textures[i];
        gltf_attempt_begin(gltf, &gltf->import->textures);
        read_texture(&info, texture);
        if (!gltf_attempt_end(gltf))
            texture->image = gltf_none;
        if (texture->image == gltf_none)
            continue;
        if (material->uv_set == gltf_none) {
            material->uv_set = texture->uv_set;
            for (int k = 0; k < 2; k++)
                material->uv_rows[k] = i == MATERIAL_BASE_COLOR ? texture->rows[k] : identity[k];
        }
        out->wrap_u = texture->wrap_u;
        out->wrap_v = texture->wrap_v;
        if (i != MATERIAL_BASE_COLOR && !compute_transform(material, texture, out)) {
            gltf->undrawn |= 1u << GLTF_THIRD_UV_SET;
            texture->image = gltf_none;
        }
    }
}
