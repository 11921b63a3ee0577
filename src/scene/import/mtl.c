/* mtl.c: reader of MTL material libraries (Wavefront, Advanced Visualizer, appendix B5). The reader
 * supports Pr, Pm, Ke and norm of the PBR extension and returns glTF-style materials. */
#include <cglm/struct.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/obj_ply.h"

enum {
    LIBRARY_MAX = 256 /* maximum number of MTL files per model, counting repetitions */
};

struct mtl;

/* MTL statement and the function that reads it. On failure the function logs a line. */
struct statement {
    const char *word;
    enum status (*read)(struct mtl *mtl, struct text_scan *line, const struct statement *statement);
    uint32_t which; /* member offset, or enum mtl_map_use */
};

/* MTL file being read, and the values of its current material. */
struct mtl {
    struct obj_ply *obj_ply;
    const char *path;
    uint32_t line;                 /* line number, from 1 */
    struct mtl_material *material; /* NULL before the first newmtl */
    vec3s diffuse, specular, emission, filter;
    float exponent, opacity, transparency, ior, illum, roughness, metallic;
};

static enum status fault(const struct mtl *mtl, const char *what, const struct text_scan *got)
{
    char word[32];
    text_show(word, sizeof(word), got);
    log_error("%s: line %u: %s, got '%s'", mtl->path, mtl->line, what, word);
    return STATUS_DATA;
}

static enum status no_memory(const struct mtl *mtl)
{
    return log_out_of_memory(mtl->path);
}

/* Records a statement or option that is not drawn. */
static void note_undrawn(struct mtl *mtl, const struct text_scan *text)
{
    char word[40];
    text_show(word, sizeof(word), text);
    obj_ply_note_undrawn(mtl->obj_ply->undrawn_materials, word);
}

/* ---- values ---- */

static void *field_of(struct mtl *mtl, const struct statement *statement)
{
    return (char *)mtl + statement->which;
}

/* Reads red, green and blue, or one number for all three. */
static enum status read_color(struct mtl *mtl, struct text_scan *line,
                              const struct statement *statement)
{
    vec3s *color = field_of(mtl, statement);
    const struct text_scan all = text_rest(line);
    struct text_scan word = all;
    float numbers[3];
    const uint32_t count = text_floats(line, numbers, 3);
    if (text_take_word(&word, "spectral") || text_take_word(&word, "xyz")) {
        note_undrawn(mtl, &(struct text_scan){ all.at, word.at });
        return STATUS_OK;
    }
    if (count != 1 && count < 3)
        return fault(mtl, "expected one or three colour components", &all);
    for (int k = 0; k < 3; k++) {
        color->raw[k] = numbers[count == 1 ? 0 : k];
        if (!isfinite(color->raw[k]))
            return fault(mtl, "expected finite colour components", &all);
    }
    return STATUS_OK;
}

static enum status read_number(struct mtl *mtl, struct text_scan *line,
                               const struct statement *statement)
{
    float *number = field_of(mtl, statement);
    (void)text_take_word(line, "-halo");
    const struct text_scan all = text_rest(line);
    return text_float(line, number) && isfinite(*number)
               ? STATUS_OK
               : fault(mtl, "expected a finite number", &all);
}

/* ---- pictures ---- */

/* Reads a texture option such as -s or -bm. Returns false if its values are invalid. */
static bool read_option(struct mtl *mtl, struct text_scan *line, struct mtl_map *map)
{
    float numbers[3] = { 0 };
    struct text_scan word = text_word(line);
    const struct text_scan option = word;
    if (text_take_word(&word, "-s") || text_take_word(&word, "-o")) {
        const bool is_scale = option.at[1] == 's' || option.at[1] == 'S';
        const uint32_t count = text_floats(line, numbers, 3);
        for (uint32_t k = 0; k < 2 && k < count; k++)
            (is_scale ? map->scale : map->offset)[k] = numbers[k];
        return count > 0 && count <= 3 && isfinite(numbers[0]) && isfinite(numbers[1]) &&
               !(is_scale && (map->scale[0] == 0 || map->scale[1] == 0));
    }
    if (text_take_word(&word, "-bm"))
        return text_float(line, &map->strength) && isfinite(map->strength);
    if (text_take_word(&word, "-clamp")) {
        map->is_clamped = text_take_word(line, "on");
        return map->is_clamped || text_take_word(line, "off");
    }
    note_undrawn(mtl, &option);
    if (text_take_word(&word, "-mm") || text_take_word(&word, "-t") ||
        text_take_word(&word, "-boost") || text_take_word(&word, "-texres"))
        return text_floats(line, numbers, 3) > 0;
    /* Each of the other options (-blendu, -blendv, -cc, -imfchan, -type) has one value. */
    const struct text_scan value = text_word(line);
    return value.end > value.at;
}

static enum status read_map(struct mtl *mtl, struct text_scan *line,
                            const struct statement *statement)
{
    struct mtl_map map = { .scale = { 1, 1 }, .strength = 1 };
    const struct text_scan all = text_rest(line);
    while (text_skip(line) && *line->at == '-') {
        if (!read_option(mtl, line, &map))
            return fault(mtl, "expected texture options with valid values", &all);
    }
    const struct text_scan name = text_rest(line);
    if (name.at == name.end)
        return fault(mtl, "expected the name of a texture file", &all);
    struct mtl_map *to = &mtl->material->maps[statement->which];
    map.file = malloc((size_t)(name.end - name.at) + 1);
    if (!map.file)
        return no_memory(mtl);
    text_copy(map.file, (size_t)(name.end - name.at) + 1, &name);
    free(to->file);
    *to = map;
    return STATUS_OK;
}

/* ---- materials ---- */

/* Returns true if the illumination model refracts: illum 4, 6, 7 or 9. */
static bool is_refracting(const struct mtl *mtl)
{
    const int illum = (int)fminf(fmaxf(mtl->illum, 0), 99);
    return illum == 4 || illum == 6 || illum == 7 || illum == 9;
}

/* Returns true if only "Tr 1" suggests transparency. MeshLab writes "Tr 1" for opaque materials. */
static bool is_meshlab(const struct mtl *mtl)
{
    return mtl->transparency >= 1 && !is_refracting(mtl) && !(mtl->ior > 1);
}

/* Sets the transmissive properties. A material is transmissive if its illum refracts, or it has d
 * below 1, or Tf and Ni. The transmission is 1 - d, or 1, tinted by Tf. Without Ni above 1 it is a
 * thin wall; without Ns it is smooth. If there is a map_d, d is alpha instead. */
static void set_transmission(struct mtl *mtl, struct material *m)
{
    const bool is_alpha = mtl->material->maps[MTL_MAP_ALPHA].file;
    const float opacity = is_alpha || is_meshlab(mtl) ? 1
                          : mtl->transparency > 0     ? 1 - mtl->transparency
                                                      : mtl->opacity;
    const bool is_filter = mtl->filter.x < 1 || mtl->filter.y < 1 || mtl->filter.z < 1;
    if (is_meshlab(mtl) && !is_alpha)
        obj_ply_note_undrawn(mtl->obj_ply->undrawn_materials,
                             "Tr 1 (taken as opaque, as MeshLab writes it)");
    if (!(is_refracting(mtl) || opacity < 1 || (is_filter && mtl->ior > 1)))
        return;
    m->base_color = mtl->filter;
    m->transmission = opacity < 1 ? 1 - opacity : 1;
    m->roughness = mtl->exponent > 0 || mtl->roughness >= 0 ? m->roughness : 0;
    m->thickness = mtl->ior > 1 ? 1 : 0;
    m->ior = mtl->ior > 1 ? mtl->ior : m->ior;
    m->flags |= mtl->ior > 1 ? MATERIAL_HAS_IOR : 0u;
}

/* Returns the GGX roughness that matches a Phong exponent Ns: alpha^2 = 2 / (Ns + 2). */
static float roughness_from_exponent(float exponent)
{
    return powf(2 / (fmaxf(exponent, 0) + 2), 0.25F);
}

/* Sets the opaque surface properties. As in Blender, the reflectance at normal incidence is 0.08
 * Ks. The default Ks of 0.5 gives 0.04, as for glass. illum 0 and 1 have no highlights. */
static void set_surface(const struct mtl *mtl, struct material *m)
{
    m->base_color = mtl->diffuse;
    m->metallic = mtl->metallic;
    m->emission = mtl->emission;
    m->alpha = mtl->opacity;
    m->roughness = mtl->roughness >= 0 ? mtl->roughness : roughness_from_exponent(mtl->exponent);
    if (mtl->specular.x >= 0)
        m->specular_color = glms_vec3_scale(mtl->specular, 2);
    if (mtl->illum < 2 && mtl->illum >= 0)
        m->specular = 0;
}

/* Returns true if two maps exist and differ in the options for texture coordinates. */
static bool have_different_coordinates(const struct mtl_map *a, const struct mtl_map *b)
{
    bool is_different = a->is_clamped != b->is_clamped;
    for (int k = 0; k < 2; k++)
        is_different |=
            fabsf(a->scale[k] - b->scale[k]) > 0 || fabsf(a->offset[k] - b->offset[k]) > 0;
    return is_different && a->file && b->file;
}

/* Records maps that transmissive materials ignore, and options that are lost by merging maps. */
static void check_maps(struct mtl *mtl, const struct mtl_material *material)
{
    static const char *const clear[MTL_MAP_COUNT] = {
        [MTL_MAP_COLOR] = "map_Kd of fully transmissive materials",
        [MTL_MAP_ALPHA] = "map_d of transmissive materials",
        [MTL_MAP_SPECULAR] = "map_Ks of transmissive materials",
        [MTL_MAP_EMISSION] = "map_Ke of transmissive materials",
    };
    const struct mtl_map *maps = material->maps;
    const float transmission = material->material.transmission;
    for (int i = 0; i < MTL_MAP_COUNT; i++) {
        const bool is_shown = i == MTL_MAP_COLOR ? transmission < 1 : !(transmission > 0);
        if (maps[i].file && clear[i] && !is_shown)
            obj_ply_note_undrawn(mtl->obj_ply->undrawn_materials, clear[i]);
    }
    if (have_different_coordinates(&maps[MTL_MAP_COLOR], &maps[MTL_MAP_ALPHA]))
        obj_ply_note_undrawn(mtl->obj_ply->undrawn_materials, "options of map_d");
}

/* Completes the current material from the statements read so far. */
static void end_material(struct mtl *mtl)
{
    struct mtl_material *material = mtl->material;
    if (!material)
        return;
    struct material *m = &material->material;
    material->color = mtl->diffuse;
    set_surface(mtl, m);
    set_transmission(mtl, m);
    m->normal_scale = material->maps[MTL_MAP_BUMP].file ? material->maps[MTL_MAP_BUMP].strength : 1;
    if (material->maps[MTL_MAP_ALPHA].file && !(m->transmission > 0))
        m->flags |= MATERIAL_IS_BLENDED;
    else
        m->alpha = 1;
    check_maps(mtl, material);
    mtl->obj_ply->import->clamped_materials += model_color_clamp(&material->color, false);
    (void)model_color_clamp(&m->base_color, false);
    (void)material_clamp(m);
}

/* Begins a material. If several materials have the same name, the first one is used. */
static enum status begin_material(struct mtl *mtl, struct text_scan *line,
                                  const struct statement *statement)
{
    struct obj_ply *obj_ply = mtl->obj_ply;
    const struct text_scan text = text_rest(line);
    const size_t size = (size_t)(text.end - text.at) + 1;
    (void)statement;
    end_material(mtl);
    if (obj_ply->material_count == MESH_SURFACE_MAX)
        return fault(mtl, "expected at most 8191 materials", &text);
    struct mtl_material *grown =
        realloc(obj_ply->materials, (obj_ply->material_count + (size_t)1) * sizeof(*grown));
    if (!grown)
        return no_memory(mtl);
    obj_ply->materials = grown;
    mtl->material = &grown[obj_ply->material_count];
    *mtl->material = (struct mtl_material){ .name = malloc(size) };
    if (!mtl->material->name)
        return no_memory(mtl);
    text_copy(mtl->material->name, size, &text);
    mtl->material->material = material_make(mtl->material->name);
    obj_ply->material_count++;
    mtl->diffuse = glms_vec3_one();
    mtl->filter = glms_vec3_one();
    mtl->emission = glms_vec3_zero();
    mtl->specular = glms_vec3_fill(-1);
    mtl->exponent = 0;
    mtl->opacity = 1;
    mtl->transparency = 0;
    mtl->ior = 1;
    mtl->illum = -1;
    mtl->roughness = -1;
    mtl->metallic = 0;
    return STATUS_OK;
}

static enum status skip(struct mtl *mtl, struct text_scan *line, const struct statement *statement)
{
    (void)mtl;
    (void)line;
    (void)statement;
    return STATUS_OK;
}

static const struct statement statements[] = {
    { "newmtl", begin_material, 0 },
    { "Kd", read_color, offsetof(struct mtl, diffuse) },
    { "Ks", read_color, offsetof(struct mtl, specular) },
    { "Ke", read_color, offsetof(struct mtl, emission) },
    { "Tf", read_color, offsetof(struct mtl, filter) },
    { "Ns", read_number, offsetof(struct mtl, exponent) },
    { "Ni", read_number, offsetof(struct mtl, ior) },
    { "d", read_number, offsetof(struct mtl, opacity) },
    { "Tr", read_number, offsetof(struct mtl, transparency) },
    { "illum", read_number, offsetof(struct mtl, illum) },
    { "Pr", read_number, offsetof(struct mtl, roughness) },
    { "Pm", read_number, offsetof(struct mtl, metallic) },
    { "map_Kd", read_map, MTL_MAP_COLOR },
    { "map_d", read_map, MTL_MAP_ALPHA },
    { "map_Ks", read_map, MTL_MAP_SPECULAR },
    { "map_Ke", read_map, MTL_MAP_EMISSION },
    { "map_bump", read_map, MTL_MAP_BUMP },
    { "bump", read_map, MTL_MAP_BUMP },
    { "norm", read_map, MTL_MAP_BUMP },
    { "Ka", skip, 0 }, /* environment lights replace ambient reflectance */
    { "map_Ka", skip, 0 },
    { "map_aat", skip, 0 }, /* texture antialiasing */
    { "sharpness", skip, 0 },
};

static enum status read_line(struct mtl *mtl, struct text_scan *line)
{
    if (!text_skip(line) || *line->at == '#')
        return STATUS_OK;
    for (size_t i = 0; i < sizeof(statements) / sizeof(statements[0]); i++) {
        const struct statement *statement = &statements[i];
        if (!text_take_word(line, statement->word))
            continue;
        if (!mtl->material && statement->read != begin_material)
            return STATUS_OK; /* statement before the first newmtl */
        return statement->read(mtl, line, statement);
    }
    const struct text_scan word = text_word(line);
    note_undrawn(mtl, &word);
    return STATUS_OK;
}

/* Reads an MTL file. If it does not exist, *is_found is false and nothing is logged. */
static enum status read_file(struct obj_ply *obj_ply, const struct text_scan *name, bool *is_found)
{
    size_t size = 0;
    enum status status = STATUS_OK;
    const size_t length = (size_t)(name->end - name->at) + 1;
    if (++obj_ply->library_count > LIBRARY_MAX) {
        log_error("%s: expected at most %d files after mtllib", obj_ply->import->path, LIBRARY_MAX);
        return STATUS_DATA;
    }
    char *word = malloc(length);
    char *path = NULL;
    if (word) {
        text_copy(word, length, name);
        for (char *c = word; *c; c++)
            *c = (char)(*c == '\\' ? '/' : *c);
        path = model_file_join(obj_ply->import->path, word);
    }
    free(word);
    if (!path)
        return log_out_of_memory(obj_ply->import->path);
    char *text = obj_ply_read_file(obj_ply->import, path, &size, is_found);
    if (!text && *is_found)
        status = STATUS_TRY_AGAIN;
    struct mtl mtl = { .obj_ply = obj_ply, .path = path };
    struct text_scan file = { text, text ? text + size : NULL };
    if (size >= 3 && text && !memcmp(text, "\xef\xbb\xbf", 3))
        file.at += 3; /* UTF-8 byte order mark */
    while (status == STATUS_OK && file.at < file.end) {
        struct text_scan line = text_line(&file);
        mtl.line++;
        status = read_line(&mtl, &line);
    }
    end_material(&mtl);
    free(text);
    free(path);
    return status;
}

enum status mtl_read(struct obj_ply *obj_ply, const struct text_scan *name)
{
    struct model_import *import = obj_ply->import;
    struct text_scan rest = *name;
    struct text_scan word = text_word(&rest);
    bool is_found = false;
    if (word.at == word.end)
        return STATUS_OK;
    /* The whole text is tried as a file name first, then as a list of names separated by blanks. */
    const bool is_list = text_skip(&rest);
    const bool has_missed = import->missing_file[0] != '\0';
    enum status status = read_file(obj_ply, name, &is_found);
    if (is_found || !is_list || status != STATUS_OK || import->refused_file[0])
        return status;
    if (!has_missed)
        import->missing_file[0] = '\0';
    for (rest = *name; status == STATUS_OK && text_skip(&rest);) {
        word = text_word(&rest);
        status = read_file(obj_ply, &word, &is_found);
    }
    return status;
}
