/* gltf_material.c: the materials of a glTF file (glTF 2.0, 3.9, and KHR_materials_*). */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf.h"

static void note(struct gltf *gltf, enum gltf_undrawn what, bool is_there)
{
    gltf->undrawn |= is_there ? 1u << what : 0;
}

static bool has(const struct gltf_object *object, const char *key)
{
    return json_object_get(object->json, key);
}

/* KHR_texture_transform: (u, v) scaled, then turned, then moved. */
static void read_transform(const struct gltf_object *info, struct gltf_material *material)
{
    const struct gltf_object transform = gltf_extension(info, "KHR_texture_transform");
    float offset[2] = { 0 };
    float scale[2] = { 1, 1 };
    (void)gltf_floats(&transform, "offset", offset, 2);
    (void)gltf_floats(&transform, "scale", scale, 2);
    const float angle = gltf_number(&transform, "rotation", 0);
    const float c = cosf(angle);
    const float s = sinf(angle);
    material->uv_rows[0] = (vec3s){ { c * scale[0], s * scale[1], offset[0] } };
    material->uv_rows[1] = (vec3s){ { -s * scale[0], c * scale[1], offset[1] } };
    material->uv_set =
        (uint32_t)gltf_count(&transform, "texCoord", gltf_count(info, "texCoord", 0));
}

/* Returns the image of a texture; gltf_none if there is none. */
static uint32_t read_image(const struct gltf_object *info)
{
    struct gltf *gltf = info->gltf;
    const uint32_t texture = gltf_index(info, "index", "textures");
    if (texture == gltf_none) {
        if (info->json)
            (void)gltf_fault(info, "index: expected a texture");
        return gltf_none;
    }
    const struct gltf_object object = gltf_element(gltf, "textures", texture);
    const uint32_t sampler = gltf_index(&object, "sampler", "samplers");
    const uint32_t image = gltf_index(&object, "source", "images");
    if (sampler != gltf_none) {
        const struct gltf_object wrap = gltf_element(gltf, "samplers", sampler);
        const uint64_t repeat = 10497;
        note(gltf, GLTF_WRAP,
             gltf_count(&wrap, "wrapS", repeat) != repeat ||
                 gltf_count(&wrap, "wrapT", repeat) != repeat);
    }
    note(gltf, GLTF_PICTURELESS, image == gltf_none);
    return image;
}

static void read_base(const struct gltf_object *object, struct gltf_material *material)
{
    struct material *m = &material->material;
    const struct gltf_object pbr = gltf_member(object, "pbrMetallicRoughness");
    const struct gltf_object texture = gltf_member(&pbr, "baseColorTexture");
    float color[4] = { 1, 1, 1, 1 };
    (void)gltf_floats(&pbr, "baseColorFactor", color, 4);
    m->base_color = (vec3s){ { color[0], color[1], color[2] } };
    m->roughness = gltf_number(&pbr, "roughnessFactor", 1);
    material->image = read_image(&texture);
    read_transform(&texture, material);
    note(object->gltf, GLTF_METAL, has(&pbr, "metallicRoughnessTexture"));
}

/* What light at the surface does beside its base colour. */
static void read_surface(const struct gltf_object *object, struct gltf_material *material)
{
    struct gltf *gltf = object->gltf;
    const struct gltf_object unlit = gltf_extension(object, "KHR_materials_unlit");
    const char *mode = gltf_string(object, "alphaMode", "OPAQUE");
    float emission[3] = { 0 };
    (void)gltf_floats(object, "emissiveFactor", emission, 3);
    if (unlit.json) {
        material->mesh_flags |= MESH_UNLIT;
        material->material.flags |= MATERIAL_IS_UNLIT;
    }
    if (strcmp(mode, "MASK") == 0) {
        material->mesh_flags |= MESH_CUTOUT;
        material->material.flags |= MATERIAL_IS_CUTOUT;
        note(gltf, GLTF_CUTOFF, gltf_number(object, "alphaCutoff", 0.5F) != 0.5F);
    } else if (strcmp(mode, "BLEND") == 0) {
        note(gltf, GLTF_BLEND, true);
    } else if (strcmp(mode, "OPAQUE") != 0) {
        (void)gltf_fault(object, "alphaMode: expected OPAQUE, MASK or BLEND, got \"%.16s\"", mode);
    }
    note(gltf, GLTF_NORMAL, has(object, "normalTexture"));
    note(gltf, GLTF_OCCLUSION, has(object, "occlusionTexture"));
    note(gltf, GLTF_EMISSION, emission[0] > 0 || emission[1] > 0 || emission[2] > 0);
    note(gltf, GLTF_SPECULAR, gltf_extension(object, "KHR_materials_specular").json);
}

/* What the extensions of transmission, volume, index and dispersion say. */
static void read_medium(const struct gltf_object *object, struct gltf_material *material)
{
    struct gltf *gltf = object->gltf;
    struct material *m = &material->material;
    const struct gltf_object through = gltf_extension(object, "KHR_materials_transmission");
    const struct gltf_object volume = gltf_extension(object, "KHR_materials_volume");
    const struct gltf_object index = gltf_extension(object, "KHR_materials_ior");
    const struct gltf_object spread = gltf_extension(object, "KHR_materials_dispersion");
    m->transmission = gltf_number(&through, "transmissionFactor", 0);
    m->thickness = gltf_number(&volume, "thicknessFactor", 0);
    m->attenuation_distance = gltf_number(&volume, "attenuationDistance", 0);
    (void)gltf_floats(&volume, "attenuationColor", m->attenuation_color.raw, 3);
    m->dispersion = gltf_number(&spread, "dispersion", 0);
    if (has(&volume, "attenuationDistance") && !(m->attenuation_distance > 0))
        (void)gltf_fault(&volume, "attenuationDistance: expected a length above 0");
    material->ior = gltf_number(&index, "ior", 0);
    if (m->transmission > 0 && material->ior != 0 && !(material->ior >= 1 && material->ior <= 4))
        (void)gltf_fault(&index, "expected an index of refraction from 1 to 4, got %g",
                         (double)material->ior);
    if (material->ior >= 1) {
        m->ior = material->ior;
        m->flags |= MATERIAL_HAS_IOR;
    }
    note(gltf, GLTF_TRANSMISSION_TEXTURE, has(&through, "transmissionTexture"));
    note(gltf, GLTF_VOLUME_TEXTURE, has(&volume, "thicknessTexture"));
}

/* The order of media that overlap: "extras": { "priority": 3 }. */
static void read_priority(const struct gltf_object *object, struct material *m)
{
    const json_t *extras = json_object_get(object->json, "extras");
    const json_t *priority = json_object_get(extras, "priority");
    if (!priority)
        return;
    const json_int_t value = json_integer_value(priority);
    if (json_is_integer(priority) && value >= INT32_MIN && value <= INT32_MAX) {
        m->priority = (int32_t)value;
        m->flags |= MATERIAL_HAS_PRIORITY;
    } else {
        (void)gltf_fault(object, "extras.priority: expected a whole number of 32 bits");
    }
}

static void read_material(struct gltf *gltf, uint32_t index)
{
    const struct gltf_object object = gltf_element(gltf, "materials", index);
    struct gltf_material *material = &gltf->materials[index];
    material->material = material_make(gltf_string(&object, "name", ""));
    read_base(&object, material);
    read_surface(&object, material);
    read_medium(&object, material);
    read_priority(&object, &material->material);
    vec3s color = material->material.base_color;
    gltf->import->clamped_materials += model_color_clamp(&color, false);
    material->material.base_color = color;
    gltf->clamped_count += material_clamp(&material->material);
}

enum status gltf_materials_read(struct gltf *gltf)
{
    const uint32_t count = gltf_list_length(gltf, "materials");
    gltf->materials = calloc(count + (size_t)1, sizeof(*gltf->materials));
    if (!gltf->materials)
        return gltf_no_memory(gltf);
    gltf->material_count = count + 1;
    for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++)
        read_material(gltf, i);
    gltf->materials[count].material = material_make("");
    gltf->materials[count].image = gltf_none;
    return gltf->status;
}
