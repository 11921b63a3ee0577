/* gpu_material_table.c: GPU table of materials, with one row of texels per material. */
#include "src/scene/gpu_material_table.h"
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>

vec3s material_f0(const struct material *m)
{
    const float root = (m->ior - 1.0f) / (m->ior + 1.0f);
    const float f0 = m->flags & MATERIAL_IS_LEGACY ? 1.0f : root * root;
    return glms_vec3_scale(m->specular_color, f0);
}

static bool is_diffuse(const struct material *m)
{
    return m->flags & (MATERIAL_FROM_SETTINGS | MATERIAL_IS_UNLIT);
}

static bool needs_full_shading(const struct material *m)
{
    const struct material_texture *base = &m->textures[MATERIAL_BASE_COLOR];
    const bool repeats = base->wrap_u == MATERIAL_REPEAT && base->wrap_v == MATERIAL_REPEAT;
    const bool is_cut_elsewhere =
        m->flags & MATERIAL_IS_CUTOUT && (m->alpha_cutoff < 0.5f || m->alpha_cutoff > 0.5f);
    return !is_diffuse(m) || is_cut_elsewhere || m->flags & MATERIAL_IS_BLENDED ||
           (base->layer > 0 && !repeats);
}

static int kind_of(const struct material *m)
{
    if (m->flags & MATERIAL_IS_CUTOUT)
        return MATERIAL_KIND_CUTOUT;
    return m->flags & MATERIAL_IS_BLENDED ? MATERIAL_KIND_BLENDED : MATERIAL_KIND_OPAQUE;
}

/* Writes a texture's transform, layer and wrap modes. */
static void write_texture(vec4s *texels, const struct material_texture *texture)
{
    texels[0] = glms_vec4(texture->u_row, (float)texture->layer);
    texels[1] =
        glms_vec4(texture->v_row, (float)(texture->uv_set * MATERIAL_OTHER_SET +
                                          texture->wrap_v * MATERIAL_WRAP_COUNT + texture->wrap_u));
}

static void write_row(vec4s *row, const struct material *m)
{
    const vec3s f0 = material_f0(m);
    const float specular = is_diffuse(m) ? 0.0f : m->specular;
    row[MATERIAL_ROW_FACTORS] = (vec4s){ { m->metallic, m->roughness, specular, m->alpha } };
    row[MATERIAL_ROW_F0] = glms_vec4(f0, (float)kind_of(m));
    const bool is_partial = m->flags & MATERIAL_IS_PARTIAL;
    const float of_object = is_partial                ? 3.0f - m->transmission
                            : material_is_textured(m) ? 1.0f
                                                      : 0.0f;
    row[MATERIAL_ROW_EMISSION] =
        glms_vec4(is_partial ? m->base_color : m->emission, m->alpha_cutoff);
    row[MATERIAL_ROW_SCALES] = (vec4s){ { m->normal_scale, m->occlusion_strength, of_object,
                                          m->flags & MATERIAL_IS_WATER_LAYER ? 1.0f : 0.0f } };
    row[MATERIAL_ROW_COAT] =
        (vec4s){ { m->coat, m->coat_roughness, m->flags & MATERIAL_IS_SHADOW_CATCHER ? 1.0f : 0.0f,
                   0.0f } };
    for (int i = 0; i < MATERIAL_TEXTURE_COUNT; i++)
        write_texture(&row[MATERIAL_ROW_TEXTURES + 2 * i], &m->textures[i]);
}

vec4s *material_table_make(const struct model *model)
{
    vec4s *rows = malloc((model->material_count + (size_t)1) * MATERIAL_ROW_WIDTH * sizeof(*rows));
    struct material none = material_make("");
    none.flags = MATERIAL_FROM_SETTINGS;
    if (!rows)
        return NULL;
    write_row(rows, &none);
    for (uint32_t i = 0; i < model->material_count; i++)
        write_row(&rows[(i + (size_t)1) * MATERIAL_ROW_WIDTH], &model->materials[i]);
    return rows;
}

bool material_table_has_holes(const struct model *model)
{
    for (uint32_t i = 0; i < model->material_count; i++) {
        if (kind_of(&model->materials[i]) != MATERIAL_KIND_OPAQUE)
            return true;
    }
    return false;
}

bool material_table_has_coat(const struct model *model)
{
    for (uint32_t i = 0; i < model->material_count; i++) {
        if (model->materials[i].coat > 0.0f)
            return true;
    }
    return false;
}

bool material_table_has_shadow_catcher(const struct model *model)
{
    for (uint32_t i = 0; i < model->material_count; i++) {
        if (model->materials[i].flags & MATERIAL_IS_SHADOW_CATCHER)
            return true;
    }
    return false;
}

uint32_t material_table_uses(const struct model *model)
{
    uint32_t uses = 0;
    for (uint32_t i = 0; i < model->material_count; i++) {
        for (uint32_t use = 0; use < MATERIAL_TEXTURE_COUNT; use++)
            uses |= (uint32_t)(model->materials[i].textures[use].layer > 0) << use;
    }
    return uses;
}

vec4s *material_table_make_extras(const struct mesh *mesh)
{
    const size_t size = (size_t)MESH_EXTRA_WIDTH * mesh_extra_row_count(mesh->vertex_count);
    vec4s *rows = mesh->extras && size > 0 ? malloc(size * sizeof(*rows)) : NULL;
    if (!rows)
        return NULL;
    memset(rows, 0, size * sizeof(*rows));
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const struct mesh_extra *extra = &mesh->extras[i];
        rows[MESH_EXTRA_TEXELS * i] = glms_vec4(extra->tangent, extra->side);
        rows[MESH_EXTRA_TEXELS * i + 1] = (vec4s){ { extra->uv.x, extra->uv.y, 0.0f, 0.0f } };
    }
    return rows;
}

bool material_table_has_lit(const struct mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (!(mesh->vertices[i].material & MESH_UNLIT))
            return true;
    }
    return false;
}

/* Returns true if any triangle of the surroundings has a material that satisfies `predicate`. */
static bool has(const struct model *model, bool (*predicate)(const struct material *))
{
    const struct mesh *mesh = &model->surroundings;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const uint32_t material = mesh->vertices[i].material >> MESH_SURFACE_SHIFT;
        if (material > 0 && predicate(&model->materials[material - 1]))
            return true;
    }
    return false;
}

bool material_table_needs_full_shading(const struct model *model)
{
    return has(model, needs_full_shading);
}

/* Returns true if a surface may be smooth enough for screen-space reflections. If there is a
 * roughness texture, parts of the surface may be smooth. */
static bool is_reflective(const struct material *m)
{
    const bool is_even = m->textures[MATERIAL_METALLIC_ROUGHNESS].layer == 0;
    const bool is_coated = m->coat > 0.0f && m->coat_roughness < MATERIAL_ROUGH;
    return is_coated || (!is_diffuse(m) && (m->specular > 0.0f || m->metallic > 0.0f) &&
                         (!is_even || m->roughness < MATERIAL_ROUGH));
}

bool material_table_has_reflective(const struct model *model)
{
    return has(model, is_reflective);
}
