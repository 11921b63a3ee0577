/* bubble_placement.c: places non-overlapping bubbles inside a closed mesh by rejection sampling. */
#include "src/scene/generate/bubble_placement.h"
#include <assert.h>
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/generate/random.h"

enum {
    ATTEMPTS = 64,   /* random positions per bubble */
    FAILURES_MAX = 4 /* maximum consecutive failures */
};

/* Returns twice the signed area of the triangle a, b, origin. */
static float cross(vec2s a, vec2s b)
{
    return a.x * b.y - a.y * b.x;
}

/* Returns the coordinate at which axis `axis` (0 to 2) crosses a triangle; NAN if it does not. */
static float axis_hit(const vec3s corners[3], int axis)
{
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    vec2s flat[3];
    float areas[3];
    for (int i = 0; i < 3; i++)
        flat[i] = (vec2s){ { corners[i].raw[u], corners[i].raw[v] } };
    for (int i = 0; i < 3; i++)
        areas[i] = cross(flat[(i + 1) % 3], flat[(i + 2) % 3]);
    const bool all = areas[0] > 0 && areas[1] > 0 && areas[2] > 0;
    const bool none = areas[0] < 0 && areas[1] < 0 && areas[2] < 0;
    if (!all && !none)
        return NAN;
    float sum = 0;
    for (int i = 0; i < 3; i++)
        sum += areas[i] * corners[i].raw[axis];
    return sum / (areas[0] + areas[1] + areas[2]);
}

static bool spans_zero(const vec3s corners[3], int axis)
{
    const float a = corners[0].raw[axis], b = corners[1].raw[axis], c = corners[2].raw[axis];
    return (a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0);
}

/* Returns a point's distance to the surface along the nearest axis, or 0 outside. Counts the hits
 * of three rays, because one ray through an edge may miss both triangles at the edge. */
float bubbles_clearance(const struct mesh *mesh, vec3s point)
{
    uint32_t exits[3] = { 0 };
    float nearest = HUGE_VALF;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        vec3s corners[3];
        for (uint32_t k = 0; k < 3; k++)
            corners[k] = glms_vec3_sub(mesh->vertices[mesh->indices[i + k]].position, point);
        const bool across[3] = { spans_zero(corners, 0), spans_zero(corners, 1),
                                 spans_zero(corners, 2) };
        for (int axis = 0; axis < 3; axis++) {
            if (!across[(axis + 1) % 3] || !across[(axis + 2) % 3])
                continue;
            const float at = axis_hit(corners, axis);
            if (isnan(at))
                continue;
            exits[axis] += at > 0;
            nearest = fminf(nearest, fabsf(at));
        }
    }
    return exits[0] % 2 && exits[1] % 2 && exits[2] % 2 ? nearest : 0;
}

/* Returns the radius of a bubble's bounding sphere. */
static float bounding_radius(const struct bubble *bubble)
{
    return bubble->radius + fmaxf(bubble->stretch, 0);
}

static bool is_unoccupied(const struct bubbles *bubbles, vec3s center, float radius)
{
    for (uint32_t i = 0; i < bubbles->count; i++) {
        const struct bubble *other = &bubbles->all[i];
        if (glms_vec3_distance(center, other->center) < radius + bounding_radius(other))
            return false;
    }
    return true;
}

/* Returns a bubble of the requested shape inside the sphere `bubble`. The new bubble's axis
 * deviates by at most about 20 degrees from the line to `middle`, the object's centre. */
static struct bubble shape_bubble(struct bubble bubble, const struct generate_bubbles *params,
                                  vec3s middle, struct random *random)
{
    enum generate_bubbles_shape shape = params->shape;
    if (shape == GENERATE_BUBBLES_MIXED)
        shape = (enum generate_bubbles_shape)(random_unit(random) * GENERATE_BUBBLES_MIXED);
    if (shape == GENERATE_BUBBLES_SPHERE)
        return bubble;
    const float thin = bubble.radius / params->stretch;
    const vec3s out = glms_vec3_normalize(glms_vec3_sub(bubble.center, middle));
    bubble.axis = glms_vec3_normalize(glms_vec3_muladds(random_box(random), 0.2f, out));
    bubble.is_capsule = shape == GENERATE_BUBBLES_CAPSULE;
    bubble.stretch = shape == GENERATE_BUBBLES_OBLATE ? thin - bubble.radius : bubble.radius - thin;
    bubble.radius = shape == GENERATE_BUBBLES_OBLATE ? bubble.radius : thin;
    return bubble;
}

/* Adds a bubble at a random free position. Returns false if no position is found. In a convex
 * object, a sphere fits if the centre is at least sqrt(3) radii from the surface along each axis.
 */
static bool add_bubble(struct bubbles *bubbles, const struct mesh *mesh,
                       const struct generate_bubbles *params, struct box box, float radius,
                       struct random *random)
{
    const vec3s half = glms_vec3_scale(glms_vec3_sub(box.max, box.min), 0.5f);
    const float rim = 2.0f * params->rim * glms_vec3_min(half);
    for (int i = 0; i < ATTEMPTS; i++) {
        const vec3s center =
            glms_vec3_add(box_center(box), glms_vec3_mul(half, random_box(random)));
        if (!is_unoccupied(bubbles, center, radius))
            continue;
        if (bubbles_clearance(mesh, center) < radius * 1.7320508f + rim)
            continue;
        bubbles->all[bubbles->count++] =
            shape_bubble((struct bubble){ center, radius }, params, box_center(box), random);
        return true;
    }
    return false;
}

bool generate_bubbles(struct bubbles *bubbles, const struct mesh *object,
                      const struct generate_bubbles *params)
{
    const struct box box = mesh_box(object);
    const float largest = params->size * box_diagonal(box) / 2;
    assert(params->count <= BUBBLES_COUNT_MAX);
    *bubbles = (struct bubbles){ .all = calloc(params->count, sizeof(*bubbles->all)) };
    if (!bubbles->all)
        return false;
    if (params->shape == GENERATE_BUBBLES_GROWN) {
        bubbles_generate_frozen(bubbles, object, params);
        return true;
    }
    uint32_t failures = 0;
    for (uint32_t i = 0; i < params->count && failures < FAILURES_MAX; i++) {
        struct random random = random_begin(params->seed, i);
        const float u = random_unit(&random);
        const float radius = largest * (0.2f + 0.8f * u * u * u);
        failures = add_bubble(bubbles, object, params, box, radius, &random) ? 0 : failures + 1;
    }
    return true;
}
