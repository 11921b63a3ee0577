/*
 * frozen_bubbles.c: generates bubbles like those trapped in ice that froze from its surface
 * inwards.
 *
 * Ice rejects dissolved air, which collects at the freezing front. Slow freezing gives parallel
 * worm-shaped bubbles along the freezing direction, which may pinch off into strings of beads; fast
 * freezing gives egg shapes (Thievenaz and Sauret 2024, Universal equation describes the shape of
 * air bubbles trapped in ice). The outer rim has none, and most are small. Calls no C library
 * functions except square roots, since others may differ between machines.
 */
#include <cglm/struct.h>
#include <math.h>
#include "src/scene/generate/bubble_placement.h"
#include "src/scene/generate/random.h"

enum {
    GROUPS_MAX = 4096 /* maximum number of groups to try */
};

enum kind {
    WORMS, /* parallel worm-shaped bubbles */
    BEADS, /* strings of spherical bubbles */
    EGGS,  /* clumps of egg-shaped bubbles */
};

struct group {
    enum kind kind;
    uint32_t count;
    /* `along` is the freezing direction, and `aside` is perpendicular to it */
    vec3s position, along, aside;
    float length; /* maximum half-length of the group's worms */
};

struct growth_params {
    struct bubbles *bubbles;
    const struct mesh *mesh;
    vec3s middle, half; /* centre and half size of the object's box, metres */
    float longest;      /* half the maximum worm length */
    float thick;        /* radius of an average worm */
    float rim;
};

static float between(struct random *random, float low, float high)
{
    return low + (high - low) * random_unit(random);
}

/* Returns a random number whose probability density is proportional to value^-3. */
static float mostly_small(struct random *random, float low, float high)
{
    const float a = 1.0f / (low * low), b = 1.0f / (high * high);
    return 1.0f / sqrtf(a + random_unit(random) * (b - a));
}

/* Returns the freezing direction at a point: inwards from the nearest side, slightly randomised. */
static vec3s growth_at(const struct growth_params *growth_params, vec3s point,
                       struct random *random)
{
    vec3s out = glms_vec3_div(glms_vec3_sub(point, growth_params->middle), growth_params->half);
    for (int k = 0; k < 3; k++)
        out.raw[k] = out.raw[k] * out.raw[k] * out.raw[k] + 1e-6f;
    const vec3s inwards = glms_vec3_negate(glms_vec3_normalize(out));
    return glms_vec3_normalize(glms_vec3_muladds(random_box(random), 0.12f, inwards));
}

/* Returns true if two bubbles do not touch. The distance between the bubbles' axis segments must
 * exceed 1.1 times the sum of the bubbles' radii. */
static bool are_apart(const struct bubble *a, const struct bubble *b)
{
    const float half_a = fmaxf(a->stretch, 0.0f), half_b = fmaxf(b->stretch, 0.0f);
    const vec3s from = glms_vec3_sub(a->center, b->center);
    const float cosine = glms_vec3_dot(a->axis, b->axis);
    const float on_a = glms_vec3_dot(a->axis, from), on_b = glms_vec3_dot(b->axis, from);
    const float across = fmaxf(1.0f - cosine * cosine, 1e-6f);
    float s = glm_clamp((cosine * on_b - on_a) / across, -half_a, half_a);
    const float t = glm_clamp(on_b + cosine * s, -half_b, half_b);
    s = glm_clamp(cosine * t - on_a, -half_a, half_a);
    const vec3s spacing =
        glms_vec3_sub(glms_vec3_muladds(a->axis, s, from), glms_vec3_scale(b->axis, t));
    return glms_vec3_norm(spacing) > 1.1f * (a->radius + b->radius);
}

static bool is_unoccupied(const struct growth_params *growth_params, const struct bubble *bubble)
{
    const struct bubbles *others = growth_params->bubbles;
    for (uint32_t i = 0; i < others->count; i++) {
        if (!are_apart(bubble, &others->all[i]))
            return false;
    }
    const float half = fmaxf(bubble->stretch, 0.0f);
    for (int end = -1; end <= 1; end += 2) {
        const vec3s position = glms_vec3_muladds(bubble->axis, (float)end * half, bubble->center);
        if (bubbles_clearance(growth_params->mesh, position) <
            1.7320508f * bubble->radius + growth_params->rim)
            return false;
    }
    return true;
}

static struct group make_group(const struct growth_params *growth_params, struct random *random)
{
    const float kind = random_unit(random);
    struct group group = { .kind = kind < 0.3f ? WORMS : kind < 0.5f ? BEADS : EGGS };
    group.count = (uint32_t)between(random, 3.0f, 8.0f);
    group.position = glms_vec3_add(
        growth_params->middle,
        glms_vec3_mul(growth_params->half, glms_vec3_scale(random_box(random), 0.9f)));
    group.along = growth_at(growth_params, group.position, random);
    group.aside = glms_vec3_normalize(glms_vec3_cross(group.along, random_box(random)));
    group.length = growth_params->longest * (0.3f + 0.7f * random_unit(random));
    return group;
}

/* Returns the i-th bubble of a group. */
static struct bubble make_bubble(const struct growth_params *growth_params,
                                 const struct group *group, uint32_t i, struct random *random)
{
    const float offset = (float)i - 0.5f * (float)(group->count - 1);
    const vec3s tilted = glms_vec3_muladds(random_box(random), 0.05f, group->along);
    struct bubble bubble = { .center = group->position, .axis = glms_vec3_normalize(tilted) };
    if (group->kind == WORMS) {
        bubble.radius = growth_params->thick * between(random, 0.35f, 1.0f);
        bubble.stretch = group->length * between(random, 0.6f, 1.0f);
        bubble.is_capsule = true;
        const float spacing = growth_params->thick * between(random, 7.0f, 11.0f);
        bubble.center = glms_vec3_muladds(group->aside, offset * spacing, bubble.center);
        bubble.center = glms_vec3_muladds(group->along, between(random, 0.0f, 0.6f) * group->length,
                                          bubble.center);
    } else if (group->kind == BEADS) {
        bubble.radius = growth_params->thick * between(random, 0.65f, 1.35f);
        bubble.stretch = bubble.radius * between(random, 0.1f, 1.2f);
        const float spacing = growth_params->thick * 5.2f;
        bubble.center = glms_vec3_muladds(group->along, offset * spacing, bubble.center);
    } else {
        bubble.radius = growth_params->thick * mostly_small(random, 0.4f, 2.2f);
        bubble.stretch = bubble.radius * between(random, 0.15f, 1.0f);
        bubble.center =
            glms_vec3_muladds(random_box(random), 0.8f * growth_params->longest, bubble.center);
    }
    return bubble;
}

void bubbles_generate_frozen(struct bubbles *bubbles, const struct mesh *mesh,
                             const struct generate_bubbles *params)
{
    const struct box box = mesh_box(mesh);
    const vec3s half = glms_vec3_scale(glms_vec3_sub(box.max, box.min), 0.5f);
    const float longest = params->size * box_diagonal(box) / 2;
    const struct growth_params growth_params = {
        .bubbles = bubbles,
        .mesh = mesh,
        .middle = box_center(box),
        .half = half,
        .longest = longest,
        .thick = longest / params->stretch,
        .rim = 2.0f * fmaxf(params->rim, 0.08f) * glms_vec3_min(half),
    };
    for (uint32_t g = 0; g < GROUPS_MAX && bubbles->count < params->count; g++) {
        struct random random = random_begin(params->seed, g);
        const struct group group = make_group(&growth_params, &random);
        for (uint32_t i = 0; i < group.count && bubbles->count < params->count; i++) {
            const struct bubble bubble = make_bubble(&growth_params, &group, i, &random);
            if (is_unoccupied(&growth_params, &bubble))
                bubbles->all[bubbles->count++] = bubble;
        }
    }
}
