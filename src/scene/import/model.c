/* model.c: reads a model file through assimp. */
#include "src/scene/import/model.h"
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/base/log.h"
#include "src/scene/import/model_import.h"
#include "src/scene/import/model_parser.h"

static enum status check_file(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0 || access(path, R_OK) != 0) {
        log_error("%s: %s", path, strerror(errno));
        return STATUS_NO_INPUT;
    }
    if (!S_ISREG(info.st_mode)) {
        log_error("%s: not a regular file", path);
        return STATUS_NO_INPUT;
    }
    if (info.st_size == 0) {
        log_error("%s: expected a model, got an empty file", path);
        return STATUS_DATA;
    }
    return STATUS_OK;
}

/* assimp leaves out triangles of a glTF file with indices out of range, and reports it only in its
 * log. */
static void watch_log(const char *message, char *found)
{
    if (strstr(message, "out-of-range indices"))
        *found = 1;
}

static enum status parse(struct model_import *import, struct model_parser *parser)
{
    char has_bad_indices = 0;
    struct aiLogStream watch = { .callback = watch_log, .user = &has_bad_indices };
    aiAttachLogStream(&watch);
    import->scene = model_parser_read(parser, import->path);
    aiDetachLogStream(&watch);
    if (import->refused[0]) {
        log_error("%s: refers to %s: expected only files within the model's folder", import->path,
                  import->refused);
        return STATUS_DATA;
    }
    if (!import->scene || !import->scene->mRootNode) {
        log_error("%s: %s", import->path,
                  import->scene ? "the scene is empty" : model_parser_error(parser));
        return STATUS_DATA;
    }
    if (has_bad_indices) {
        log_error("%s: a triangle has the index of a vertex that does not exist", import->path);
        return STATUS_DATA;
    }
    return STATUS_OK;
}

static mat4s matrix_from(const struct aiMatrix4x4 *m)
{
    return glms_mat4_transpose((mat4s){ .raw = {
                                            { m->a1, m->a2, m->a3, m->a4 },
                                            { m->b1, m->b2, m->b3, m->b4 },
                                            { m->c1, m->c2, m->c3, m->c4 },
                                            { m->d1, m->d2, m->d3, m->d4 },
                                        } });
}

/* Appends the children of nodes[index] to the list. */
static enum status add_children(struct model_import *import, uint32_t index, uint32_t *room)
{
    const struct model_node parent = import->nodes[index];
    for (uint32_t i = 0; i < parent.node->mNumChildren; i++) {
        const struct aiNode *child = parent.node->mChildren[i];
        if (import->node_count == MODEL_NODE_MAX) {
            log_error("%s: expected at most %d nodes", import->path, MODEL_NODE_MAX);
            return STATUS_DATA;
        }
        if (import->node_count == *room) {
            *room *= 2;
            void *grown = realloc(import->nodes, *room * sizeof(*import->nodes));
            if (!grown)
                return log_out_of_memory(import->path);
            import->nodes = grown;
        }
        mat4s local = matrix_from(&child->mTransformation);
        import->nodes[import->node_count++] = (struct model_node){
            .node = child,
            .model_from_node = glms_mat4_mul(parent.model_from_node, local),
        };
    }
    return STATUS_OK;
}

/* Lists nodes level by level, without recursion, because a file may nest them deeply. */
static enum status list_nodes(struct model_import *import)
{
    uint32_t room = 64;
    const struct aiNode *root = import->scene->mRootNode;
    import->nodes = malloc(room * sizeof(*import->nodes));
    if (!import->nodes)
        return log_out_of_memory(import->path);
    import->nodes[0] = (struct model_node){ root, matrix_from(&root->mTransformation) };
    import->node_count = 1;
    for (uint32_t i = 0; i < import->node_count; i++) {
        enum status status = add_children(import, i, &room);
        if (status != STATUS_OK)
            return status;
    }
    return STATUS_OK;
}

static enum status convert(struct model_import *import, struct model_parser *parser,
                           struct model *model, enum model_part everything_is)
{
    enum status status = list_nodes(import);
    if (status != STATUS_OK)
        return status;
    if (!model_material_read(import))
        return log_out_of_memory(import->path);
    status = model_mesh_check(import);
    if (status != STATUS_OK)
        return status;
    import->scene = model_parser_process(parser, aiProcess_Triangulate);
    if (!import->scene) {
        log_error("%s: the faces cannot be divided into triangles: %s", import->path,
                  model_parser_error(parser));
        return STATUS_DATA;
    }
    status = model_texture_load(import, &model->textures);
    if (status == STATUS_OK)
        status = model_mesh_build(import, model, everything_is);
    if (status == STATUS_OK)
        status = model_camera_read(import, model);
    if (status == STATUS_OK)
        status = model_box_read(import, model);
    return status;
}

enum status model_load(struct model *model, const char *path, enum model_part everything_is)
{
    struct model_import import = { .path = path };
    const struct model_format *format;
    *model = (struct model){ 0 };
    enum status status = check_file(path);
    if (status == STATUS_OK)
        status = model_format_find(path, &format);
    if (status != STATUS_OK)
        return status;
    import.is_gltf = format->is_gltf;
    struct model_parser *parser = model_parser_new(format->suffix, model_file_open, &import);
    status = parser ? parse(&import, parser) : log_out_of_memory(path);
    if (status == STATUS_OK)
        status = convert(&import, parser, model, everything_is);
    if (status == STATUS_OK)
        model_color_warn(&import);
    if (status != STATUS_OK)
        model_finish(model);
    model_parser_delete(parser);
    free(import.materials);
    free(import.nodes);
    return status;
}

static void renumber(struct mesh *mesh, uint32_t first_layer)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (mesh->vertices[i].material & MESH_TEXTURE_MASK)
            mesh->vertices[i].material += first_layer;
    }
}

enum status model_add_surroundings(struct model *model, struct model *other)
{
    struct texture_layers textures = { 0 };
    enum status status = model_texture_merge(&textures, &model->textures, &other->textures);
    if (status != STATUS_OK)
        goto fail;
    renumber(&other->object, model->textures.count);
    renumber(&other->surroundings, model->textures.count);
    if (!mesh_append(&other->object, &other->surroundings) ||
        !mesh_append(&model->surroundings, &other->object)) {
        status = log_out_of_memory("surroundings");
        goto fail;
    }
    free(model->textures.texels);
    model->textures = textures;
    textures.texels = NULL;
    if (other->has_box) {
        model->has_box = true;
        model->box = other->box;
    }
fail:
    free(textures.texels);
    model_finish(other);
    return status;
}

void model_finish(struct model *model)
{
    mesh_finish(&model->object);
    mesh_finish(&model->surroundings);
    free(model->objects);
    free(model->materials);
    free(model->textures.texels);
    *model = (struct model){ 0 };
}
