/* model_pipe.c: serialises and validates models and environments: struct, arrays, end marker. */
#include "src/scene/import/model_pipe.h"
#include <cglm/struct.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/machine.h"
#include "src/file/image.h"
#include "src/scene/import/importer.h"

enum {
    MAGIC_MODEL = 0x4d4e5246,
    MAGIC_ENVIRONMENT = 0x454e5246,
    TEXEL_SIZE = 4,             /* size of an RGBA8 texel, bytes */
    ENVIRONMENT_TEXEL_SIZE = 8, /* size of an RGBA16F texel, bytes */
    HALF_MAX = 0x7bff,          /* bits of the largest finite half */
    HALF_ONE = 0x3c00,
};

struct environment_head {
    uint32_t magic;
    uint32_t width, height;
    struct environment_sun sun;
};

/* ---- checks ---- */

static bool is_bounded(vec3s v, float max)
{
    /* Comparisons with NaN are false, so NaN is rejected too. */
    return fabsf(v.x) <= max && fabsf(v.y) <= max && fabsf(v.z) <= max;
}

static bool is_in_range(float value, float min, float max)
{
    return value >= min && value <= max;
}

/* Returns true if a colour is within the limits of a reflectance (of a radiance if unlit). */
static bool is_color(vec3s c, bool is_unlit)
{
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && is_bounded(c, is_unlit ? MODEL_RADIANCE_MAX : 1);
}

/* Returns true if a fixed-size text is terminated. */
#define IS_TEXT(text) memchr(text, 0, sizeof(text))

static enum pipe_fault check_vertex(const struct model *model, const void *items, uint32_t i)
{
    const struct mesh_vertex *vertex = &((const struct mesh_vertex *)items)[i];
    const uint32_t known =
        MESH_TEXTURE_MASK | MESH_UNLIT | MESH_CUTOUT | MESH_SURFACE_MAX << MESH_SURFACE_SHIFT;
    if (!is_bounded(vertex->position, MODEL_COORDINATE_MAX) || !is_bounded(vertex->normal, 2) ||
        !is_color(vertex->color, vertex->material & MESH_UNLIT) || !isfinite(vertex->uv.x) ||
        !isfinite(vertex->uv.y))
        return PIPE_NUMBER;
    if (vertex->material & ~known ||
        (vertex->material & MESH_TEXTURE_MASK) > model->textures.count ||
        vertex->material >> MESH_SURFACE_SHIFT > model->material_count)
        return PIPE_MATERIAL;
    return PIPE_OK;
}

/* Checks an index, and that all corners of its triangle have the material of the first one. */
static enum pipe_fault check_index(const struct model *model, const void *items, uint32_t i)
{
    const uint32_t *indices = items;
    const struct mesh *mesh =
        indices == model->object.indices ? &model->object : &model->surroundings;
    if (indices[i] >= mesh->vertex_count)
        return PIPE_INDEX;
    const uint32_t material = mesh->vertices[indices[i - i % 3]].material;
    return mesh->vertices[indices[i]].material == material ? PIPE_OK : PIPE_MATERIAL;
}

static enum pipe_fault check_extra(const struct model *model, const void *items, uint32_t i)
{
    const struct mesh_extra *extra = &((const struct mesh_extra *)items)[i];
    (void)model;
    return is_bounded(extra->tangent, 2) && is_in_range(extra->side, -1, 1) &&
                   isfinite(extra->uv.x) && isfinite(extra->uv.y)
               ? PIPE_OK
               : PIPE_NUMBER;
}

static bool is_texture(const struct material_texture *texture, uint32_t texture_count)
{
    return texture->layer <= texture_count && texture->wrap_u < MATERIAL_WRAP_COUNT &&
           texture->wrap_v < MATERIAL_WRAP_COUNT && texture->uv_set <= 1 &&
           is_bounded(texture->u_row, FLT_MAX) && is_bounded(texture->v_row, FLT_MAX);
}

static bool is_surface(const struct material *m)
{
    return is_in_range(m->metallic, 0, 1) && is_in_range(m->alpha, 0, 1) &&
           is_in_range(m->alpha_cutoff, 0, 1) && is_color(m->emission, true) &&
           is_in_range(m->normal_scale, -MODEL_RADIANCE_MAX, MODEL_RADIANCE_MAX) &&
           is_in_range(m->occlusion_strength, 0, 1) && is_in_range(m->specular, 0, 1) &&
           is_color(m->specular_color, true) && is_in_range(m->coat, 0, 1) &&
           is_in_range(m->coat_roughness, 0, 1);
}

static bool is_material(const struct material *m)
{
    return IS_TEXT(m->name) && !(m->flags & ~(uint32_t)MATERIAL_FLAGS) &&
           is_color(m->base_color, m->flags & MATERIAL_IS_UNLIT) &&
           is_color(m->attenuation_color, false) && is_in_range(m->roughness, 0, 1) &&
           is_in_range(m->transmission, 0, 1) && m->class_id <= MATERIAL_CLASS_MAX &&
           is_in_range(m->thickness, 0, MODEL_COORDINATE_MAX) && is_in_range(m->ior, 1, 4) &&
           is_in_range(m->dispersion, 0, 10) &&
           is_in_range(m->scattering_optical_depth, 0, MATERIAL_SCATTERING_MAX) &&
           is_in_range(m->attenuation_distance, 0, FLT_MAX) && is_surface(m);
}

static enum pipe_fault check_material(const struct model *model, const void *items, uint32_t i)
{
    const struct material *material = &((const struct material *)items)[i];
    bool is_valid = is_material(material);
    for (uint32_t k = 0; k < MATERIAL_TEXTURE_COUNT; k++)
        is_valid = is_valid && is_texture(&material->textures[k], material_texture_is_color(k)
                                                                      ? model->textures.count
                                                                      : model->numbers.count);
    return is_valid ? PIPE_OK : PIPE_MATERIAL;
}

/* Checks an object. The objects need consecutive index ranges that fill the mesh. */
static enum pipe_fault check_object(const struct model *model, const void *items, uint32_t i)
{
    const struct object *object = &((const struct object *)items)[i];
    const uint32_t first = i > 0 ? object[-1].first_index + object[-1].index_count : 0;
    const uint32_t left = model->object.index_count - first;
    if (!IS_TEXT(object->name) || object->rank != 0 || object->container_rank != 0 ||
        object->enclosing_object != 0 || object->material >= model->material_count ||
        object->open_edge_count > object->index_count || object->solid_count > object->index_count)
        return PIPE_MATERIAL;
    if (object->first_index != first || object->index_count == 0 || object->index_count % 3 != 0 ||
        object->index_count > left || (i + 1 == model->object_count && object->index_count != left))
        return PIPE_INDEX;
    return PIPE_OK;
}

static bool is_box(const struct box *box)
{
    return is_bounded(box->min, MODEL_COORDINATE_MAX) &&
           is_bounded(box->max, MODEL_COORDINATE_MAX) && box->min.x < box->max.x &&
           box->min.y < box->max.y && box->min.z < box->max.z;
}

static bool is_camera(const struct camera *camera)
{
    const float max = (float)MODEL_ORIGIN_MAX;
    return is_bounded(camera->eye, max) && is_bounded(camera->up, max) &&
           is_bounded(camera->target, 8.0F * max) &&
           glms_vec3_distance(camera->eye, camera->target) > 0 && camera->fov_deg > 0 &&
           camera->fov_deg < 180 && camera->height == 0 && camera->depth == 0 &&
           camera->pixel_aspect == 0 && camera->off_center.x == 0 && camera->off_center.y == 0;
}

static enum pipe_fault check_camera(const struct model *model, const void *items, uint32_t i)
{
    const struct model_camera *camera = &((const struct model_camera *)items)[i];
    const bool is_flat = camera->kind == MODEL_ORTHOGRAPHIC;
    (void)model;
    return IS_TEXT(camera->name) && camera->kind < MODEL_CAMERA_KIND_COUNT &&
                   is_camera(&camera->camera) &&
                   is_in_range(camera->height, 0, MODEL_COORDINATE_MAX) &&
                   is_in_range(camera->aspect, 0, MODEL_COORDINATE_MAX) &&
                   is_flat == (camera->height > 0)
               ? PIPE_OK
               : PIPE_CAMERA;
}

static enum pipe_fault check_light(const struct model *model, const void *items, uint32_t i)
{
    (void)model;
    return punctual_light_is_valid(&((const struct light *)items)[i]) ? PIPE_OK : PIPE_NUMBER;
}

static enum pipe_fault check_extension(const struct model *model, const void *items, uint32_t i)
{
    const struct model_extension *extension = &((const struct model_extension *)items)[i];
    (void)model;
    return IS_TEXT(extension->name) && extension->support < MODEL_SUPPORT_COUNT ? PIPE_OK
                                                                                : PIPE_NUMBER;
}

static enum pipe_fault check_animation(const struct model *model, const void *items, uint32_t i)
{
    const struct model_animation *animation = &((const struct model_animation *)items)[i];
    (void)model;
    return IS_TEXT(animation->name) && is_in_range(animation->seconds, 0, (float)MODEL_SECONDS_MAX)
               ? PIPE_OK
               : PIPE_NUMBER;
}

/* Checks the first vertex of a surroundings object. First vertices must strictly ascend. */
static enum pipe_fault check_start(const struct model *model, const void *items, uint32_t i)
{
    const uint32_t *start = &((const uint32_t *)items)[i];
    return *start < model->surroundings.vertex_count && (i == 0 || *start > start[-1]) ? PIPE_OK
                                                                                       : PIPE_INDEX;
}

static enum pipe_fault check_name(const struct model *model, const void *items, uint32_t i)
{
    const char *name = (const char *)items + (size_t)i * MATERIAL_NAME_SIZE;
    (void)model;
    return memchr(name, 0, MATERIAL_NAME_SIZE) ? PIPE_OK : PIPE_MATERIAL;
}

static bool are_undrawn_bits_valid(uint32_t bits)
{
    for (uint32_t i = 0; i < 32; i++) {
        if (bits & 1u << i && !model_undrawn_name(i))
            return false;
    }
    return true;
}

/* ---- arrays ---- */

/* Array of struct model, which is sent after the struct. */
struct array {
    size_t items, count; /* offsets of the pointer and of the number of elements */
    size_t size;         /* of an element, bytes; 0 for the texels of struct texture_layers */
    uint32_t count_max;
    /* Checks an element; preceding arrays are already checked. NULL if any bytes are valid. */
    enum pipe_fault (*check)(const struct model *model, const void *items, uint32_t i);
    uint32_t row;     /* the allocation is zero-padded to a multiple of it */
    bool is_optional; /* no elements if the pointer is NULL */
};

#define ARRAY(items, count) \
    offsetof(struct model, items), offsetof(struct model, count), \
        sizeof(*((const struct model *)NULL)->items)
#define LAYERS(member) \
    offsetof(struct model, member), \
        offsetof(struct model, member) + offsetof(struct texture_layers, count), 0

static const struct array arrays[] = {
    { ARRAY(object.vertices, object.vertex_count), MODEL_ELEMENT_MAX, check_vertex, 1, false },
    { ARRAY(object.indices, object.index_count), MODEL_ELEMENT_MAX, check_index, 1, false },
    { ARRAY(object.extras, object.vertex_count), MODEL_ELEMENT_MAX, check_extra, 1, true },
    { ARRAY(surroundings.vertices, surroundings.vertex_count), MODEL_ELEMENT_MAX, check_vertex, 1,
      false },
    { ARRAY(surroundings.indices, surroundings.index_count), MODEL_ELEMENT_MAX, check_index, 1,
      false },
    { ARRAY(surroundings.extras, surroundings.vertex_count), MODEL_ELEMENT_MAX, check_extra, 1,
      true },
    { ARRAY(materials, material_count), MESH_SURFACE_MAX, check_material, 1, false },
    { ARRAY(objects, object_count), MODEL_ELEMENT_MAX, check_object, 1, false },
    { ARRAY(cameras, camera_count), MODEL_CAMERA_MAX, check_camera, 1, false },
    { ARRAY(lights, light_count), MODEL_LIGHT_MAX, check_light, 1, false },
    { ARRAY(extensions, extension_count), MODEL_EXTENSION_MAX, check_extension, 1, false },
    { ARRAY(animations, animation_count), MODEL_ANIMATION_MAX, check_animation, 1, false },
    { ARRAY(surroundings_starts, surroundings_object_count), MODEL_ELEMENT_MAX, check_start,
      MODEL_SURROUNDINGS_ROW, false },
    { ARRAY(surroundings_names, surroundings_object_count), MODEL_ELEMENT_MAX, check_name,
      MODEL_SURROUNDINGS_ROW, false },
    { LAYERS(textures), MODEL_TEXTURE_MAX, NULL, 1, false },
    { LAYERS(numbers), MODEL_TEXTURE_MAX, NULL, 1, false },
};

enum {
    ARRAY_COUNT = sizeof(arrays) / sizeof(arrays[0])
};

_Static_assert(offsetof(struct texture_layers, texels) == 0, "an array begins with its pointer");
_Static_assert(sizeof(struct model) == 1360, "every pointer needs a row in `arrays`");

static void *items_of(const struct array *array, const struct model *model)
{
    void *items;
    memcpy(&items, (const char *)model + array->items, sizeof(items));
    return items;
}

static void set_items(const struct array *array, struct model *model, void *items)
{
    memcpy((char *)model + array->items, &items, sizeof(items));
}

static uint32_t count_of(const struct array *array, const struct model *model)
{
    uint32_t count;
    memcpy(&count, (const char *)model + array->count, sizeof(count));
    return array->is_optional && !items_of(array, model) ? 0 : count;
}

static size_t element_size(const struct array *array, const struct model *model)
{
    struct texture_layers layers;
    if (array->size > 0)
        return array->size;
    memcpy(&layers, (const char *)model + array->items, sizeof(layers));
    return (size_t)layers.size * layers.size * TEXEL_SIZE;
}

/* ---- models ---- */

bool model_pipe_write_model(const struct pipe_sink *sink, const struct model *model)
{
    const uint32_t magic = MAGIC_MODEL;
    bool done = pipe_write(sink, &magic, sizeof(magic)) && pipe_write(sink, model, sizeof(*model));
    for (size_t i = 0; i < ARRAY_COUNT && done; i++)
        done = pipe_write(sink, items_of(&arrays[i], model),
                          count_of(&arrays[i], model) * element_size(&arrays[i], model));
    return done && pipe_write_end(sink);
}

/* Returns true if both counts are zero or both positive, and the indices are of triangles. */
static bool is_mesh(const struct mesh *mesh)
{
    return mesh->index_count % 3 == 0 && (mesh->vertex_count > 0) == (mesh->index_count > 0);
}

static bool are_layers(const struct texture_layers *layers)
{
    const uint32_t side = layers->size;
    return layers->count <= MODEL_TEXTURE_MAX && side <= MODEL_TEXTURE_SIDE_MAX &&
           (side & (side - 1)) == 0 && (side > 0) == (layers->count > 0) &&
           (uint64_t)side * side * TEXEL_SIZE * layers->count <= MODEL_TEXTURES_SIZE_MAX;
}

static enum pipe_fault check_sizes(const struct pipe_source *source, const struct model *head)
{
    uint64_t size = 0;
    if (!is_mesh(&head->object) || !is_mesh(&head->surroundings) ||
        (head->object.index_count == 0 && head->surroundings.index_count == 0) ||
        !are_layers(&head->textures) || !are_layers(&head->numbers) ||
        head->object_count > head->object.index_count / 3 ||
        head->surroundings_object_count > head->surroundings.vertex_count ||
        head->animation > head->animation_count)
        return PIPE_SIZE;
    for (size_t i = 0; i < ARRAY_COUNT; i++) {
        const uint32_t count = count_of(&arrays[i], head);
        if (count > arrays[i].count_max)
            return PIPE_SIZE;
        size += count * (uint64_t)element_size(&arrays[i], head);
    }
    return size <= source->size_max ? PIPE_OK : PIPE_SIZE;
}

/* Checks the members of a received struct that are no arrays. */
static enum pipe_fault check_head(const struct model *head)
{
    for (int k = 0; k < 3; k++) {
        if (!(fabs(head->origin[k]) <= MODEL_ORIGIN_MAX))
            return PIPE_CAMERA;
    }
    if (!pipe_is_bool(&head->has_camera) || !pipe_is_bool(&head->has_box) ||
        !pipe_is_bool(&head->has_ior) || (head->has_box && !is_box(&head->box)) ||
        (head->has_ior && !is_in_range(head->ior, 1, 4)) ||
        (head->has_camera && !is_camera(&head->camera)) ||
        !is_in_range(head->camera_aspect, 0, MODEL_COORDINATE_MAX))
        return PIPE_CAMERA;
    if (!are_undrawn_bits_valid(head->undrawn) || !IS_TEXT(head->undrawn_text))
        return PIPE_NUMBER;
    return head->object_count == 0 && head->object.index_count > 0 ? PIPE_INDEX : PIPE_OK;
}

static enum pipe_fault read_array(const struct pipe_source *source, const struct array *array,
                                  uint32_t count, struct model *model)
{
    const size_t size = element_size(array, model);
    if (count == 0)
        return PIPE_OK;
    void *items = calloc((count - 1) / array->row + 1, array->row * size);
    if (!items)
        return PIPE_MEMORY;
    machine_advise_allocation(items, count * size);
    set_items(array, model, items);
    enum pipe_fault fault = pipe_read(source, items, count * size);
    for (uint32_t i = 0; fault == PIPE_OK && array->check && i < count; i++)
        fault = array->check(model, items, i);
    return fault;
}

bool model_copy(struct model *to, const struct model *from)
{
    bool done = true;
    *to = *from;
    for (size_t i = 0; i < ARRAY_COUNT; i++)
        set_items(&arrays[i], to, NULL);
    for (size_t i = 0; i < ARRAY_COUNT && done; i++) {
        const struct array *array = &arrays[i];
        const size_t size = element_size(array, from);
        const uint32_t count = count_of(array, from);
        void *items = count ? calloc((count - 1) / array->row + 1, array->row * size) : NULL;
        done = !count || items;
        if (items)
            memcpy(items, items_of(array, from), count * size);
        set_items(array, to, items);
    }
    if (!done)
        model_finish(to);
    return done;
}

/* Reads a model. The received pointers are only compared with NULL. */
enum pipe_fault model_pipe_read_model(const struct pipe_source *source, struct model *model)
{
    uint32_t magic;
    struct model head;
    *model = (struct model){ 0 };
    enum pipe_fault fault = pipe_read(source, &magic, sizeof(magic));
    if (fault == PIPE_OK && magic != MAGIC_MODEL)
        fault = PIPE_HEAD;
    if (fault == PIPE_OK)
        fault = pipe_read(source, &head, sizeof(head));
    if (fault == PIPE_OK)
        fault = check_sizes(source, &head);
    if (fault == PIPE_OK)
        fault = check_head(&head);
    if (fault != PIPE_OK)
        return fault;
    *model = head;
    for (size_t i = 0; i < ARRAY_COUNT; i++)
        set_items(&arrays[i], model, NULL);
    for (size_t i = 0; i < ARRAY_COUNT && fault == PIPE_OK; i++)
        fault = read_array(source, &arrays[i], count_of(&arrays[i], &head), model);
    if (fault == PIPE_OK)
        fault = pipe_read_end(source);
    if (fault != PIPE_OK)
        model_finish(model);
    return fault;
}

/* ---- environments ---- */

static size_t environment_size(uint32_t width, uint32_t height)
{
    return (size_t)width * height * ENVIRONMENT_TEXEL_SIZE;
}

bool model_pipe_write_environment(const struct pipe_sink *sink,
                                  const struct environment *environment)
{
    const struct environment_head head = {
        .magic = MAGIC_ENVIRONMENT,
        .width = environment->width,
        .height = environment->height,
        .sun = environment->sun,
    };
    return pipe_write(sink, &head, sizeof(head)) &&
           pipe_write(sink, environment->texels,
                      environment_size(environment->width, environment->height)) &&
           pipe_write_end(sink);
}

static enum pipe_fault read_texels(const struct pipe_source *source,
                                   struct environment *environment, size_t size)
{
    environment->texels = malloc(size);
    if (!environment->texels)
        return PIPE_MEMORY;
    enum pipe_fault fault = pipe_read(source, environment->texels, size);
    for (size_t i = 0; fault == PIPE_OK && i < size / sizeof(uint16_t); i += 4) {
        const uint16_t *texel = &environment->texels[i];
        const bool has_alpha = environment->is_cube ? texel[3] <= HALF_MAX : texel[3] == HALF_ONE;
        if (texel[0] > HALF_MAX || texel[1] > HALF_MAX || texel[2] > HALF_MAX || !has_alpha)
            fault = PIPE_TEXEL;
    }
    return fault;
}

/* Returns true if the sun's radiance is valid and its direction is bounded (it may be zero). */
static bool is_sun(const struct environment_sun *sun)
{
    const vec3s light = sun->light;
    return light.x >= 0 && light.y >= 0 && light.z >= 0 && is_bounded(light, ENVIRONMENT_SUN_MAX) &&
           is_bounded(sun->dir, 1.001f);
}

enum pipe_fault model_pipe_read_environment(const struct pipe_source *source,
                                            struct environment *environment)
{
    struct environment_head head;
    *environment = (struct environment){ 0 };
    enum pipe_fault fault = pipe_read(source, &head, sizeof(head));
    if (fault != PIPE_OK)
        return fault;
    if (head.magic != MAGIC_ENVIRONMENT)
        return PIPE_HEAD;
    if (head.width < 1 || head.width > IMAGE_MAX_SIDE || head.height < 1 ||
        head.height > IMAGE_MAX_SIDE || head.width > IMAGE_MAX_TEXELS / head.height ||
        environment_size(head.width, head.height) > source->size_max ||
        (head.height > head.width && head.height != 6 * (uint64_t)head.width))
        return PIPE_SIZE;
    if (!is_sun(&head.sun))
        return PIPE_HEAD;
    environment->width = head.width;
    environment->height = head.height;
    environment->is_cube = head.height > head.width;
    environment->sun = head.sun;
    fault = read_texels(source, environment, environment_size(head.width, head.height));
    if (fault == PIPE_OK)
        fault = pipe_read_end(source);
    if (fault != PIPE_OK)
        environment_finish(environment);
    return fault;
}
