/* model_pipe.c: serialises and validates models and environments: header, arrays, end marker. */
#include "src/scene/import/model_pipe.h"
#include <cglm/struct.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/image.h"
#include "src/scene/import/importer.h"

enum {
    MAGIC_MODEL = 0x4d4e5246,
    MAGIC_ENVIRONMENT = 0x454e5246,
    HAS_CAMERA = 1,
    HAS_IOR = 2,
    HAS_BOX = 4,
    HAS_OBJECT_EXTRAS = 8,
    HAS_SURROUNDINGS_EXTRAS = 16,
    HEAD_FLAGS = 31,
    TEXEL_SIZE = 4,             /* size of an RGBA8 texel, bytes */
    ENVIRONMENT_TEXEL_SIZE = 8, /* size of an RGBA16F texel, bytes */
    HALF_MAX = 0x7bff,          /* bits of the largest finite half */
    HALF_ONE = 0x3c00,
};

struct mesh_counts {
    uint32_t vertices, indices;
};

struct texture_counts {
    uint32_t size, count; /* texels per side; number of layers */
};

struct model_head {
    uint32_t magic;
    uint32_t flags;
    struct mesh_counts object, surroundings;
    uint32_t object_count, material_count;
    struct texture_counts textures, numbers;
    uint32_t camera_count, light_count, extension_count, undrawn;
    uint32_t animation_count, animation;
    struct camera camera;
    float ior;
    struct box box;
    uint32_t surroundings_object_count;
};

struct environment_head {
    uint32_t magic;
    uint32_t width, height;
    struct environment_sun sun;
};

_Static_assert(sizeof(struct material) == 620, "no padding");
_Static_assert(sizeof(struct object) == 112, "no padding");
_Static_assert(sizeof(struct model_camera) == 120, "no padding");
_Static_assert(sizeof(struct light) == 120, "no padding");
_Static_assert(sizeof(struct model_extension) == 68, "no padding");
_Static_assert(sizeof(struct model_animation) == 68, "no padding");
_Static_assert(sizeof(struct environment_head) == 36, "no padding");
_Static_assert(sizeof(struct model_head) == 152, "no padding, so no bytes of this process in it");

/* ---- write ---- */

static bool write_mesh(const struct pipe_sink *sink, const struct mesh *mesh)
{
    return pipe_write(sink, mesh->vertices, mesh->vertex_count * sizeof(*mesh->vertices)) &&
           pipe_write(sink, mesh->indices, mesh->index_count * sizeof(*mesh->indices)) &&
           (!mesh->extras ||
            pipe_write(sink, mesh->extras, mesh->vertex_count * sizeof(*mesh->extras)));
}

static size_t texels_size(const struct texture_layers *layers)
{
    return (size_t)layers->size * layers->size * layers->count * TEXEL_SIZE;
}

bool model_pipe_write_model(const struct pipe_sink *sink, const struct model *model)
{
    const struct model_head head = {
        .magic = MAGIC_MODEL,
        .flags = (model->has_camera ? HAS_CAMERA : 0u) | (model->has_ior ? HAS_IOR : 0u) |
                 (model->has_box ? HAS_BOX : 0u) | (model->object.extras ? HAS_OBJECT_EXTRAS : 0u) |
                 (model->surroundings.extras ? HAS_SURROUNDINGS_EXTRAS : 0u),
        .object = { model->object.vertex_count, model->object.index_count },
        .surroundings = { model->surroundings.vertex_count, model->surroundings.index_count },
        .object_count = model->object_count,
        .material_count = model->material_count,
        .textures = { model->textures.size, model->textures.count },
        .numbers = { model->numbers.size, model->numbers.count },
        .camera_count = model->camera_count,
        .light_count = model->light_count,
        .extension_count = model->extension_count,
        .undrawn = model->undrawn,
        .animation_count = model->animation_count,
        .animation = model->animation,
        .camera = model->camera,
        .ior = model->ior,
        .box = model->box,
        .surroundings_object_count = model->surroundings_object_count,
    };
    return pipe_write(sink, &head, sizeof(head)) && write_mesh(sink, &model->object) &&
           write_mesh(sink, &model->surroundings) &&
           pipe_write(sink, model->objects, model->object_count * sizeof(*model->objects)) &&
           pipe_write(sink, model->materials, model->material_count * sizeof(*model->materials)) &&
           pipe_write(sink, model->cameras, model->camera_count * sizeof(*model->cameras)) &&
           pipe_write(sink, model->lights, model->light_count * sizeof(*model->lights)) &&
           pipe_write(sink, model->extensions,
                      model->extension_count * sizeof(*model->extensions)) &&
           pipe_write(sink, model->undrawn_text, sizeof(model->undrawn_text)) &&
           pipe_write(sink, model->animations,
                      model->animation_count * sizeof(*model->animations)) &&
           pipe_write(sink, model->surroundings_starts,
                      model->surroundings_object_count * sizeof(*model->surroundings_starts)) &&
           pipe_write(sink, model->surroundings_names,
                      model->surroundings_object_count * sizeof(*model->surroundings_names)) &&
           pipe_write(sink, model->textures.texels, texels_size(&model->textures)) &&
           pipe_write(sink, model->numbers.texels, texels_size(&model->numbers)) &&
           pipe_write_end(sink);
}

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

/* ---- read ---- */

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

static enum pipe_fault check_vertex(const struct mesh_vertex *vertex, const struct model_head *head)
{
    const uint32_t known =
        MESH_TEXTURE_MASK | MESH_UNLIT | MESH_CUTOUT | MESH_SURFACE_MAX << MESH_SURFACE_SHIFT;
    if (!is_bounded(vertex->position, MODEL_COORDINATE_MAX) || !is_bounded(vertex->normal, 2) ||
        !is_color(vertex->color, vertex->material & MESH_UNLIT) || !isfinite(vertex->uv.x) ||
        !isfinite(vertex->uv.y))
        return PIPE_NUMBER;
    if (vertex->material & ~known ||
        (vertex->material & MESH_TEXTURE_MASK) > head->textures.count ||
        vertex->material >> MESH_SURFACE_SHIFT > head->material_count)
        return PIPE_MATERIAL;
    return PIPE_OK;
}

static enum pipe_fault check_triangle(const struct mesh *mesh, const uint32_t *corners)
{
    for (int k = 0; k < 3; k++) {
        if (corners[k] >= mesh->vertex_count)
            return PIPE_INDEX;
        if (mesh->vertices[corners[k]].material != mesh->vertices[corners[0]].material)
            return PIPE_MATERIAL;
    }
    return PIPE_OK;
}

static enum pipe_fault read_extras(const struct pipe_source *source, struct mesh *mesh)
{
    if (!mesh_add_extras(mesh))
        return PIPE_MEMORY;
    enum pipe_fault fault =
        pipe_read(source, mesh->extras, mesh->vertex_count * sizeof(*mesh->extras));
    for (uint32_t i = 0; fault == PIPE_OK && i < mesh->vertex_count; i++) {
        const struct mesh_extra *extra = &mesh->extras[i];
        if (!is_bounded(extra->tangent, 2) || !is_in_range(extra->side, -1, 1) ||
            !isfinite(extra->uv.x) || !isfinite(extra->uv.y))
            fault = PIPE_NUMBER;
    }
    return fault;
}

static enum pipe_fault read_mesh(const struct pipe_source *source, struct mesh *mesh,
                                 struct mesh_counts counts, const struct model_head *head,
                                 bool has_extras)
{
    if (!mesh_init(mesh, counts.vertices, counts.indices))
        return PIPE_MEMORY;
    enum pipe_fault fault =
        pipe_read(source, mesh->vertices, counts.vertices * sizeof(*mesh->vertices));
    if (fault == PIPE_OK)
        fault = pipe_read(source, mesh->indices, counts.indices * sizeof(*mesh->indices));
    for (uint32_t i = 0; fault == PIPE_OK && i < counts.vertices; i++)
        fault = check_vertex(&mesh->vertices[i], head);
    if (fault == PIPE_OK && has_extras)
        fault = read_extras(source, mesh);
    for (uint32_t i = 0; fault == PIPE_OK && i < counts.indices; i += 3)
        fault = check_triangle(mesh, &mesh->indices[i]);
    return fault;
}

static uint64_t mesh_size(struct mesh_counts counts, bool has_extras)
{
    return counts.vertices * (uint64_t)sizeof(struct mesh_vertex) +
           (has_extras ? counts.vertices * (uint64_t)sizeof(struct mesh_extra) : 0) +
           counts.indices * (uint64_t)sizeof(uint32_t);
}

/* Returns true if both counts are within limits, and both are zero or both positive. */
static bool are_counts_valid(struct mesh_counts counts)
{
    return counts.vertices <= MODEL_ELEMENT_MAX && counts.indices <= MODEL_ELEMENT_MAX &&
           counts.indices % 3 == 0 && (counts.vertices > 0) == (counts.indices > 0);
}

static uint64_t textures_size(const struct texture_counts *textures)
{
    return (uint64_t)textures->size * textures->size * TEXEL_SIZE * textures->count;
}

static bool are_textures_valid(const struct texture_counts *textures)
{
    const uint32_t side = textures->size;
    return textures->count <= MODEL_TEXTURE_MAX && side <= MODEL_TEXTURE_SIDE_MAX &&
           (side & (side - 1)) == 0 && (side > 0) == (textures->count > 0) &&
           textures_size(textures) <= MODEL_TEXTURES_SIZE_MAX;
}

static enum pipe_fault check_sizes(const struct pipe_source *source, const struct model_head *head)
{
    if (!are_counts_valid(head->object) || !are_counts_valid(head->surroundings) ||
        head->object.indices + head->surroundings.indices == 0)
        return PIPE_SIZE;
    if (head->object_count > head->object.indices / 3 || head->material_count > MESH_SURFACE_MAX ||
        head->camera_count > MODEL_CAMERA_MAX || head->light_count > MODEL_LIGHT_MAX ||
        head->extension_count > MODEL_EXTENSION_MAX ||
        head->animation_count > MODEL_ANIMATION_MAX ||
        head->surroundings_object_count > head->surroundings.vertices ||
        head->animation > head->animation_count)
        return PIPE_SIZE;
    if (!are_textures_valid(&head->textures) || !are_textures_valid(&head->numbers))
        return PIPE_SIZE;
    if (textures_size(&head->textures) + textures_size(&head->numbers) +
            mesh_size(head->object, head->flags & HAS_OBJECT_EXTRAS) +
            mesh_size(head->surroundings, head->flags & HAS_SURROUNDINGS_EXTRAS) +
            head->object_count * (uint64_t)sizeof(struct object) +
            head->surroundings_object_count * (uint64_t)(sizeof(uint32_t) + MATERIAL_NAME_SIZE) +
            head->material_count * (uint64_t)sizeof(struct material) >
        source->size_max)
        return PIPE_SIZE;
    return PIPE_OK;
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
    return memchr(m->name, 0, sizeof(m->name)) && !(m->flags & ~(uint32_t)MATERIAL_FLAGS) &&
           is_color(m->base_color, m->flags & MATERIAL_IS_UNLIT) &&
           is_color(m->attenuation_color, false) && is_in_range(m->roughness, 0, 1) &&
           is_in_range(m->transmission, 0, 1) &&
           is_in_range(m->thickness, 0, MODEL_COORDINATE_MAX) && is_in_range(m->ior, 1, 4) &&
           is_in_range(m->dispersion, 0, 10) &&
           is_in_range(m->scattering_optical_depth, 0, MATERIAL_SCATTERING_MAX) &&
           is_in_range(m->attenuation_distance, 0, FLT_MAX) && is_surface(m);
}

/* Validates materials and objects. Objects need consecutive index ranges that fill the mesh. */
static enum pipe_fault check_objects(const struct model *model, const struct model_head *head)
{
    uint64_t end = 0;
    for (uint32_t i = 0; i < model->material_count; i++) {
        if (!is_material(&model->materials[i]))
            return PIPE_MATERIAL;
        for (uint32_t k = 0; k < MATERIAL_TEXTURE_COUNT; k++) {
            const uint32_t count =
                material_texture_is_color(k) ? head->textures.count : head->numbers.count;
            if (!is_texture(&model->materials[i].textures[k], count))
                return PIPE_MATERIAL;
        }
    }
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        if (!memchr(object->name, 0, sizeof(object->name)) || object->rank != 0 ||
            object->container_rank != 0 || object->enclosing_object != 0 ||
            object->material >= model->material_count)
            return PIPE_MATERIAL;
        if (object->first_index != end || object->index_count == 0 || object->index_count % 3 != 0)
            return PIPE_INDEX;
        end += object->index_count;
    }
    return end == model->object.index_count ? PIPE_OK : PIPE_INDEX;
}

static enum pipe_fault read_objects(const struct pipe_source *source, const struct model_head *head,
                                    struct model *model)
{
    const size_t objects_size = head->object_count * sizeof(*model->objects);
    const size_t materials_size = head->material_count * sizeof(*model->materials);
    model->objects = malloc(objects_size + 1);
    model->materials = malloc(materials_size + 1);
    if (!model->objects || !model->materials)
        return PIPE_MEMORY;
    model->object_count = head->object_count;
    model->material_count = head->material_count;
    enum pipe_fault fault = pipe_read(source, model->objects, objects_size);
    if (fault == PIPE_OK)
        fault = pipe_read(source, model->materials, materials_size);
    return fault == PIPE_OK ? check_objects(model, head) : fault;
}

static enum pipe_fault read_textures(const struct pipe_source *source,
                                     const struct texture_counts *counts,
                                     struct texture_layers *layers)
{
    if (counts->count == 0)
        return PIPE_OK;
    *layers = (struct texture_layers){ .size = counts->size, .count = counts->count };
    layers->texels = malloc(texels_size(layers));
    return layers->texels ? pipe_read(source, layers->texels, texels_size(layers)) : PIPE_MEMORY;
}

static bool is_box(const struct box *box)
{
    return is_bounded(box->min, MODEL_COORDINATE_MAX) &&
           is_bounded(box->max, MODEL_COORDINATE_MAX) && box->min.x < box->max.x &&
           box->min.y < box->max.y && box->min.z < box->max.z;
}

static bool is_camera(const struct camera *camera)
{
    return is_bounded(camera->eye, MODEL_COORDINATE_MAX) &&
           is_bounded(camera->up, MODEL_COORDINATE_MAX) &&
           is_bounded(camera->target, 8.0F * MODEL_COORDINATE_MAX) &&
           glms_vec3_distance(camera->eye, camera->target) > 0 && camera->fov_deg > 0 &&
           camera->fov_deg < 180 && camera->height == 0 && camera->depth == 0;
}

static bool is_head_valid(const struct model_head *head)
{
    if (head->flags & ~(uint32_t)HEAD_FLAGS)
        return false;
    if (head->flags & HAS_BOX && !is_box(&head->box))
        return false;
    if (head->flags & HAS_IOR && !(head->ior >= 1 && head->ior <= 4))
        return false;
    return !(head->flags & HAS_CAMERA) || is_camera(&head->camera);
}

static enum pipe_fault read_cameras(const struct pipe_source *source, uint32_t count,
                                    struct model *model)
{
    const size_t size = count * sizeof(*model->cameras);
    model->cameras = malloc(size + 1);
    if (!model->cameras)
        return PIPE_MEMORY;
    model->camera_count = count;
    const enum pipe_fault fault = pipe_read(source, model->cameras, size);
    for (uint32_t i = 0; fault == PIPE_OK && i < count; i++) {
        const struct model_camera *camera = &model->cameras[i];
        const bool is_flat = camera->kind == MODEL_ORTHOGRAPHIC;
        if (!memchr(camera->name, 0, sizeof(camera->name)) ||
            camera->kind >= MODEL_CAMERA_KIND_COUNT || !is_camera(&camera->camera) ||
            !is_in_range(camera->height, 0, MODEL_COORDINATE_MAX) ||
            is_flat != (camera->height > 0))
            return PIPE_CAMERA;
    }
    return fault;
}

static enum pipe_fault read_lights(const struct pipe_source *source, uint32_t count,
                                   struct model *model)
{
    const size_t size = count * sizeof(*model->lights);
    model->lights = malloc(size + 1);
    if (!model->lights)
        return PIPE_MEMORY;
    model->light_count = count;
    const enum pipe_fault fault = pipe_read(source, model->lights, size);
    for (uint32_t i = 0; fault == PIPE_OK && i < count; i++) {
        if (!punctual_light_is_valid(&model->lights[i]))
            return PIPE_NUMBER;
    }
    return fault;
}

static bool are_undrawn_bits_valid(uint32_t bits)
{
    for (uint32_t i = 0; i < 32; i++) {
        if (bits & 1u << i && !model_undrawn_name(i))
            return false;
    }
    return true;
}

static enum pipe_fault read_extensions(const struct pipe_source *source,
                                       const struct model_head *head, struct model *model)
{
    const size_t size = head->extension_count * sizeof(*model->extensions);
    if (!are_undrawn_bits_valid(head->undrawn))
        return PIPE_NUMBER;
    model->extensions = malloc(size + 1);
    if (!model->extensions)
        return PIPE_MEMORY;
    model->extension_count = head->extension_count;
    model->undrawn = head->undrawn;
    enum pipe_fault fault = pipe_read(source, model->extensions, size);
    for (uint32_t i = 0; fault == PIPE_OK && i < head->extension_count; i++) {
        const struct model_extension *extension = &model->extensions[i];
        if (!memchr(extension->name, 0, sizeof(extension->name)) ||
            extension->support >= MODEL_SUPPORT_COUNT)
            return PIPE_NUMBER;
    }
    if (fault == PIPE_OK)
        fault = pipe_read(source, model->undrawn_text, sizeof(model->undrawn_text));
    if (fault == PIPE_OK && !memchr(model->undrawn_text, 0, sizeof(model->undrawn_text)))
        return PIPE_NUMBER;
    return fault;
}

static enum pipe_fault read_animations(const struct pipe_source *source,
                                       const struct model_head *head, struct model *model)
{
    const size_t size = head->animation_count * sizeof(*model->animations);
    model->animations = malloc(size + 1);
    if (!model->animations)
        return PIPE_MEMORY;
    model->animation_count = head->animation_count;
    model->animation = head->animation;
    const enum pipe_fault fault = pipe_read(source, model->animations, size);
    for (uint32_t i = 0; fault == PIPE_OK && i < head->animation_count; i++) {
        const struct model_animation *animation = &model->animations[i];
        if (!memchr(animation->name, 0, sizeof(animation->name)) ||
            !is_in_range(animation->seconds, 0, (float)MODEL_SECONDS_MAX))
            return PIPE_NUMBER;
    }
    return fault;
}

/* Reads the surroundings objects and checks that their first vertices strictly ascend. */
static enum pipe_fault read_surroundings_objects(const struct pipe_source *source,
                                                 const struct model_head *head, struct model *model)
{
    const size_t rows = head->surroundings_object_count / MODEL_SURROUNDINGS_ROW + 1;
    uint32_t *starts = calloc(rows * MODEL_SURROUNDINGS_ROW, sizeof(*starts));
    model->surroundings_starts = starts;
    model->surroundings_names =
        calloc(rows * MODEL_SURROUNDINGS_ROW, sizeof(*model->surroundings_names));
    if (!starts || !model->surroundings_names)
        return PIPE_MEMORY;
    model->surroundings_object_count = head->surroundings_object_count;
    enum pipe_fault fault =
        pipe_read(source, starts, model->surroundings_object_count * sizeof(*starts));
    if (fault == PIPE_OK)
        fault = pipe_read(source, model->surroundings_names,
                          model->surroundings_object_count * sizeof(*model->surroundings_names));
    for (uint32_t i = 0; fault == PIPE_OK && i < model->surroundings_object_count; i++) {
        if (starts[i] >= head->surroundings.vertices || (i > 0 && starts[i] <= starts[i - 1]))
            return PIPE_INDEX;
        if (!memchr(model->surroundings_names[i], 0, MATERIAL_NAME_SIZE))
            return PIPE_MATERIAL;
    }
    return fault;
}

enum pipe_fault model_pipe_read_model(const struct pipe_source *source, struct model *model)
{
    struct model_head head;
    *model = (struct model){ 0 };
    enum pipe_fault fault = pipe_read(source, &head, sizeof(head));
    if (fault == PIPE_OK && head.magic != MAGIC_MODEL)
        fault = PIPE_HEAD;
    if (fault == PIPE_OK && !is_head_valid(&head))
        fault = PIPE_CAMERA;
    if (fault == PIPE_OK)
        fault = check_sizes(source, &head);
    if (fault == PIPE_OK)
        fault =
            read_mesh(source, &model->object, head.object, &head, head.flags & HAS_OBJECT_EXTRAS);
    if (fault == PIPE_OK)
        fault = read_mesh(source, &model->surroundings, head.surroundings, &head,
                          head.flags & HAS_SURROUNDINGS_EXTRAS);
    if (fault == PIPE_OK)
        fault = read_objects(source, &head, model);
    if (fault == PIPE_OK)
        fault = read_cameras(source, head.camera_count, model);
    if (fault == PIPE_OK)
        fault = read_lights(source, head.light_count, model);
    if (fault == PIPE_OK)
        fault = read_extensions(source, &head, model);
    if (fault == PIPE_OK)
        fault = read_animations(source, &head, model);
    if (fault == PIPE_OK)
        fault = read_surroundings_objects(source, &head, model);
    if (fault == PIPE_OK)
        fault = read_textures(source, &head.textures, &model->textures);
    if (fault == PIPE_OK)
        fault = read_textures(source, &head.numbers, &model->numbers);
    if (fault == PIPE_OK)
        fault = pipe_read_end(source);
    if (fault != PIPE_OK) {
        model_finish(model);
        return fault;
    }
    model->has_camera = head.flags & HAS_CAMERA;
    model->has_ior = head.flags & HAS_IOR;
    if (model->has_camera)
        model->camera = head.camera;
    if (model->has_ior)
        model->ior = head.ior;
    model->has_box = head.flags & HAS_BOX;
    if (model->has_box)
        model->box = head.box;
    return PIPE_OK;
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
