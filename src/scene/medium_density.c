/* medium_density.c: density fields of scattering media, by depth below the surface. */
#include "src/scene/medium_density.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/generate/noise.h"
#include "src/scene/geometry/distance_field.h"

enum {
    SIZE = MEDIUM_SIZE,
    COUNT = SIZE * SIZE * SIZE,
};

/* Returns the density, 0 to 1, of needle-shaped bubbles. The needles point to the centre, because
 * ice freezes in that direction. `position` is relative to the object's box, -1 to 1 per axis. */
static float needle_density(vec3s position, float depth)
{
    const vec3s dir = glms_vec3_scale(glms_vec3_normalize(position), 7.0f);
    const float fine = noise_value(glms_vec3_scale(dir, 2.3f), 17);
    const float noise =
        0.6f * noise_value(dir, 5) + 0.5f * fine + 0.3f * noise_fractal(position, 2, 9);
    const float needle = glm_smoothstep(-0.35f, 0.5f, noise);
    return glm_lerp(needle, 1.0f, glm_smoothstep(MEDIUM_CORE_BEGIN, 1.0f, depth));
}

/* Returns a texel's density, 0 to 1. `depth` is the texel's normalised depth below the surface. */
static float density_at(uint32_t texel, float depth)
{
    const uint32_t at[3] = { texel % SIZE, texel / SIZE % SIZE, texel / SIZE / SIZE };
    vec3s position;
    for (int k = 0; k < 3; k++)
        position.raw[k] = 2.0f * ((float)at[k] + 0.5f) / SIZE - 1.0f;
    return depth > MEDIUM_RIM ? medium_relative_density(depth) * needle_density(position, depth)
                              : 0.0f;
}

struct scattering_media scattering_media_find(const struct model *model, bool is_asked)
{
    struct scattering_media scattering_media = { 0 };
    if (!model->object_count && is_asked && model->object.index_count)
        scattering_media.all[scattering_media.count++] =
            (struct scattering_medium){ .box = mesh_box(&model->object) };
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        const struct scattering_medium medium = {
            .object = i,
            .density = model->materials[object->material].scattering_optical_depth,
            .is_even = model->materials[object->material].flags & MATERIAL_SCATTERS_EVENLY,
            .box = object->box,
        };
        if (!(medium.density > 0.0f) && !(is_asked && i == 0))
            continue;
        if (scattering_media.count < MEDIUM_MAX)
            scattering_media.all[scattering_media.count++] = medium;
        else
            scattering_media.left_out++;
    }
    return scattering_media;
}

static struct mesh object_triangles(const struct model *model,
                                    const struct scattering_medium *medium)
{
    struct mesh part = model->object;
    if (model->object_count) {
        part.indices += model->objects[medium->object].first_index;
        part.index_count = model->objects[medium->object].index_count;
    }
    return part;
}

/* Returns the bounding box of all texels with non-zero density, with a margin for interpolation. */
static struct box filled_by(const struct box *box, uint8_t (*texels)[2])
{
    float first[3] = { SIZE, SIZE, SIZE }, last[3] = { 0 };
    for (uint32_t k = 0; k < COUNT; k++) {
        const uint32_t at[3] = { k % SIZE, k / SIZE % SIZE, k / SIZE / SIZE };
        for (int axis = 0; axis < 3 && texels[k][0]; axis++) {
            first[axis] = fminf(first[axis], (float)at[axis] - 0.5f);
            last[axis] = fmaxf(last[axis], (float)at[axis] + 1.5f);
        }
    }
    struct box filled;
    for (int axis = 0; axis < 3; axis++) {
        const float side = (box->max.raw[axis] - box->min.raw[axis]) / SIZE;
        filled.min.raw[axis] = box->min.raw[axis] + fmaxf(first[axis], 0.0f) * side;
        filled.max.raw[axis] = box->min.raw[axis] + fminf(last[axis], SIZE) * side;
    }
    return filled;
}

bool scattering_media_fill(struct scattering_media *scattering_media, const struct model *model)
{
    scattering_media->texels =
        scattering_media->count
            ? malloc(sizeof(*scattering_media->texels) * COUNT * scattering_media->count)
            : NULL;
    if (scattering_media->count && !scattering_media->texels)
        return false;
    for (uint32_t i = 0; i < scattering_media->count; i++) {
        const struct mesh part = object_triangles(model, &scattering_media->all[i]);
        const bool is_even = scattering_media->all[i].is_even;
        struct distance_field depth;
        if (!distance_field_init(&depth, &part))
            return false;
        uint8_t(*texels)[2] = &scattering_media->texels[(size_t)COUNT * i];
        for (uint32_t k = 0; k < COUNT; k++)
            texels[k][0] = (uint8_t)(255.0f * (is_even ? depth.texels[k] > 0.0f ? 1.0f : 0.0f
                                                       : density_at(k, depth.texels[k])) +
                                     0.5f);
        for (uint32_t k = 0; k < COUNT; k++)
            texels[k][1] = texels[k + SIZE * SIZE < COUNT ? k + SIZE * SIZE : k][0];
        scattering_media->all[i].box = depth.box;
        scattering_media->all[i].filled = filled_by(&depth.box, texels);
        distance_field_finish(&depth);
    }
    return true;
}

void scattering_media_finish(struct scattering_media *scattering_media)
{
    free(scattering_media->texels);
    *scattering_media = (struct scattering_media){ 0 };
}

float scattering_media_at(const struct scattering_media *scattering_media, uint32_t index,
                          vec3s point)
{
    const struct box *box = &scattering_media->all[index].box;
    uint8_t(*texels)[2] = &scattering_media->texels[(size_t)COUNT * index];
    uint32_t lower[3];
    float weights[3], sum = 0.0f;
    for (int k = 0; k < 3; k++) {
        const float at = (point.raw[k] - box->min.raw[k]) / (box->max.raw[k] - box->min.raw[k]);
        if (!(at >= 0.0f && at <= 1.0f))
            return 0.0f;
        const float texel = glm_clamp(at * SIZE - 0.5f, 0.0f, SIZE - 1.0f);
        lower[k] = (uint32_t)fminf(texel, SIZE - 2.0f);
        weights[k] = texel - (float)lower[k];
    }
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t x = lower[0] + (i & 1), y = lower[1] + (i >> 1 & 1), z = lower[2] + (i >> 2);
        const float weight = (i & 1 ? weights[0] : 1.0f - weights[0]) *
                             (i >> 1 & 1 ? weights[1] : 1.0f - weights[1]) *
                             (i >> 2 ? weights[2] : 1.0f - weights[2]);
        sum += weight * (float)texels[(z * SIZE + y) * SIZE + x][0];
    }
    return sum / 255.0f;
}
