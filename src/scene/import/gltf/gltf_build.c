/* gltf_build.c: runs the glTF import; builds a model's objects and surroundings from the nodes. */
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/suggest.h"
#include "src/scene/import/gltf/gltf.h"

enum {
    NAMES_MAX = 64, /* maximum names in model_pose.objects */
};

struct traversal {
    struct gltf *gltf;
    struct model_build build;
    enum model_role default_role;
    bool is_node[NAMES_MAX]; /* name belongs to a node */
    uint32_t instance;       /* number of the visited instance of a mesh */
    bool is_split;           /* true to choose roles by transmission */
    bool is_counting;        /* first pass, which only counts */
};

static bool has_transmission(const struct gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count; k++) {
            const struct gltf_primitive *primitive = &gltf->meshes[i].primitives[k];
            if (primitive->index_count > 0 &&
                gltf->materials[primitive->material].material.transmission > 0)
                return true;
        }
    }
    return false;
}

/* Returns true if any primitive has no material and therefore uses the default material. */
static bool uses_default_material(const struct gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count; k++) {
            if (gltf->meshes[i].primitives[k].material + 1 == gltf->material_count)
                return true;
        }
    }
    return false;
}

static bool has_colors(const struct gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count; k++) {
            if (gltf->meshes[i].primitives[k].colors)
                return true;
        }
    }
    return false;
}

/* Returns true if any primitive has a material other than the default one. */
static bool has_materials(const struct gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count; k++) {
            if (gltf->meshes[i].primitives[k].material + 1 < gltf->material_count)
                return true;
        }
    }
    return false;
}

/* ---- objects selected by name ---- */

/* Returns true if the first line of a text is `name`. */
static bool equals_line(const char *line, const char *name)
{
    const size_t length = strcspn(line, "\n");
    return strlen(name) == length && !strncmp(line, name, length);
}

static const char *next_line(const char *line)
{
    line += strcspn(line, "\n");
    return line + (*line == '\n');
}

/* Returns 0 if no selected name is that of a primitive's node or material. Equal results otherwise
 * mean that --material sets the same material. */
static uint32_t override_of(const struct traversal *traversal, const struct gltf_node *node,
                            const struct gltf_primitive *primitive)
{
    const struct gltf *gltf = traversal->gltf;
    const char *line = gltf->objects ? gltf->objects : "";
    for (size_t i = 0; *line; line = next_line(line), i++) {
        const char *name =
            traversal->is_node[i] ? node->name : gltf->materials[primitive->material].material.name;
        if (equals_line(line, name))
            return (uint32_t)i + 1;
    }
    return 0;
}

/* Checks that a node or material exists for each selected name. If not, logs a suggestion. */
static enum status find_names(struct traversal *traversal)
{
    struct gltf *gltf = traversal->gltf;
    const struct gltf_object top = gltf_top(gltf);
    const char *line = gltf->objects ? gltf->objects : "";
    for (size_t i = 0; *line; line = next_line(line), i++) {
        char name[MATERIAL_NAME_SIZE], hint[SUGGEST_HINT_SIZE];
        struct suggest suggest = { .word = name };
        bool is_material = false;
        if (i == NAMES_MAX)
            return gltf_fault(&top, "expected at most %d names of objects", NAMES_MAX);
        (void)snprintf(name, sizeof(name), "%.*s", (int)strcspn(line, "\n"), line);
        for (uint32_t k = 0; k < gltf->order_count; k++) {
            const struct gltf_node *node = &gltf->nodes[gltf->order[k]];
            if (node->mesh != gltf_none && !strcmp(node->name, name))
                traversal->is_node[i] = true;
            if (node->mesh != gltf_none)
                suggest_offer(&suggest, node->name);
        }
        for (uint32_t k = 0; k < gltf->material_count; k++) {
            is_material = is_material || !strcmp(gltf->materials[k].material.name, name);
            suggest_offer(&suggest, gltf->materials[k].material.name);
        }
        if (!is_material && !traversal->is_node[i])
            return gltf_fault(&top, "no node with a mesh, and no material, has the name '%s'%s",
                              name, suggest_hint(&suggest, hint));
    }
    return STATUS_OK;
}

/* ---- objects or surroundings ---- */

static enum model_role role_of(const struct traversal *traversal, const struct gltf_node *node,
                               const struct gltf_primitive *primitive)
{
    if (!traversal->is_split)
        return traversal->default_role;
    if (override_of(traversal, node, primitive))
        return MODEL_OBJECT;
    return traversal->gltf->materials[primitive->material].material.transmission > 0
               ? MODEL_OBJECT
               : MODEL_SURROUNDINGS;
}

/* Sets the model's index of refraction to that of its first object. */
static void read_ior(const struct traversal *traversal, const struct gltf_material *material)
{
    struct model *model = traversal->build.model;
    if (model->has_ior)
        return;
    model->has_ior = material->ior > 0 || material->material.transmission > 0;
    model->ior = model->has_ior ? material->material.ior : 0;
}

static struct model_shape shape_of(const struct gltf *gltf, const struct gltf_primitive *primitive,
                                   const char *name)
{
    const struct gltf_material *material = &gltf->materials[primitive->material];
    const uint32_t layer =
        primitive->uvs ? material->material.textures[MATERIAL_BASE_COLOR].layer : 0;
    const uint32_t flags = material->mesh_flags & (layer ? UINT32_MAX : MESH_UNLIT);
    return (struct model_shape){
        .name = name,
        .positions = primitive->positions,
        .normals = primitive->normals,
        .colors = primitive->colors,
        .uvs = primitive->uvs,
        .uv_stride = 2,
        .other_uvs = primitive->other_uvs,
        .tangents = primitive->tangents,
        .indices = primitive->indices,
        .vertex_count = primitive->vertex_count,
        .index_count = primitive->index_count,
        .color = material->material.base_color,
        .material = layer | flags | (primitive->material + 1) << MESH_SURFACE_SHIFT,
    };
}

/* Adds an object for a primitive, whose triangles must be appended to the mesh afterwards. */
static enum status add_object(struct traversal *traversal, const struct gltf_node *node,
                              const struct gltf_primitive *primitive)
{
    struct object object = {
        .index_count = primitive->index_count,
        .material = primitive->material,
    };
    const struct model_build_object params = {
        .group = traversal->instance,
        .override = override_of(traversal, node, primitive),
        .vertex_count = primitive->vertex_count,
    };
    memcpy(object.name, node->name, sizeof(object.name));
    return model_build_add_object(&traversal->build, &object, &params);
}

/* Returns true if a skin, not the node's transform, places a primitive. */
static bool is_skinned(const struct gltf_node *node, const struct gltf_primitive *primitive)
{
    return node->skin != gltf_none && primitive->joints;
}

/* Counts a primitive. The position of a skinned one is taken from its joints. */
static enum status count_primitive(struct traversal *traversal, const struct gltf_node *node,
                                   const struct gltf_primitive *primitive,
                                   const struct affine *model_from_mesh)
{
    struct gltf *gltf = traversal->gltf;
    struct model_build *build = &traversal->build;
    const enum model_role role = role_of(traversal, node, primitive);
    if (role == MODEL_OBJECT)
        read_ior(traversal, &gltf->materials[primitive->material]);
    build->has_extras[role] |= primitive->other_uvs || primitive->tangents;
    if (is_skinned(node, primitive)) {
        const struct gltf_object skin = gltf_element(gltf, "skins", node->skin);
        for (uint32_t i = 0; i < gltf_length(&skin, "joints"); i++) {
            const uint32_t joint = gltf_index_at(&skin, "joints", i, "nodes");
            model_build_extend(build, role, NULL, 0, &gltf->nodes[joint].model_from_node);
        }
    } else {
        model_build_extend(build, role, primitive->positions, primitive->vertex_count,
                           model_from_mesh);
    }
    return model_build_count(build, role, primitive->vertex_count, primitive->index_count);
}

static enum status visit_primitive(struct traversal *traversal, const struct gltf_node *node,
                                   const struct affine *model_from_mesh, uint32_t index)
{
    struct gltf *gltf = traversal->gltf;
    const struct gltf_primitive *primitive = &gltf->meshes[node->mesh].primitives[index];
    const enum model_role role = role_of(traversal, node, primitive);
    enum status status = STATUS_OK;
    if (primitive->index_count == 0)
        return STATUS_OK;
    if (traversal->is_counting)
        return count_primitive(traversal, node, primitive, model_from_mesh);
    struct affine relative = affine_relocate(model_from_mesh, gltf->origin);
    char name[64];
    (void)snprintf(name, sizeof(name), "meshes[%u].primitives[%u]", node->mesh, index);
    struct model_shape shape = shape_of(gltf, primitive, name);
    struct gltf_primitive posed = { 0 };
    if (gltf_is_deformed(node, primitive)) {
        status = gltf_skin_morph(gltf, node, primitive, &posed);
        shape.positions = posed.positions;
        shape.normals = posed.normals;
        shape.tangents = NULL; /* undeformed tangents: derived from UVs instead */
        if (is_skinned(node, primitive))
            relative = affine_identity();
    }
    if (status == STATUS_OK && !shape.normals) {
        posed.normals = gltf_flat_normals(shape.positions, shape.vertex_count);
        shape.normals = posed.normals;
        status = posed.normals ? STATUS_OK : log_out_of_memory(gltf->path);
    }
    if (status == STATUS_OK && traversal->is_split && role == MODEL_OBJECT)
        status = add_object(traversal, node, primitive);
    if (status == STATUS_OK)
        status = model_build_add(&traversal->build, role, &shape, &relative);
    gltf_primitive_finish(&posed);
    return status;
}

/* Visits the primitives of a node's mesh, once for each instance. */
static enum status visit_mesh(struct traversal *traversal, const struct gltf_node *node)
{
    const uint32_t count = traversal->gltf->meshes[node->mesh].count;
    const uint32_t instance_count = node->instances ? node->instance_count : 1;
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < instance_count; i++) {
        const struct affine model_from_mesh =
            node->instances ? affine_multiply(&node->model_from_node, &node->instances[i])
                            : node->model_from_node;
        traversal->build.surroundings_name = node->name;
        traversal->instance++;
        for (uint32_t k = 0; k < count && status == STATUS_OK; k++)
            status = visit_primitive(traversal, node, &model_from_mesh, k);
    }
    return status;
}

static enum status walk_nodes(struct traversal *traversal)
{
    const struct gltf *gltf = traversal->gltf;
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < gltf->order_count && status == STATUS_OK; i++) {
        const struct gltf_node *node = &gltf->nodes[gltf->order[i]];
        if (node->mesh != gltf_none)
            status = visit_mesh(traversal, node);
    }
    return status;
}

static enum status check_shapes(const struct gltf *gltf)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count && status == STATUS_OK; k++) {
            char name[64];
            (void)snprintf(name, sizeof(name), "meshes[%u].primitives[%u]", i, k);
            const struct model_shape shape = shape_of(gltf, &gltf->meshes[i].primitives[k], name);
            status = model_shape_check(gltf->import, &shape);
        }
    }
    return status;
}

/* Prepares primitives without normals, whose indices are in range, for flat shading. */
static enum status split_flat_primitives(struct gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count; k++) {
            struct gltf_primitive *primitive = &gltf->meshes[i].primitives[k];
            if (primitive->index_count > 0 && !primitive->normals && !gltf_split_corners(primitive))
                return log_out_of_memory(gltf->path);
        }
    }
    return STATUS_OK;
}

static enum status list_materials(struct traversal *traversal)
{
    const struct gltf *gltf = traversal->gltf;
    struct model *model = traversal->build.model;
    model->materials = calloc(gltf->material_count, sizeof(*model->materials));
    if (!model->materials)
        return log_out_of_memory(gltf->path);
    model->material_count = gltf->material_count - !uses_default_material(gltf);
    for (uint32_t i = 0; i < model->material_count; i++)
        model->materials[i] = gltf->materials[i].material;
    return traversal->is_split ? STATUS_OK : model_build_default_object(&traversal->build);
}

enum status gltf_build(struct gltf *gltf, struct model *model, enum model_role default_role)
{
    struct traversal traversal = {
        .gltf = gltf,
        .default_role = default_role == MODEL_BY_MATERIALS ? MODEL_OBJECT : default_role,
        .is_split = has_transmission(gltf) || (gltf->objects && gltf->objects[0]) ||
                    (default_role == MODEL_BY_MATERIALS && has_materials(gltf)),
        .is_counting = true,
    };
    if (default_role == MODEL_BY_MATERIALS && !traversal.is_split && has_colors(gltf))
        gltf->undrawn |= 1u << GLTF_COLORS_WITHOUT_MATERIAL; /* ice shows no vertex colours */
    model_build_init(&traversal.build, gltf->import, model);
    traversal.build.is_animated = gltf_list_length(gltf, "animations") > 0;
    enum status status = find_names(&traversal);
    if (status == STATUS_OK)
        status = check_shapes(gltf);
    if (status == STATUS_OK)
        status = split_flat_primitives(gltf);
    if (status == STATUS_OK)
        status = walk_nodes(&traversal);
    if (status == STATUS_OK)
        status = model_build_allocate(&traversal.build);
    memcpy(gltf->origin, model->origin, sizeof(gltf->origin));
    traversal.is_counting = false;
    if (status == STATUS_OK)
        status = walk_nodes(&traversal);
    if (status == STATUS_OK)
        status = list_materials(&traversal);
    if (status == STATUS_OK)
        status = model_build_end(&traversal.build);
    model_build_finish(&traversal.build);
    return status;
}

enum status model_load_gltf(struct model_import *import, struct model *model,
                            enum model_role default_role, const struct model_pose *pose)
{
    struct gltf gltf = {
        .path = import->path,
        .import = import,
        .animation = gltf_none,
        .time = pose->time,
        .objects = pose->objects,
    };
    enum status status = gltf_open(&gltf);
    if (status == STATUS_OK)
        status = gltf_validate(&gltf);
    if (status == STATUS_OK && pose->animation)
        gltf.animation = gltf_animation_find(&gltf, pose->animation);
    else if (status == STATUS_OK && pose->is_first && gltf_list_length(&gltf, "animations") > 0)
        gltf.animation = 0;
    if (status == STATUS_OK)
        status = gltf.status;
    if (status == STATUS_OK)
        status = gltf_nodes_read(&gltf);
    if (status == STATUS_OK)
        status = gltf_materials_read(&gltf);
    if (status == STATUS_OK)
        status = gltf_meshes_read(&gltf);
    if (status == STATUS_OK)
        status = gltf_images_read(&gltf, model);
    if (status == STATUS_OK)
        status = gltf_build(&gltf, model, default_role);
    if (status == STATUS_OK)
        status = gltf_cameras_read(&gltf, model);
    if (status == STATUS_OK)
        status = gltf_lights_read(&gltf, model);
    if (status == STATUS_OK)
        status = gltf_animations_read(&gltf, model);
    if (status == STATUS_OK)
        status = gltf_box_read(&gltf, model);
    if (status == STATUS_OK)
        status = gltf_extensions_read(&gltf, model);
    if (status == STATUS_OK)
        gltf_warn(&gltf, model);
    gltf_close(&gltf);
    return status;
}
