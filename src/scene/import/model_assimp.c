/* model_assimp.c: reads a file of .obj or .ply through assimp. */
#include "src/scene/import/model_assimp.h"
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_parser.h"

static enum status parse(struct model_assimp *assimp, struct model_parser *parser)
{
    const struct model_import *import = assimp->import;
    assimp->scene = model_parser_read(parser, import->path);
    if (import->refused[0]) {
        log_error("%s: refers to %s: expected only files within the model's folder", import->path,
                  import->refused);
        return STATUS_DATA;
    }
    if (!assimp->scene || !assimp->scene->mRootNode) {
        log_error("%s: %s", import->path,
                  assimp->scene ? "the scene is empty" : model_parser_error(parser));
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
static enum status add_children(struct model_assimp *assimp, uint32_t index, uint32_t *room)
{
    const struct model_node parent = assimp->nodes[index];
    for (uint32_t i = 0; i < parent.node->mNumChildren; i++) {
        const struct aiNode *child = parent.node->mChildren[i];
        if (assimp->node_count == MODEL_NODE_MAX) {
            log_error("%s: expected at most %d nodes", assimp->import->path, MODEL_NODE_MAX);
            return STATUS_DATA;
        }
        if (assimp->node_count == *room) {
            *room *= 2;
            void *grown = realloc(assimp->nodes, *room * sizeof(*assimp->nodes));
            if (!grown)
                return log_out_of_memory(assimp->import->path);
            assimp->nodes = grown;
        }
        mat4s local = matrix_from(&child->mTransformation);
        assimp->nodes[assimp->node_count++] = (struct model_node){
            .node = child,
            .model_from_node = glms_mat4_mul(parent.model_from_node, local),
        };
    }
    return STATUS_OK;
}

/* Lists nodes level by level, without recursion, because a file may nest them deeply. */
static enum status list_nodes(struct model_assimp *assimp)
{
    uint32_t room = 64;
    const struct aiNode *root = assimp->scene->mRootNode;
    assimp->nodes = malloc(room * sizeof(*assimp->nodes));
    if (!assimp->nodes)
        return log_out_of_memory(assimp->import->path);
    assimp->nodes[0] = (struct model_node){ root, matrix_from(&root->mTransformation) };
    assimp->node_count = 1;
    for (uint32_t i = 0; i < assimp->node_count; i++) {
        enum status status = add_children(assimp, i, &room);
        if (status != STATUS_OK)
            return status;
    }
    return STATUS_OK;
}

static enum status convert(struct model_assimp *assimp, struct model_parser *parser,
                           struct model *model, enum model_part everything_is)
{
    const char *path = assimp->import->path;
    enum status status = list_nodes(assimp);
    if (status != STATUS_OK)
        return status;
    if (!model_material_read(assimp))
        return log_out_of_memory(path);
    status = model_mesh_check(assimp);
    if (status != STATUS_OK)
        return status;
    assimp->scene = model_parser_process(parser, aiProcess_Triangulate);
    if (!assimp->scene) {
        log_error("%s: the faces cannot be divided into triangles: %s", path,
                  model_parser_error(parser));
        return STATUS_DATA;
    }
    status = model_texture_load(assimp, &model->textures);
    return status == STATUS_OK ? model_mesh_build(assimp, model, everything_is) : status;
}

/* Refuses what assimp 5.2.5 reads wrongly: of triangle strips it drops all but some triangles. */
static enum status check_ply(const char *path)
{
    static const char strips[] = "element tristrips ", end[] = "end_header";
    char line[256];
    FILE *file = fopen(path, "rb");
    bool has_strips = false;
    for (int i = 0; file && i < 1000 && fgets(line, sizeof(line), file); i++) {
        has_strips = has_strips || strncmp(line, strips, sizeof(strips) - 1) == 0;
        if (strncmp(line, end, sizeof(end) - 1) == 0)
            break;
    }
    if (file)
        fclose(file);
    if (!has_strips)
        return STATUS_OK;
    log_error("%s: holds triangle strips, which are not supported; export it with faces", path);
    return STATUS_DATA;
}

enum status model_load_assimp(struct model_import *import, const char *suffix, struct model *model,
                              enum model_part everything_is)
{
    struct model_assimp assimp = { .import = import };
    if (strcmp(suffix, "ply") == 0 && check_ply(import->path) != STATUS_OK)
        return STATUS_DATA;
    struct model_parser *parser = model_parser_new(suffix, model_file_open, import);
    enum status status = parser ? parse(&assimp, parser) : log_out_of_memory(import->path);
    if (status == STATUS_OK)
        status = convert(&assimp, parser, model, everything_is);
    if (status == STATUS_OK && import->missed[0])
        log_warning("%s: refers to %s, which does not exist; its materials are left out",
                    import->path, import->missed);
    model_parser_delete(parser);
    free(assimp.materials);
    free(assimp.nodes);
    return status;
}
