/* branch.h: a ray with its weight, between two surfaces that part it. */
#ifndef FIRN_REFERENCE_BRANCH_H
#define FIRN_REFERENCE_BRANCH_H

#include "src/reference/parting.h"
#include "src/reference/reference_layers.h"
#include "src/reference/tracing.h"

struct branch {
    struct bvh_ray ray;
    struct media_set inside; /* the objects that the ray is in */
    vec3s weight;
    vec3s air;        /* light that air has added since its last surface */
    uint32_t bounces; /* surfaces that it has met */
    uint32_t seed;    /* of the random numbers at its next surface */
    uint32_t scatterings;
    uint32_t met;     /* enum reference_met */
    bool is_straight; /* it passes clouds, as if they were not there */
    bool is_gathered; /* it brings light to surroundings (ground.h) */
    bool is_path;     /* at surfaces it goes one way, by chance */
};

/* The two branches of light that meets a surface. */
struct fork {
    struct parting parting;
    struct branch reflected, refracted;
};

/*
 * Finds the next surface that parts the light of a branch, or a surface around the objects. What
 * lies between two equal media is no surface. The branch then ends there, with the weight that is
 * left; in clouds it may have been scattered before. Returns false if there is none.
 */
bool branch_advance(const struct tracing *tracing, struct branch *b, struct meeting *meeting);

/* Lets a branch go on behind a surface around the objects, with a share of its weight. */
void branch_pass(const struct tracing *tracing, struct branch *b, const struct bvh_hit *hit,
                 float passing);

/* Returns whether it has met as much as any branch may: with reference.roulette more than
 * reference.bounces. */
bool branch_is_spent(const struct tracing *tracing, const struct branch *b);

/* Returns whether a branch is in an object itself, and not in a bubble. */
bool branch_is_in(const struct tracing *tracing, const struct branch *b, uint32_t object);

/* Returns whether a branch is in ice that scatters light. */
bool branch_is_in_cloud(const struct tracing *tracing, const struct branch *b);

/* Returns what a surface takes away of light that passes it: an object's, or nothing's. */
const struct frame_medium *branch_surface(const struct tracing *tracing,
                                          const struct meeting *meeting);

struct fork branch_fork(const struct tracing *tracing, const struct branch *b,
                        const struct meeting *meeting);

/* Lets a branch that is too weak or too long for a tree go on as a path with reference.roulette: a
 * weak one by chance, with a greater weight. Returns false if chance ends it. */
bool branch_goes_on(const struct tracing *tracing, struct branch *b);

/* Returns which of both branches a path becomes by chance, with its whole weight. */
struct branch branch_choose(const struct tracing *tracing, const struct branch *b,
                            const struct fork *fork);

#endif
