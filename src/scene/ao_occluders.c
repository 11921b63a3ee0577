/* ao_occluders.c: fits convex occluders around objects for ambient occlusion. */
#include "src/scene/ao_occluders.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"

#define SLACK 0.02f /* tolerance of containment, in occluder diagonals */
#define FLAT  0.15f /* height-to-width ratio below which an object is flat */

enum {
    STEPS = 16 /* samples per axis, in volume estimates */
};

/* Extent of an object along each plane normal of an occluder. */
struct extent {
    float most[AO_PLANES];
    struct box box;
    float volume;
    bool is_assigned;
};

/* Returns a plane's unit normal. Planes 0 to 5 face a cube's faces, planes 6 to 17 its edges. */
static vec3s direction(uint32_t plane)
{
    const float side = plane & 1 ? 1.0f : -1.0f;
    vec3s dir = glms_vec3_zero();
    if (plane < 6) {
        dir.raw[plane / 2] = side;
        return dir;
    }
    const uint32_t axis = (plane - 6) / 4;
    dir.raw[(axis + 1) % 3] = side * sqrtf(0.5f);
    dir.raw[(axis + 2) % 3] = plane & 2 ? sqrtf(0.5f) : -sqrtf(0.5f);
    return dir;
}

static float volume_of(const struct mesh *part)
{
    double six = 0.0;
    for (uint32_t i = 0; i < part->index_count; i += 3) {
        const vec3s origin = part->vertices[part->indices[0]].position;
        vec3s v[3];
        for (uint32_t c = 0; c < 3; c++)
            v[c] = glms_vec3_sub(part->vertices[part->indices[i + c]].position, origin);
        six += (double)glms_vec3_dot(v[0], glms_vec3_cross(v[1], v[2]));
    }
    return (float)fabs(six) / 6.0f;
}

static struct extent extent_of(const struct mesh *part)
{
    struct extent extent = { .volume = part->index_count ? volume_of(part) : 0.0f };
    vec3s dirs[AO_PLANES];
    for (uint32_t k = 0; k < AO_PLANES; k++) {
        dirs[k] = direction(k);
        extent.most[k] = -INFINITY;
    }
    for (uint32_t i = 0; i < part->index_count; i++) {
        const vec3s at = part->vertices[part->indices[i]].position;
        for (uint32_t k = 0; k < AO_PLANES; k++)
            extent.most[k] = fmaxf(extent.most[k], glms_vec3_dot(at, dirs[k]));
    }
    for (size_t axis = 0; axis < 3 && part->index_count; axis++) {
        extent.box.min.raw[axis] = -extent.most[2 * axis];
        extent.box.max.raw[axis] = extent.most[2 * axis + 1];
    }
    return extent;
}

static bool is_flat(const struct extent *extent)
{
    const vec3s sides = glms_vec3_sub(extent->box.max, extent->box.min);
    return sides.y < FLAT * fmaxf(sides.x, sides.z);
}

/* Returns the filled fraction of an occluder's bounding box, by point sampling. */
static float filled_fraction(const struct ao_shape *shape)
{
    const vec3s sides = glms_vec3_sub(shape->box.max, shape->box.min);
    const uint32_t all = STEPS * STEPS * STEPS;
    uint32_t count = 0;
    for (uint32_t i = 0; i < all; i++) {
        const uint32_t x = i % STEPS, y = i / STEPS % STEPS, z = i / STEPS / STEPS;
        const vec3s at = { { (float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f } };
        const vec3s point = glms_vec3_add(
            shape->box.min, glms_vec3_mul(glms_vec3_scale(at, 1.0f / (float)STEPS), sides));
        bool is_inside = true;
        for (uint32_t k = 6; k < AO_PLANES && is_inside; k++)
            is_inside = glms_vec3_dot(glms_vec3(shape->planes[k]), point) <= shape->planes[k].w;
        count += is_inside;
    }
    return (float)(count ? count : 1) / (float)all;
}

static bool contains(const struct extent *body, const struct extent *other)
{
    const float slack = SLACK * box_diagonal(body->box);
    for (uint32_t k = 0; k < AO_PLANES; k++) {
        if (other->most[k] > body->most[k] + slack)
            return false;
    }
    return true;
}

/* Adds an object to an occluder. The object fills `fraction` of the occluder's volume. If another
 * object in the occluder directly encloses it, that object's fraction shrinks by `fraction`. */
static void add_member(struct ao_shape *shape, const struct object *objects, uint32_t object,
                       float fraction)
{
    if (shape->member_count == AO_MEMBERS)
        return;
    for (uint32_t i = 0; objects && i < shape->member_count; i++) {
        if (objects[object].enclosing_object == shape->members[i].object + 1)
            shape->members[i].volume_fraction -= fraction;
    }
    shape->members[shape->member_count++] = (struct ao_member){ object, fraction };
}

static void make_shape(struct ao_shape *shape, struct extent *extents, const struct object *objects,
                       uint32_t count, uint32_t largest)
{
    const struct extent *body = &extents[largest];
    const vec3s sides = glms_vec3_sub(body->box.max, body->box.min);
    shape->box = body->box;
    for (uint32_t k = 0; k < AO_PLANES; k++)
        shape->planes[k] = glms_vec4(direction(k), body->most[k]);
    const float fraction = filled_fraction(shape);
    const float volume = fmaxf(fraction * sides.x * sides.y * sides.z, 1e-30f);
    shape->relative_width = sqrtf(fraction);
    add_member(shape, objects, largest, fminf(body->volume / volume, 1.0f));
    for (uint32_t i = 0; i < count; i++) {
        if (i == largest || extents[i].is_assigned || !contains(body, &extents[i]))
            continue;
        extents[i].is_assigned = true;
        if (extents[i].volume > 0.01f * volume)
            add_member(shape, objects, i, extents[i].volume / volume);
    }
    extents[largest].is_assigned = true;
}

/* Returns the largest object without an occluder, or `count` if there is none. */
static uint32_t find_largest(const struct extent *extents, uint32_t count)
{
    uint32_t largest = count;
    for (uint32_t i = 0; i < count; i++) {
        if (!extents[i].is_assigned &&
            (largest == count || box_diagonal(extents[i].box) > box_diagonal(extents[largest].box)))
            largest = i;
    }
    return largest;
}

enum status ao_find(struct ao *ao, const struct mesh *mesh, const struct object *objects,
                    uint32_t count)
{
    const uint32_t all = count ? count : 1;
    *ao = (struct ao){ 0 };
    struct extent *extents = calloc(all, sizeof(*extents));
    if (!extents)
        return log_out_of_memory(NULL);
    for (uint32_t i = 0; i < all; i++) {
        const struct mesh part = count ? object_mesh(&objects[i], mesh) : *mesh;
        extents[i] = extent_of(&part);
        extents[i].is_assigned = part.index_count == 0 || is_flat(&extents[i]);
    }
    uint32_t largest = find_largest(extents, all);
    while (largest < all && ao->count < AO_OCCLUDERS_MAX) {
        make_shape(&ao->shapes[ao->count++], extents, count ? objects : NULL, all, largest);
        largest = find_largest(extents, all);
    }
    free(extents);
    return STATUS_OK;
}
