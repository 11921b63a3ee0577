/* tree.c: builds a scene's BVHs, encodes them for the GPU, and keeps the rest pose. */
#include "src/scene/tree.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "shaders/cracks.h"
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/image/half.h"
#include "src/scene/tree_horizon.h"
#include "src/scene/tree_nodes.h"
#include "src/scene/tree_shape.h"

/* Growth of SAH cost at which a deformed BVH is rebuilt. The limit of a whole part is lower,
 * because all rays traverse it. */
static const double object_growth_max = 1.5, part_growth_max = 1.1;

static uint32_t bits(float x)
{
    uint32_t word;
    memcpy(&word, &x, sizeof(word));
    return word;
}

/* Allocates an array of `words->count` words, and resets the count. */
static bool reserve(struct tree_words *words)
{
    words->all = calloc(words->count + (size_t)1, sizeof(*words->all));
    words->count = 0;
    return words->all;
}

static void write_word(uint32_t to[static 4], const float *xyz, uint32_t last)
{
    for (int k = 0; k < 3; k++)
        to[k] = bits(xyz[k]);
    to[3] = last;
}

/* Writes a triangle's affine map to barycentric coordinates (shaders/tree.h). A triangle without an
 * area gets zeros, so that no ray hits it. */
static void write_triangle(struct tree_words *words, const struct tree_part *part,
                           uint32_t triangle)
{
    const float *p = tree_corner(part, triangle, 0)->position.raw;
    double sides[2][3], n[3], square = 0.0;
    for (int k = 0; k < 3; k++) {
        sides[0][k] = (double)tree_corner(part, triangle, 1)->position.raw[k] - (double)p[k];
        sides[1][k] = (double)tree_corner(part, triangle, 2)->position.raw[k] - (double)p[k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = sides[0][i] * sides[1][j] - sides[0][j] * sides[1][i];
        square += n[k] * n[k];
    }
    const double inverse = square > 0.0 ? 1.0 / square : 0.0;
    for (int row = 0; row < TREE_TRIANGLE_WORDS; row++) {
        double x[3], at = 0.0;
        for (int k = 0; k < 3; k++) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            x[k] = row == 0   ? (sides[1][i] * n[j] - sides[1][j] * n[i]) * inverse
                   : row == 1 ? (n[i] * sides[0][j] - n[j] * sides[0][i]) * inverse
                              : n[k] * sqrt(inverse);
            at -= x[k] * (double)p[k];
        }
        const float xyz[3] = { (float)x[0], (float)x[1], (float)x[2] };
        write_word(words->all[words->count++], xyz, bits((float)at));
    }
}

static void write_bubble(struct tree_words *words, const struct bubble *bubble)
{
    static const float zero[3] = { 0 };
    write_word(words->all[words->count++], bubble->center.raw, bits(bubble->stretch));
    write_word(words->all[words->count++], bubble->axis.raw,
               bits(bubble->is_capsule ? 1.0f : 0.0f));
    write_word(words->all[words->count++], zero, bits(bubble->radius));
}

/* Returns the gap width of a crack at a corner, as a half float in the upper 16 bits. */
static uint32_t gap_bits(const struct tree_part *part, uint32_t triangle, uint32_t corner)
{
    const float open = CRACKS_OPEN_OF(tree_corner(part, triangle, corner)->color);
    return (uint32_t)half_from_float(open) << 16;
}

/* Returns an object's rank (medium priority) plus TREE_NUMBER times its object number. */
static uint32_t rank_bits(const struct tree_part *part, uint32_t triangle)
{
    const struct model *model = part->model;
    if (!part->is_object)
        return 0;
    if (model->object_count < 2)
        return 1 + TREE_NUMBER;
    const struct object *object =
        object_of_index(model->objects, model->object_count, triangle * 3);
    return object->rank + TREE_NUMBER * (uint32_t)(object - model->objects + 1);
}

/* Returns the material of an object's triangle, or NULL if the settings define it. */
static const struct material *material_of(const struct tree_part *part, uint32_t triangle)
{
    const struct model *model = part->model;
    if (!part->is_object || !model->object_count || !model->material_count)
        return NULL;
    const struct object *object =
        object_of_index(model->objects, model->object_count, triangle * 3);
    const struct material *material = &model->materials[object->material];
    return material->flags & MATERIAL_IS_BARE ? NULL : material;
}

/* Returns a triangle's material bits. Options may replace the vertices' material. */
static uint32_t material_bits(const struct tree_part *part, uint32_t triangle)
{
    const uint32_t bits = tree_corner(part, triangle, 0)->material;
    const struct material *material = material_of(part, triangle);
    if (!material)
        return bits;
    const uint32_t index = (uint32_t)(material - part->model->materials);
    return (bits & ((1u << MESH_SURFACE_SHIFT) - 1)) | (index + 1) << MESH_SURFACE_SHIFT;
}

/* Returns true if hits need vertex colours and texture coordinates: opaque surfaces, and objects
 * that are textured or not fully transmissive. */
static bool has_surface(const struct tree_part *part, uint32_t triangle)
{
    if (part->is_inclusion)
        return false;
    const struct material *material = material_of(part, triangle);
    return !part->is_object ||
           (material && (material->transmission < 1.0f || material_is_dressed(material)));
}

static void write_extras(struct tree_words *words, const struct tree_part *part, uint32_t triangle)
{
    float uv[8] = { 0.0f };
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t vertex = part->mesh->indices[(size_t)triangle * 3 + k];
        const struct mesh_extra *extra = &part->mesh->extras[vertex];
        write_word(words->all[words->count++], extra->tangent.raw, bits(extra->side));
        memcpy(&uv[2 * (size_t)k], extra->uv.raw, 2 * sizeof(*uv));
    }
    write_word(words->all[words->count++], &uv[0], bits(uv[3]));
    write_word(words->all[words->count++], &uv[4], 0);
}

/* Returns the object number of a triangle of the surroundings. */
static uint32_t object_number(const struct tree_part *part, uint32_t triangle)
{
    const struct model *model = part->model;
    return model->object_count + 1 +
           model_opaque_find(model, part->mesh->indices[(size_t)triangle * 3]);
}

static void write_surface(struct tree_words *words, const struct tree_part *part, uint32_t triangle)
{
    const uint32_t number = part->is_object ? 0 : object_number(part, triangle);
    float uv[6];
    for (uint32_t k = 0; k < 3; k++)
        memcpy(&uv[2 * (size_t)k], tree_corner(part, triangle, k)->uv.raw, 2 * sizeof(*uv));
    for (uint32_t k = 0; k < 3; k++)
        write_word(words->all[words->count++], tree_corner(part, triangle, k)->color.raw,
                   bits(uv[k]));
    write_word(words->all[words->count++], &uv[3], number * 2 + (part->mesh->extras ? 1 : 0));
    if (part->mesh->extras)
        write_extras(words, part, triangle);
}

static void count_words(struct tree *tree, const struct tree_part *part,
                        const struct tree_shape *shape)
{
    uint32_t surfaces = 0;
    for (uint32_t i = 0; i < part->count; i++)
        surfaces += has_surface(part, part->triangles[i]);
    tree->triangle_count += part->count;
    tree->nodes.count += part->count ? tree_nodes_count(shape) : 0;
    tree->triangles.count += part->count * TREE_TRIANGLE_WORDS;
    tree->corners.count += part->count * TREE_CORNER_WORDS + surfaces * TREE_SURFACE_WORDS;
    if (surfaces && part->mesh->extras)
        tree->corners.count += surfaces * TREE_EXTRA_WORDS;
}

/* Writes a part's triangles and nodes. Colours and uv follow the corners of all parts. */
static void write_part(struct tree *tree, uint32_t index, const struct tree_part *part,
                       const struct tree_shape *shape)
{
    const uint32_t first = tree->triangles.count / TREE_TRIANGLE_WORDS;
    size_t word = (size_t)first * TREE_CORNER_WORDS;
    tree->roots[index] = TREE_NOTHING;
    for (uint32_t i = 0; i < part->count; i++) {
        const uint32_t triangle = part->triangles[shape->draft.order[i]];
        if (tree_bubble(part, triangle)) {
            write_bubble(&tree->triangles, tree_bubble(part, triangle));
            word += TREE_CORNER_WORDS;
            continue;
        }
        const bool is_shaded = has_surface(part, triangle);
        const uint32_t horizon = shape->horizons ? shape->horizons[i] : TREE_HORIZON_UNKNOWN;
        const uint32_t last[3] = { rank_bits(part, triangle), material_bits(part, triangle),
                                   (is_shaded ? tree->corners.count : 0) |
                                       horizon << TREE_HORIZON_SHIFT };
        write_triangle(&tree->triangles, part, triangle);
        for (uint32_t k = 0; k < 3; k++)
            write_word(tree->corners.all[word++], tree_corner(part, triangle, k)->normal.raw,
                       part->is_inclusion ? gap_bits(part, triangle, k) : last[k]);
        if (is_shaded)
            write_surface(&tree->corners, part, triangle);
    }
    if (part->count)
        tree->roots[index] =
            tree_nodes_lay(tree, shape, first, part->is_object && part->model->object_count < 2);
}

static uint32_t media_words(const struct tree *tree)
{
    return tree->shells > TREE_SHELLS_FEW ? tree->shells + 1 : 0;
}

/* Writes the medium index of each rank, one per material. Returns false when out of memory. */
static bool write_media(struct tree *tree, const struct model *model)
{
    uint32_t count = 0;
    uint32_t *media = calloc(model->material_count + (size_t)1, sizeof(*media));
    tree->media = tree->corners.count;
    tree->corners.count += media_words(tree);
    for (uint32_t i = 0; media && i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        uint32_t *medium = &media[object->material];
        *medium = *medium ? *medium : ++count;
        tree->corners.all[tree->media + object->rank][0] = *medium;
    }
    free(media);
    tree->medium_count = count;
    return media;
}

/* Builds the BVHs of all parts. Those of poses are refitted from the rest pose; inclusions are
 * always rebuilt, since each pose has its own. */
static bool build_parts(struct tree_shape *shapes, const struct tree_part *parts,
                        const struct tree_params *params, struct tree_work *work)
{
    struct tree_rest *rest = params->rest;
    struct tree_part rest_parts[TREE_PART_COUNT] = { 0 };
    const bool is_posed = rest && rest->is_known;
    bool done = true;
    if (is_posed) {
        const struct tree_params at_rest = { .model = &rest->model, .sorted = rest->sorted };
        done = tree_parts_init(rest_parts, &at_rest, rest->by_objects);
    }
    for (uint32_t i = 0; i < TREE_PART_COUNT && done; i++) {
        struct tree_shape *at_rest = is_posed && i != TREE_INCLUSIONS ? &rest->shapes[i] : NULL;
        work->is_cached = params->is_cached && i != TREE_INCLUSIONS;
        if (at_rest && !at_rest->draft.nodes)
            done = tree_shape_make(at_rest, &rest_parts[i], work) && tree_shape_pack(at_rest);
        work->is_cached = work->is_cached && !is_posed;
        if (done && at_rest)
            done = tree_shape_pose(&shapes[i], &parts[i], at_rest, &rest_parts[i], work);
        else if (done)
            done = tree_shape_make(&shapes[i], &parts[i], work);
    }
    tree_parts_finish(rest_parts);
    return done;
}

static bool write_all(struct tree *tree, const struct tree_part *parts,
                      const struct tree_shape *shapes)
{
    for (uint32_t i = 0; i < TREE_PART_COUNT; i++)
        count_words(tree, &parts[i], &shapes[i]);
    const struct tree_shape *objects = &shapes[TREE_OBJECTS];
    tree->corners.count += media_words(tree) + (tree_has_grid(tree, objects) ? TREE_GRID_WORDS : 0);
    if (!reserve(&tree->nodes) || !reserve(&tree->triangles) || !reserve(&tree->corners))
        return false;
    tree->corners.count = tree->triangle_count * TREE_CORNER_WORDS;
    for (uint32_t i = 0; i < TREE_PART_COUNT; i++)
        write_part(tree, i, &parts[i], &shapes[i]);
    if (tree_has_grid(tree, objects))
        tree_grid_lay(tree, objects, &parts[TREE_OBJECTS]);
    for (uint32_t i = 0; i < TREE_PART_COUNT; i++)
        tree->costs[i] = parts[i].count ? tree_cost(&shapes[i].draft, shapes[i].root) : 0.0;
    return !media_words(tree) || write_media(tree, parts[TREE_OBJECTS].model);
}

/* Moves the topologies of the rest pose to `rest`, for its later poses. */
static bool keep_topologies(struct tree_rest *rest, struct tree_shape *shapes)
{
    bool done = true;
    for (uint32_t i = 0; i < TREE_PART_COUNT && i != TREE_INCLUSIONS && done; i++) {
        tree_shape_finish(&rest->shapes[i]); /* topology of an earlier tree_init() */
        rest->shapes[i] = shapes[i];
        shapes[i] = (struct tree_shape){ 0 };
        done = tree_shape_pack(&rest->shapes[i]);
    }
    return done;
}

/* Returns true, and logs an error, if the scene exceeds the limits of ray tracing. */
static bool is_too_large(const struct model *model)
{
    const uint64_t count =
        ((uint64_t)model->object.index_count + model->surroundings.index_count) / 3;
    if (count > TREE_TRIANGLES_MAX)
        log_error("--refraction trace: the scene has %llu triangles, at most %u can be traced: "
                  "choose a simpler model or another refraction model",
                  (unsigned long long)count, TREE_TRIANGLES_MAX);
    else if (model->object_count > TREE_SHELLS_MAX)
        log_error("--refraction trace: the scene has %u refractive objects, at most %d can be "
                  "traced: make some opaque by --material, or use --refraction bounce",
                  model->object_count, TREE_SHELLS_MAX);
    return count > TREE_TRIANGLES_MAX || model->object_count > TREE_SHELLS_MAX;
}

/* Builds and encodes all BVHs. Returns false when out of memory. */
static bool build(struct tree *tree, const struct tree_params *params)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const bool by_objects = params->rest && params->rest->by_objects;
    struct tree_work work = { .threads = params->threads ? params->threads
                                         : cores > 0     ? (uint32_t)cores
                                                         : 1,
                              .growth_max = by_objects ? object_growth_max : part_growth_max };
    struct tree_part parts[TREE_PART_COUNT] = { 0 };
    struct tree_shape shapes[TREE_PART_COUNT] = { 0 };
    bool done =
        tree_parts_init(parts, params, by_objects) && build_parts(shapes, parts, params, &work);
    if (done && !by_objects)
        shapes[TREE_OBJECTS].horizons =
            tree_horizons(&shapes[TREE_OBJECTS], &parts[TREE_OBJECTS], work.threads);
    done = done && write_all(tree, parts, shapes);
    if (done && params->rest && !params->rest->is_known)
        done = keep_topologies(params->rest, shapes);
    tree->is_closed = done && tree_part_is_closed(&parts[TREE_OBJECTS]);
    tree->is_apart = done && tree_parts_are_apart(parts, false);
    tree->is_apart_turning = done && tree_parts_are_apart(parts, true);
    tree->built = work.built;
    tree->shared = work.shared;
    tree->fitted = work.fitted;
    tree->read = work.read;
    for (int i = 0; i < TREE_PART_COUNT; i++)
        tree_shape_finish(&shapes[i]);
    tree_parts_finish(parts);
    return done;
}

enum status tree_init(struct tree *tree, const struct tree_params *params)
{
    const double start = clock_ms();
    const struct model *model = params->model;
    *tree = (struct tree){ .shells = model->object_count ? model->object_count : 1 };
    if (is_too_large(model)) {
        *tree = (struct tree){ 0 };
        return STATUS_DATA;
    }
    if (!build(tree, params)) {
        tree_finish(tree);
        return log_out_of_memory("the scene's triangles");
    }
    if (tree->medium_count > TREE_MEDIA_MAX) {
        log_error(
            "--refraction trace: the scene's refractive objects have %u materials, at most %d "
            "can be traced: use fewer, or another refraction model",
            tree->medium_count, TREE_MEDIA_MAX);
        tree_finish(tree);
        return STATUS_DATA;
    }
    tree->ms = clock_ms() - start;
    return STATUS_OK;
}

struct tree_rest *tree_rest_create(bool by_objects)
{
    struct tree_rest *rest = calloc(1, sizeof(*rest));
    if (!rest)
        return NULL;
    rest->by_objects = by_objects;
    rest->shapes = calloc(TREE_PART_COUNT, sizeof(*rest->shapes));
    if (rest->shapes)
        return rest;
    free(rest);
    return NULL;
}

void tree_rest_take(struct tree_rest *rest, struct model *model, struct mesh_order *sorted)
{
    if (rest->is_known)
        return;
    rest->is_known = true;
    rest->sorted = *sorted;
    rest->model = (struct model){
        .object = model->object,
        .surroundings = model->surroundings,
        .objects = model->objects,
        .object_count = model->object_count,
        .opaque_starts = model->opaque_starts,
        .opaque_count = model->opaque_count,
    };
    model->object = (struct mesh){ 0 };
    model->surroundings = (struct mesh){ 0 };
    model->objects = NULL;
    model->object_count = 0;
    model->opaque_starts = NULL;
    *sorted = (struct mesh_order){ 0 };
}

void tree_rest_destroy(struct tree_rest *rest)
{
    if (!rest)
        return;
    for (uint32_t i = 0; i < TREE_PART_COUNT; i++)
        tree_shape_finish(&rest->shapes[i]);
    model_finish(&rest->model);
    free(rest->sorted.all);
    free(rest->shapes);
    free(rest);
}

void tree_finish(struct tree *tree)
{
    free(tree->nodes.all);
    free(tree->triangles.all);
    free(tree->corners.all);
    *tree = (struct tree){ 0 };
}

uint32_t tree_node_count(const struct tree *tree)
{
    uint32_t count = tree->nodes.count / TREE_NODE_WORDS;
    for (uint32_t i = 0; i < TREE_PART_COUNT && count; i++)
        count -= tree->roots[i] != TREE_NOTHING; /* its grid takes a node */
    return count;
}

uint32_t tree_words_most(const struct tree *tree)
{
    const uint32_t first =
        tree->nodes.count > tree->triangles.count ? tree->nodes.count : tree->triangles.count;
    return first > tree->corners.count ? first : tree->corners.count;
}

size_t tree_size(const struct tree *tree)
{
    return ((size_t)tree->nodes.count + tree->triangles.count + tree->corners.count) *
           sizeof(*tree->nodes.all);
}
