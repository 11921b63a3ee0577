/* gltf_material.c: reads glTF materials (glTF 2.0, 3.9; KHR_materials_*) and firn's extras. */
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

static void read_base(const struct gltf_object *object, struct material *m)
{
    const struct gltf_object pbr = gltf_member(object, "pbrMetallicRoughness");
    float color[4] = { 1, 1, 1, 1 };
    (void)gltf_floats(&pbr, "baseColorFactor", color, 4);
    m->base_color = (vec3s){ { color[0], color[1], color[2] } };
    m->alpha = color[3];
    m->roughness = gltf_number(&pbr, "roughnessFactor", 1);
    m->metallic = gltf_number(&pbr, "metallicFactor", 1);
}

static void read_alpha(const struct gltf_object *object, struct gltf_material *material)
{
    struct material *m = &material->material;
    const char *mode = gltf_string(object, "alphaMode", "OPAQUE");
    m->alpha_cutoff = gltf_number(object, "alphaCutoff", 0.5F);
    if (strcmp(mode, "MASK") == 0) {
        material->mesh_flags |= MESH_CUTOUT;
        m->flags |= MATERIAL_IS_CUTOUT;
    } else if (strcmp(mode, "BLEND") == 0) {
        m->flags |= MATERIAL_IS_BLENDED;
    } else if (strcmp(mode, "OPAQUE") != 0) {
        (void)gltf_fault(object, "alphaMode: expected OPAQUE, MASK or BLEND, got \"%.16s\"", mode);
    }
}

/* Reads the emission, specular, normal, occlusion, unlit and double-sided properties. */
static void read_surface(const struct gltf_object *object, struct gltf_material *material)
{
    struct material *m = &material->material;
    const struct gltf_object unlit = gltf_extension(object, "KHR_materials_unlit");
    const struct gltf_object strength = gltf_extension(object, "KHR_materials_emissive_strength");
    const struct gltf_object specular = gltf_extension(object, "KHR_materials_specular");
    const struct gltf_object normal = gltf_member(object, "normalTexture");
    const struct gltf_object occlusion = gltf_member(object, "occlusionTexture");
    if (unlit.json) {
        material->mesh_flags |= MESH_UNLIT;
        m->flags |= MATERIAL_IS_UNLIT;
    }
    if (gltf_flag(object, "doubleSided"))
        m->flags |= MATERIAL_IS_TWO_SIDED;
    (void)gltf_floats(object, "emissiveFactor", m->emission.raw, 3);
    m->emission = glms_vec3_scale(m->emission, gltf_number(&strength, "emissiveStrength", 1));
    m->normal_scale = gltf_number(&normal, "scale", 1);
    m->occlusion_strength = gltf_number(&occlusion, "strength", 1);
    m->specular = gltf_number(&specular, "specularFactor", 1);
    (void)gltf_floats(&specular, "specularColorFactor", m->specular_color.raw, 3);
}

/* Reads KHR_materials_clearcoat. */
static void read_coat(const struct gltf_object *object, struct material *m)
{
    const struct gltf_object coat = gltf_extension(object, "KHR_materials_clearcoat");
    m->coat = gltf_number(&coat, "clearcoatFactor", 0);
    m->coat_roughness = gltf_number(&coat, "clearcoatRoughnessFactor", 0);
    if (m->coat > 0 && json_object_get(coat.json, "clearcoatNormalTexture"))
        object->gltf->undrawn |= 1u << GLTF_COAT_NORMAL;
}

/* Reads KHR_materials_transmission, _volume, _ior and _dispersion. */
static void read_medium(const struct gltf_object *object, struct gltf_material *material)
{
    struct material *m = &material->material;
    const struct gltf_object transmit_ext = gltf_extension(object, "KHR_materials_transmission");
    const struct gltf_object volume = gltf_extension(object, "KHR_materials_volume");
    const struct gltf_object index = gltf_extension(object, "KHR_materials_ior");
    const struct gltf_object dispersion_ext = gltf_extension(object, "KHR_materials_dispersion");
    m->transmission = gltf_number(&transmit_ext, "transmissionFactor", 0);
    m->thickness = gltf_number(&volume, "thicknessFactor", 0);
    m->attenuation_distance = gltf_number(&volume, "attenuationDistance", 0);
    (void)gltf_floats(&volume, "attenuationColor", m->attenuation_color.raw, 3);
    m->dispersion = gltf_number(&dispersion_ext, "dispersion", 0);
    if (json_object_get(volume.json, "attenuationDistance") && !(m->attenuation_distance > 0)) {
        m->attenuation_distance = 0; /* a clear medium */
        if (m->transmission > 0)
            object->gltf->undrawn |= 1u << GLTF_ATTENUATION_DISTANCE;
    }
    material->ior = gltf_number(&index, "ior", 0);
    if (m->transmission > 0 && material->ior != 0 && !(material->ior >= 1 && material->ior <= 4))
        (void)gltf_fault(&index, "expected an index of refraction from 1 to 4, got %g",
                         (double)material->ior);
    if (material->ior >= 1) {
        m->ior = material->ior;
        m->flags |= MATERIAL_HAS_IOR;
    } else if (json_object_get(index.json, "ior")) {
        m->flags |= MATERIAL_IS_LEGACY;
    }
}

/* Reads "extras": { "priority": 3 }. The highest priority wins where media overlap. */
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
        (void)gltf_fault(object, "extras.priority: expected a 32-bit integer");
    }
}

/* Reads "extras": { "class": 3 }, the number in layer `class`. */
static void read_class(const struct gltf_object *object, struct material *m)
{
    const json_t *number = json_object_get(json_object_get(object->json, "extras"), "class");
    const json_int_t value = json_integer_value(number);
    if (!number)
        return;
    if (json_is_integer(number) && value >= 0 && value <= MATERIAL_CLASS_MAX)
        m->class_id = (uint32_t)value;
    else
        (void)gltf_fault(object, "extras.class: expected a whole number from 0 to %d",
                         MATERIAL_CLASS_MAX);
}

/* Reads "extras": { "cloud": 6 }, the optical depth of scattering across the object. */
static void read_scattering(const struct gltf_object *object, struct material *m)
{
    const json_t *density = json_object_get(json_object_get(object->json, "extras"), "cloud");
    const double value = json_number_value(density);
    if (!density)
        return;
    if (json_is_number(density) && value >= 0 && value <= (double)MATERIAL_SCATTERING_MAX)
        m->scattering_optical_depth = (float)value;
    else
        (void)gltf_fault(object, "extras.cloud: expected a number from 0 to %g",
                         (double)MATERIAL_SCATTERING_MAX);
}

/* Reads "extras": { "film": true }. True means that a water layer covers an opaque base. */
static void read_water_layer(const struct gltf_object *object, struct material *m)
{
    const json_t *film = json_object_get(json_object_get(object->json, "extras"), "film");
    if (json_is_true(film))
        m->flags |= MATERIAL_IS_WATER_LAYER;
    else if (film && !json_is_false(film))
        (void)gltf_fault(object, "extras.film: expected true or false");
}

static bool has_image(const struct gltf_texture *texture)
{
    return texture->image != gltf_none;
}

/* Records a transmissive material's properties that are not drawn. Thickness textures are not
 * drawn, because path lengths are traced. A metallic factor is recorded only if no texture scales
 * it and the file sets it, because the default of 1 is rarely intended. */
static void record_undrawn(const struct gltf_object *object, const struct gltf_material *material)
{
    const struct material *m = &material->material;
    const struct gltf_texture *textures = material->textures;
    const struct gltf_object pbr = gltf_member(object, "pbrMetallicRoughness");
    const bool is_white = glms_vec3_eqv(m->specular_color, glms_vec3_one());
    const bool has_alpha = m->alpha < 1 || has_image(&textures[MATERIAL_BASE_COLOR]);
    uint32_t bits = 0;
    if (m->flags & (MATERIAL_IS_BLENDED | MATERIAL_IS_CUTOUT) && has_alpha)
        bits |= 1u << GLTF_TRANSMISSIVE_ALPHA;
    if (glms_vec3_max(m->emission) > 0)
        bits |= 1u << GLTF_TRANSMISSIVE_EMISSION;
    if (m->metallic > 0 && json_object_get(pbr.json, "metallicFactor") &&
        !has_image(&textures[MATERIAL_METALLIC_ROUGHNESS]))
        bits |= 1u << GLTF_TRANSMISSIVE_METALLIC;
    if (has_image(&textures[MATERIAL_OCCLUSION]))
        bits |= 1u << GLTF_TRANSMISSIVE_OCCLUSION;
    if (m->coat > 0)
        bits |= 1u << GLTF_TRANSMISSIVE_COAT;
    if (m->specular < 1 || !is_white || has_image(&textures[MATERIAL_SPECULAR]) ||
        has_image(&textures[MATERIAL_SPECULAR_COLOR]))
        bits |= 1u << GLTF_TRANSMISSIVE_SPECULAR;
    if (m->thickness > 0 && has_image(&textures[MATERIAL_THICKNESS]))
        bits |= 1u << GLTF_TRANSMISSIVE_THICKNESS;
    if (m->transmission > 0)
        object->gltf->undrawn |= bits;
}

static void read_material(struct gltf *gltf, uint32_t index)
{
    const struct gltf_object object = gltf_element(gltf, "materials", index);
    struct gltf_material *material = &gltf->materials[index];
    material->material = material_make(gltf_string(&object, "name", ""));
    read_base(&object, &material->material);
    read_alpha(&object, material);
    read_surface(&object, material);
    read_coat(&object, &material->material);
    read_medium(&object, material);
    gltf_texture_info_read(&object, material);
    record_undrawn(&object, material);
    if (material->material.transmission > 0 || material->mesh_flags & MESH_UNLIT)
        material->material.coat = 0;
    read_priority(&object, &material->material);
    read_class(&object, &material->material);
    read_scattering(&object, &material->material);
    read_water_layer(&object, &material->material);
    vec3s color = material->material.base_color;
    gltf->import->clamped_materials += model_color_clamp(&color, false);
    material->material.base_color = color;
    gltf->clamped_count += material_clamp(&material->material);
}

enum status gltf_materials_read(struct gltf *gltf)
{
    const uint32_t count = gltf_list_length(gltf, "materials");
    const struct gltf_object top = gltf_top(gltf);
    if (count > MESH_SURFACE_MAX - 2) /* 2 for default and settings materials */
        return gltf_fault(&top, "expected at most %u materials", MESH_SURFACE_MAX - 2);
    gltf->materials = calloc(count + (size_t)1, sizeof(*gltf->materials));
    if (!gltf->materials)
        return gltf_out_of_memory(gltf);
    gltf->material_count = count + 1;
    for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++)
        read_material(gltf, i);
    gltf->materials[count].material = material_make("");
    gltf->materials[count].material.metallic = 1;
    gltf->materials[count].uv_set = gltf_none;
    gltf->materials[count].other_uv_set = gltf_none;
    return gltf->status;
}
