/* material.c: converts struct firn_material to and from the renderer's material, and parses
 * text. */
#include <stdio.h>
#include <string.h>
#include "src/app/options/set_option.h"
#include "src/lib/lib.h"

enum status lib_material_read(struct material *to, const struct firn_material *from)
{
    struct firn_material m;
    const enum status status = lib_read(&m, sizeof(m), from, "material");
    if (status != STATUS_OK)
        return status;
    const uint32_t known = FIRN_MATERIAL_UNLIT | FIRN_MATERIAL_TWO_SIDED | FIRN_MATERIAL_BLENDED |
                           FIRN_MATERIAL_PRIORITY;
    struct material made = *to;
    if (m.name)
        snprintf(made.name, sizeof(made.name), "%s", m.name);
    made.base_color = (vec3s){ { m.base_color[0], m.base_color[1], m.base_color[2] } };
    made.alpha = m.base_color[3];
    made.metallic = m.metallic;
    made.roughness = m.roughness;
    made.transmission = m.transmission;
    made.ior = m.ior;
    made.dispersion = m.dispersion;
    made.thickness = m.thickness;
    made.attenuation_color =
        (vec3s){ { m.attenuation_color[0], m.attenuation_color[1], m.attenuation_color[2] } };
    made.attenuation_distance = m.attenuation_distance;
    made.scattering_optical_depth = m.scattering;
    made.emission = (vec3s){ { m.emission[0], m.emission[1], m.emission[2] } };
    made.priority = m.priority;
    made.class_id = m.class_id;
    made.flags &= ~(uint32_t)(MATERIAL_IS_PARTIAL | MATERIAL_IS_UNLIT | MATERIAL_IS_TWO_SIDED |
                              MATERIAL_IS_BLENDED | MATERIAL_HAS_PRIORITY | MATERIAL_FROM_SETTINGS);
    made.flags |= MATERIAL_HAS_IOR | (m.flags & FIRN_MATERIAL_UNLIT ? MATERIAL_IS_UNLIT : 0u) |
                  (m.flags & FIRN_MATERIAL_TWO_SIDED ? MATERIAL_IS_TWO_SIDED : 0u) |
                  (m.flags & FIRN_MATERIAL_BLENDED ? MATERIAL_IS_BLENDED : 0u) |
                  (m.flags & FIRN_MATERIAL_PRIORITY ? MATERIAL_HAS_PRIORITY : 0u);
    struct material clamped = made;
    if (material_clamp(&clamped) || m.flags & ~known || m.class_id > MATERIAL_CLASS_MAX) {
        log_error("material: a number is out of the range that firn.h states (ior 1 to 4, factors "
                  "and colours 0 to 1, lengths at least 0), or a flag is unknown");
        return STATUS_USAGE;
    }
    *to = made;
    return STATUS_OK;
}

void lib_material_write(struct firn_material *to, const struct material *from)
{
    *to = (struct firn_material){
        .size = sizeof(*to),
        .name = from->name,
        .base_color = { from->base_color.x, from->base_color.y, from->base_color.z, from->alpha },
        .metallic = from->metallic,
        .roughness = from->roughness,
        .transmission = from->transmission,
        .ior = from->ior,
        .dispersion = from->dispersion,
        .thickness = from->thickness,
        .attenuation_color = { from->attenuation_color.x, from->attenuation_color.y,
                               from->attenuation_color.z },
        .attenuation_distance = from->attenuation_distance,
        .scattering = from->scattering_optical_depth,
        .emission = { from->emission.x, from->emission.y, from->emission.z },
        .priority = from->priority,
        .class_id = from->class_id,
        .flags = (from->flags & MATERIAL_IS_UNLIT ? FIRN_MATERIAL_UNLIT : 0u) |
                 (from->flags & MATERIAL_IS_TWO_SIDED ? FIRN_MATERIAL_TWO_SIDED : 0u) |
                 (from->flags & MATERIAL_IS_BLENDED ? FIRN_MATERIAL_BLENDED : 0u) |
                 (from->flags & MATERIAL_HAS_PRIORITY ? FIRN_MATERIAL_PRIORITY : 0u),
    };
}

firn_status firn_material_init(struct firn_material *material, const char *text)
{
    struct lib_call call;
    struct setup_scene scene = { 0 };
    struct material made = material_make("");
    char words[MATERIAL_OVERRIDE_SIZE + 1]; /* a longer text is refused, not truncated */
    lib_enter_alone(&call);
    enum status status = lib_require(text, "text");
    if (status == STATUS_OK && *text) {
        snprintf(words, sizeof(words), "material=%s", text);
        status = option_set_node_material(&scene, words);
        made = scene.material_overrides[0].material;
    }
    struct firn_material written;
    lib_material_write(&written, &made);
    written.name = NULL;
    if (status == STATUS_OK)
        status = lib_write(material, &written, sizeof(written), "material");
    return lib_leave(&call, status);
}
