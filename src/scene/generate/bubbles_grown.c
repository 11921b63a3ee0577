/*
 * bubbles_grown.c: bubbles as ice leaves them that has frozen from its surface inwards.
 *
 * Air that ice does not take collects before it. Where ice grows slowly, that becomes worms along
 * its way, side by side; they may pinch off to strings of beads; where it grows fast, eggs
 * (Thievenaz and Sauret 2024, Universal equation describes the shape of air bubbles trapped in
 * ice). None are in the outer rim, and most are small. Of the C library only square roots are
 * called, because other functions could differ between machines.
 */
#include <cglm/struct.h>
#include <math.h>
#include "src/scene/generate/bubbles.h"
#include "src/scene/generate/random.h"

enum {
    GROUPS_MAX = 4096 /* that are tried */
};

enum kind {
    WORMS, /* side by side */
    BEADS, /* behind each other */
    EGGS,  /* in a clump */
};

struct group {
    enum kind kind;
    uint32_t count;
    vec3s at, along, aside; /* along: unit, the way that ice has grown; aside: unit, across it */
    float length;           /* of its worms, its string, or its clump */
};

struct growth {
    struct bubbles *bubbles;
    const struct mesh *mesh;
    vec3s middle, half; /* of the box, metres */
    float longest;      /* half the length of the longest worm */
    float thick;        /* radius of an ordinary worm */
    float rim;
};

static float between(struct random *random, float low, float high)
{
    return low + (high - low) * random_unit(random);
}

/* Returns a number whose density falls with its cube. */
static float mostly_small(struct random *random, float low, float high)
{
    const float a = 1.0f / (low * low), b = 1.0f / (high * high);
    return 1.0f / sqrtf(a + random_unit(random) * (b - a));
}

/* Returns the way that ice has grown at a place: from the nearest side inwards. */
static vec3s growth_at(const struct growth *growth, vec3s point, struct random *random)
{
    vec3s out = glms_vec3_div(glms_vec3_sub(point, growth->middle), growth->half);
    for (int k = 0; k < 3; k++)
        out.raw[k] = out.raw[k] * out.raw[k] * out.raw[k] + 1e-6f;
    const vec3s inwards = glms_vec3_negate(glms_vec3_normalize(out));
    return glms_vec3_normalize(glms_vec3_muladds(random_box(random), 0.12f, inwards));
}

/* Returns whether two bubbles are apart: the cores of what is long are parts of their axes, and are
 * nearest to each other where the line between them is across both, or at an end. */
static bool are_apart(const struct bubble *a, const struct bubble *b)
{
    const float half_a = fmaxf(a->stretch, 0.0f), half_b = fmaxf(b->stretch, 0.0f);
    const vec3s from = glms_vec3_sub(a->center, b->center);
    const float turn = glms_vec3_dot(a->axis, b->axis);
    const float on_a = glms_vec3_dot(a->axis, from), on_b = glms_vec3_dot(b->axis, from);
    const float across = fmaxf(1.0f - turn * turn, 1e-6f);
    float s = glm_clamp((turn * on_b - on_a) / across, -half_a, half_a);
    const float t = glm_clamp(on_b + turn * s, -half_b, half_b);
    s = glm_clamp(turn * t - on_a, -half_a, half_a);
    const vec3s apart =
        glms_vec3_sub(glms_vec3_muladds(a->axis, s, from), glms_vec3_scale(b->axis, t));
    return glms_vec3_norm(apart) > 1.1f * (a->radius + b->radius);
}

static bool has_room(const struct growth *growth, const struct bubble *bubble)
{
    const struct bubbles *others = growth->bubbles;
    for (uint32_t i = 0; i < others->count; i++) {
        if (!are_apart(bubble, &others->all[i]))
            return false;
    }
    const float half = fmaxf(bubble->stretch, 0.0f);
    for (int end = -1; end <= 1; end += 2) {
        const vec3s at = glms_vec3_muladds(bubble->axis, (float)end * half, bubble->center);
        if (bubbles_clearance(growth->mesh, at) < 1.7320508f * bubble->radius + growth->rim)
            return false;
    }
    return true;
}

static struct group find_group(const struct growth *growth, struct random *random)
{
    const float kind = random_unit(random);
    struct group group = { .kind = kind < 0.3f ? WORMS : kind < 0.5f ? BEADS : EGGS };
    group.count = (uint32_t)between(random, 3.0f, 8.0f);
    group.at = glms_vec3_add(
        growth->middle, glms_vec3_mul(growth->half, glms_vec3_scale(random_box(random), 0.9f)));
    group.along = growth_at(growth, group.at, random);
    group.aside = glms_vec3_normalize(glms_vec3_cross(group.along, random_box(random)));
    group.length = growth->longest * (0.3f + 0.7f * random_unit(random));
    return group;
}

/* Makes a group's bubble of a number. */
static struct bubble member(const struct growth *growth, const struct group *group, uint32_t i,
                            struct random *random)
{
    const float place = (float)i - 0.5f * (float)(group->count - 1);
    const vec3s bent = glms_vec3_muladds(random_box(random), 0.05f, group->along);
    struct bubble bubble = { .center = group->at, .axis = glms_vec3_normalize(bent) };
    if (group->kind == WORMS) {
        bubble.radius = growth->thick * between(random, 0.35f, 1.0f);
        bubble.stretch = group->length * between(random, 0.6f, 1.0f);
        bubble.is_capsule = true;
        const float apart = growth->thick * between(random, 7.0f, 11.0f);
        bubble.center = glms_vec3_muladds(group->aside, place * apart, bubble.center);
        bubble.center = glms_vec3_muladds(group->along, between(random, 0.0f, 0.6f) * group->length,
                                          bubble.center);
    } else if (group->kind == BEADS) {
        bubble.radius = growth->thick * between(random, 0.65f, 1.35f);
        bubble.stretch = bubble.radius * between(random, 0.1f, 1.2f);
        const float apart = growth->thick * 5.2f;
        bubble.center = glms_vec3_muladds(group->along, place * apart, bubble.center);
    } else {
        bubble.radius = growth->thick * mostly_small(random, 0.4f, 2.2f);
        bubble.stretch = bubble.radius * between(random, 0.15f, 1.0f);
        bubble.center =
            glms_vec3_muladds(random_box(random), 0.8f * growth->longest, bubble.center);
    }
    return bubble;
}

void bubbles_grow(struct bubbles *bubbles, const struct mesh *mesh,
                  const struct generate_bubbles *params)
{
    const struct box box = mesh_box(mesh);
    const vec3s half = glms_vec3_scale(glms_vec3_sub(box.max, box.min), 0.5f);
    const float longest = params->size * box_diagonal(box) / 2;
    const struct growth growth = {
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
        const struct group group = find_group(&growth, &random);
        for (uint32_t i = 0; i < group.count && bubbles->count < params->count; i++) {
            const struct bubble bubble = member(&growth, &group, i, &random);
            if (has_room(&growth, &bubble))
                bubbles->all[bubbles->count++] = bubble;
        }
    }
}
