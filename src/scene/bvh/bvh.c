/* bvh.c: builds and encodes a scene's BVHs for the GPU, and stores the rest pose for refitting. */
#include "src/scene/bvh/bvh.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/inclusions/cracks.h"
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/base/parallel.h"
#include "src/file/half_float.h"
#include "src/scene/bvh/bvh_node_encoding.h"
#include "src/scene/bvh/bvh_two_level.h"

/* Maximum growth of a BVH's SAH cost by deformation, as a factor, before the BVH is rebuilt. The
 * BVH of a whole scene part has the lower limit, because all rays traverse it. */
static const double object_growth_max = 1.5, part_growth_max = 1.1;

static uint32_t bits(float x)
{
    uint32_t word;
    memcpy(&word, &x, sizeof(word));
    return word;
}

/* Allocates words->count 16-byte words, and resets the count to 0. */
static bool reserve(struct bvh_words *words)
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

/* Writes a triangle's affine map to barycentric coordinates (shaders/trace/bvh_layout.h).
 * Degenerate triangles get zeros, so that no ray hits them. */
static void write_triangle(struct bvh_words *words, const struct bvh_part *part, uint32_t triangle)
{
    const float *p = bvh_corner(part, triangle, 0)->position.raw;
    double sides[2][3], n[3], square = 0.0;
    for (int k = 0; k < 3; k++) {
        sides[0][k] = (double)bvh_corner(part, triangle, 1)->position.raw[k] - (double)p[k];
        sides[1][k] = (double)bvh_corner(part, triangle, 2)->position.raw[k] - (double)p[k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = sides[0][i] * sides[1][j] - sides[0][j] * sides[1][i];
        square += n[k] * n[k];
    }
    const double inverse = square > 0.0 ? 1.0 / square : 0.0;
    for (int row = 0; row < BVH_TRIANGLE_WORDS; row++) {
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

static void write_bubble(struct bvh_words *words, const struct bubble *bubble)
{
    static const float zero[3] = { 0 };
    write_word(words->all[words->count++], bubble->center.raw, bits(bubble->stretch));
    write_word(words->all[words->count++], bubble->axis.raw,
               bits(bubble->is_capsule ? 1.0f : 0.0f));
    write_word(words->all[words->count++], zero, bits(bubble->radius));
}

/* Returns the gap width of a crack at a triangle corner, as a half float in the upper 16 bits. */
static uint32_t gap_bits(const struct bvh_part *part, uint32_t triangle, uint32_t corner)
{
    const float open = CRACKS_SQUARED_GAP(bvh_corner(part, triangle, corner)->color);
    return (uint32_t)half_from_float(open) << 16;
}

/* Packs rank (medium priority) and number of a triangle's object. Returns 0 without an object. */
static uint32_t rank_bits(const struct bvh_part *part, uint32_t triangle)
{
    const struct model *model = part->model;
    if (!part->is_object)
        return 0;
    if (model->object_count < 2)
        return 1 + BVH_OBJECT_NUMBER;
    const struct object *object =
        object_of_index(model->objects, model->object_count, triangle * 3);
    return object->rank + BVH_OBJECT_NUMBER * (uint32_t)(object - model->objects + 1);
}

/* Returns the material of a triangle's object, or of the triangle if the object has several.
 * Returns NULL if the settings define the material. */
static const struct material *material_of(const struct bvh_part *part, uint32_t triangle)
{
    const struct model *model = part->model;
    if (!part->is_object || !model->object_count || !model->material_count)
        return NULL;
    const struct object *object =
        object_of_index(model->objects, model->object_count, triangle * 3);
    const struct material *material = &model->materials[object->material];
    const uint32_t own = bvh_corner(part, triangle, 0)->material >> MESH_SURFACE_SHIFT;
    if (material->flags & MATERIAL_IS_PARTIAL && own)
        material = &model->materials[own - 1];
    return material->flags & MATERIAL_FROM_SETTINGS ? NULL : material;
}

/* Returns BVH_CONTACT, perhaps with BVH_CONTACT_THIN, if the triangle is at a contact, else 0. */
static uint32_t contact_bits(const struct bvh_part *part, uint32_t triangle)
{
    const struct material *material = material_of(part, triangle);
    if (!part->contacts || !coincident_shells_has(part->contacts, triangle))
        return 0;
    return material && !(material->thickness > 0.0f) ? BVH_CONTACT | BVH_CONTACT_THIN : BVH_CONTACT;
}

/* Returns a triangle's material bits (mesh_layout.h). The material index is the object's. */
static uint32_t material_bits(const struct bvh_part *part, uint32_t triangle)
{
    const uint32_t bits = bvh_corner(part, triangle, 0)->material;
    const struct material *material = material_of(part, triangle);
    if (!material)
        return bits;
    const uint32_t index = (uint32_t)(material - part->model->materials);
    return (bits & ((1u << MESH_SURFACE_SHIFT) - 1)) | (index + 1) << MESH_SURFACE_SHIFT;
}

/* Returns true if shading a hit on the triangle needs vertex colours and texture coordinates.
 * Surroundings need them, and objects that are textured or not fully transmissive. */
static bool has_surface(const struct bvh_part *part, uint32_t triangle)
{
    if (part->is_inclusion)
        return false;
    const struct material *material = material_of(part, triangle);
    return !part->is_object ||
           (material && (material->transmission < 1.0f || material_is_textured(material)));
}

static void write_extras(struct bvh_words *words, const struct bvh_part *part, uint32_t triangle)
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
static uint32_t object_number(const struct bvh_part *part, uint32_t triangle)
{
    const struct model *model = part->model;
    return model->object_count + 1 +
           model_surroundings_find_object(model, part->mesh->indices[(size_t)triangle * 3]);
}

static void write_surface(struct bvh_words *words, const struct bvh_part *part, uint32_t triangle)
{
    const uint32_t number = part->is_object ? 0 : object_number(part, triangle);
    float uv[6];
    for (uint32_t k = 0; k < 3; k++)
        memcpy(&uv[2 * (size_t)k], bvh_corner(part, triangle, k)->uv.raw, 2 * sizeof(*uv));
    for (uint32_t k = 0; k < 3; k++)
        write_word(words->all[words->count++], bvh_corner(part, triangle, k)->color.raw,
                   bits(uv[k]));
    write_word(words->all[words->count++], &uv[3], number * 2 + (part->mesh->extras ? 1 : 0));
    if (part->mesh->extras)
        write_extras(words, part, triangle);
}

static void count_words(struct bvh *bvh, const struct bvh_part *part,
                        const struct bvh_two_level *hierarchy)
{
    uint32_t surfaces = 0;
    for (uint32_t i = 0; i < part->count; i++)
        surfaces += has_surface(part, part->triangles[i]);
    bvh->triangle_count += part->count;
    bvh->nodes.count += part->count ? bvh_nodes_word_count(hierarchy) : 0;
    bvh->triangles.count += part->count * BVH_TRIANGLE_WORDS;
    bvh->corners.count += part->count * BVH_CORNER_WORDS + surfaces * BVH_SURFACE_WORDS;
    if (surfaces && part->mesh->extras)
        bvh->corners.count += surfaces * BVH_EXTRA_WORDS;
}

/* Writes the triangles and nodes of a scene part. Vertex colours and texture coordinates follow the
 * corners of all parts in the corner array. */
static void write_part(struct bvh *bvh, uint32_t index, const struct bvh_part *part,
                       const struct bvh_two_level *hierarchy)
{
    const uint32_t first = bvh->triangles.count / BVH_TRIANGLE_WORDS;
    size_t word = (size_t)first * BVH_CORNER_WORDS;
    bvh->roots[index] = BVH_NONE;
    for (uint32_t i = 0; i < part->count; i++) {
        const uint32_t triangle = part->triangles[hierarchy->builder.order[i]];
        if (bvh_bubble(part, triangle)) {
            write_bubble(&bvh->triangles, bvh_bubble(part, triangle));
            word += BVH_CORNER_WORDS;
            continue;
        }
        const bool is_shaded = has_surface(part, triangle);
        const uint32_t last[3] = { rank_bits(part, triangle), material_bits(part, triangle),
                                   (is_shaded ? bvh->corners.count : 0) |
                                       contact_bits(part, triangle) };
        write_triangle(&bvh->triangles, part, triangle);
        for (uint32_t k = 0; k < 3; k++)
            write_word(bvh->corners.all[word++], bvh_corner(part, triangle, k)->normal.raw,
                       part->is_inclusion ? gap_bits(part, triangle, k) : last[k]);
        if (is_shaded)
            write_surface(&bvh->corners, part, triangle);
    }
    if (part->count)
        bvh->roots[index] = bvh_nodes_write(bvh, hierarchy, first,
                                            part->is_object && part->model->object_count < 2);
}

static uint32_t media_words(const struct bvh *bvh)
{
    return bvh->object_count > BVH_MASK_OBJECTS_MAX ? bvh->object_count + 1 : 0;
}

/* Fills the table that maps an object's medium priority (rank) to a medium index. Objects with one
 * material share an index. If out of memory, returns false. */
static bool write_media(struct bvh *bvh, const struct model *model)
{
    uint32_t count = 0;
    uint32_t *media = calloc(model->material_count + (size_t)1, sizeof(*media));
    bvh->media = bvh->corners.count;
    bvh->corners.count += media_words(bvh);
    for (uint32_t i = 0; media && i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        uint32_t *medium = &media[object->material];
        *medium = *medium ? *medium : ++count;
        bvh->corners.all[bvh->media + object->rank][0] = *medium;
    }
    free(media);
    bvh->medium_count = count;
    return media;
}

/* Builds the BVHs of all scene parts. If the pose is animated, builds only the BVH of the
 * inclusions (bubbles and cracks), and refits all others from the rest pose. */
static bool build_parts(struct bvh_two_level *hierarchies, const struct bvh_part *parts,
                        const struct bvh_params *params, struct bvh_build_stats *work)
{
    struct bvh_rest_pose *rest = params->rest;
    struct bvh_part rest_parts[BVH_COUNT] = { 0 };
    const bool is_posed = rest && rest->is_known;
    bool done = true;
    if (is_posed) {
        const struct bvh_params at_rest = { .model = &rest->model, .sorted = rest->sorted };
        done = bvh_parts_init(rest_parts, &at_rest, rest->by_objects);
    }
    for (uint32_t i = 0; i < BVH_COUNT && done; i++) {
        struct bvh_two_level *at_rest =
            is_posed && i != BVH_INCLUSIONS ? &rest->hierarchies[i] : NULL;
        work->is_cached = params->is_cached && i != BVH_INCLUSIONS;
        if (at_rest && !at_rest->builder.nodes)
            done =
                bvh_two_level_build(at_rest, &rest_parts[i], work) && bvh_two_level_pack(at_rest);
        work->is_cached = work->is_cached && !is_posed;
        if (done && at_rest)
            done = bvh_two_level_refit(&hierarchies[i], &parts[i], at_rest, &rest_parts[i], work);
        else if (done)
            done = bvh_two_level_build(&hierarchies[i], &parts[i], work);
    }
    bvh_parts_finish(rest_parts);
    return done;
}

static bool write_all(struct bvh *bvh, const struct bvh_part *parts,
                      const struct bvh_two_level *hierarchies)
{
    for (uint32_t i = 0; i < BVH_COUNT; i++)
        count_words(bvh, &parts[i], &hierarchies[i]);
    bvh->corners.count += media_words(bvh);
    if (!reserve(&bvh->nodes) || !reserve(&bvh->triangles) || !reserve(&bvh->corners))
        return false;
    bvh->corners.count = bvh->triangle_count * BVH_CORNER_WORDS;
    for (uint32_t i = 0; i < BVH_COUNT; i++)
        write_part(bvh, i, &parts[i], &hierarchies[i]);
    for (uint32_t i = 0; i < BVH_COUNT; i++)
        bvh->costs[i] =
            parts[i].count ? bvh_sah_cost(&hierarchies[i].builder, hierarchies[i].root) : 0.0;
    return !media_words(bvh) || write_media(bvh, parts[BVH_OBJECTS].model);
}

/* Moves the BVH topologies of the rest pose to `rest`, so that later poses can refit them. */
static bool keep_topologies(struct bvh_rest_pose *rest, struct bvh_two_level *hierarchies)
{
    bool done = true;
    for (uint32_t i = 0; i < BVH_COUNT && i != BVH_INCLUSIONS && done; i++) {
        bvh_two_level_finish(&rest->hierarchies[i]); /* frees that of an earlier bvh_init() */
        rest->hierarchies[i] = hierarchies[i];
        hierarchies[i] = (struct bvh_two_level){ 0 };
        done = bvh_two_level_pack(&rest->hierarchies[i]);
    }
    return done;
}

/* Returns true, and logs an error, if the scene exceeds the limits of ray tracing. */
static bool is_too_large(const struct model *model)
{
    const uint64_t count =
        ((uint64_t)model->object.index_count + model->surroundings.index_count) / 3;
    if (count > BVH_TRIANGLES_MAX)
        log_error("--refraction trace: the scene has %llu triangles, but at most %u can be traced: "
                  "choose a simpler model or another refraction model",
                  (unsigned long long)count, BVH_TRIANGLES_MAX);
    return count > BVH_TRIANGLES_MAX;
}

/* Builds and encodes all BVHs. Returns false when out of memory. */
static bool build(struct bvh *bvh, const struct bvh_params *params)
{
    const bool by_objects = params->rest && params->rest->by_objects;
    struct bvh_build_stats work = { .threads =
                                        params->threads ? params->threads : machine_core_count(),
                                    .cost_growth_max =
                                        by_objects ? object_growth_max : part_growth_max };
    struct bvh_part parts[BVH_COUNT] = { 0 };
    struct bvh_two_level hierarchies[BVH_COUNT] = { 0 };
    bool done =
        bvh_parts_init(parts, params, by_objects) && build_parts(hierarchies, parts, params, &work);
    done = done && write_all(bvh, parts, hierarchies);
    if (done && params->rest && !params->rest->is_known)
        done = keep_topologies(params->rest, hierarchies);
    bvh->is_closed = done && bvh_part_is_closed(&parts[BVH_OBJECTS]);
    bvh->surroundings_are_apart = done && bvh_parts_are_disjoint(parts, false);
    bvh->is_disjoint_rotating = done && bvh_parts_are_disjoint(parts, true);
    bvh->has_contacts = params->contacts && params->contacts->triangles;
    bvh->built = work.built;
    bvh->shared = work.shared;
    bvh->refitted = work.refitted;
    bvh->read = work.read;
    for (int i = 0; i < BVH_COUNT; i++)
        bvh_two_level_finish(&hierarchies[i]);
    bvh_parts_finish(parts);
    return done;
}

enum status bvh_init(struct bvh *bvh, const struct bvh_params *params)
{
    const double start = clock_ms();
    const struct model *model = params->model;
    *bvh = (struct bvh){ .object_count = model->object_count ? model->object_count : 1 };
    if (is_too_large(model)) {
        *bvh = (struct bvh){ 0 };
        return STATUS_DATA;
    }
    if (!build(bvh, params)) {
        bvh_finish(bvh);
        return log_out_of_memory("the scene's triangles");
    }
    if (bvh->medium_count > BVH_MEDIA_MAX) {
        log_error("--refraction trace: the scene's refractive objects have %u materials, but at "
                  "most %d can be traced: use fewer, or another refraction model",
                  bvh->medium_count, BVH_MEDIA_MAX);
        bvh_finish(bvh);
        return STATUS_DATA;
    }
    bvh->ms = clock_ms() - start;
    return STATUS_OK;
}

struct bvh_rest_pose *bvh_rest_pose_create(bool by_objects)
{
    struct bvh_rest_pose *rest = calloc(1, sizeof(*rest));
    if (!rest)
        return NULL;
    rest->by_objects = by_objects;
    rest->hierarchies = calloc(BVH_COUNT, sizeof(*rest->hierarchies));
    if (rest->hierarchies)
        return rest;
    free(rest);
    return NULL;
}

void bvh_rest_pose_move_from(struct bvh_rest_pose *rest, struct model *model,
                             struct mesh_order *sorted)
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
        .surroundings_starts = model->surroundings_starts,
        .surroundings_object_count = model->surroundings_object_count,
    };
    model->object = (struct mesh){ 0 };
    model->surroundings = (struct mesh){ 0 };
    model->objects = NULL;
    model->object_count = 0;
    model->surroundings_starts = NULL;
    *sorted = (struct mesh_order){ 0 };
}

void bvh_rest_pose_destroy(struct bvh_rest_pose *rest)
{
    if (!rest)
        return;
    for (uint32_t i = 0; i < BVH_COUNT; i++)
        bvh_two_level_finish(&rest->hierarchies[i]);
    model_finish(&rest->model);
    free(rest->sorted.all);
    free(rest->hierarchies);
    free(rest);
}

void bvh_finish(struct bvh *bvh)
{
    free(bvh->nodes.all);
    free(bvh->triangles.all);
    free(bvh->corners.all);
    *bvh = (struct bvh){ 0 };
}

uint32_t bvh_node_count(const struct bvh *bvh)
{
    uint32_t count = bvh->nodes.count / BVH_NODE_WORDS;
    for (uint32_t i = 0; i < BVH_COUNT && count; i++)
        count -= bvh->roots[i] != BVH_NONE; /* not a node: quantisation grid */
    return count;
}

uint32_t bvh_words_max(const struct bvh *bvh)
{
    const uint32_t first =
        bvh->nodes.count > bvh->triangles.count ? bvh->nodes.count : bvh->triangles.count;
    return first > bvh->corners.count ? first : bvh->corners.count;
}

size_t bvh_size(const struct bvh *bvh)
{
    return ((size_t)bvh->nodes.count + bvh->triangles.count + bvh->corners.count) *
           sizeof(*bvh->nodes.all);
}
