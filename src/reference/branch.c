/* branch.c: the way of a branch through media, sheets and surfaces. */
#include "src/reference/branch.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/reference/microfacet.h"

enum {
    SCATTERINGS_MAX = 65536, /* of a branch */
    SURFACES_MAX = 4096,     /* of a path */
    PATH_SEED = 5,           /* what seeds are hashed with for random numbers of their own */
    TURN_SEED,
    AFTER_SEED,
    CHOICE_SEED,
    ROULETTE_SEED,
};

/* Planes of air that cover less are not counted as met. */
#define COVER_MIN 0.05f

static vec3s absorbed(const struct tracing *tracing, const struct branch *b, float length)
{
    const vec3s absorption =
        tracing_medium(tracing, media_top(tracing->media, &b->inside, MEDIA_NOTHING))->absorption;
    vec3s weight = b->weight;
    for (int k = 0; k < 3; k++)
        weight.raw[k] *= absorption.raw[k] > 0.0f ? expf(-absorption.raw[k] * length) : 1.0f;
    return weight;
}

/* Returns the crossing of a ray that has met an object. A thin wall has no medium of its own. */
static struct media_crossing crossing_at(const struct tracing *tracing,
                                         const struct media_set *inside, vec3s dir,
                                         const struct bvh_hit *hit)
{
    struct media_crossing crossing =
        media_cross(tracing->media, inside, hit->object, parting_dot(hit->facet, dir) < 0.0);
    if (tracing_medium(tracing, hit->object)->is_thin) {
        crossing.before = media_top(tracing->media, inside, hit->object);
        crossing.after = crossing.before;
    }
    return crossing;
}

static uint32_t met_by(const struct bvh_hit *hit)
{
    return hit->part == BVH_BUBBLES  ? REFERENCE_MET_BUBBLES
           : hit->part == BVH_CRACKS ? REFERENCE_MET_CRACKS
                                     : 0;
}

/* Returns the branch that goes on at a surface, on the other side of it or on the same. */
static struct branch leave(const struct tracing *tracing, const struct branch *b,
                           const struct meeting *meeting, vec3s dir, bool is_through)
{
    const struct bvh_hit *hit = &meeting->hit;
    const bool is_entering = meeting->crossing.is_entering;
    struct branch next = {
        .ray = {
            .origin = hit->surface.position,
            .dir = dir,
            .is_inside = is_through ? is_entering : !is_entering,
            .is_astray = is_through == is_entering ? parting_dot(dir, hit->facet) >= 0.0
                                                   : parting_dot(dir, hit->facet) <= 0.0,
            .from = hit->triangle,
            .part = hit->part,
            .object = hit->object,
        },
        .inside = b->inside,
        .bounces = b->bounces + 1,
        .seed = microfacet_hash(b->seed, is_through),
        .scatterings = b->scatterings,
        .met = b->met | met_by(hit),
        .is_straight = b->is_straight,
        .is_gathered = b->is_gathered,
        .is_path = b->is_path,
    };
    if (hit->part != BVH_CRACKS && !tracing_medium(tracing, hit->object)->is_thin)
        media_set_put(&next.inside, hit->object, next.ray.is_inside);
    return next;
}

bool branch_is_in(const struct tracing *tracing, const struct branch *b, uint32_t object)
{
    return media_top(tracing->media, &b->inside, MEDIA_NOTHING) == object;
}

/* Lets a branch pass a sheet on which its light does not part: a plane of air, or a sheet that is
 * not in the ice. */
static void pass(const struct tracing *tracing, struct branch *b, const struct bvh_hit *hit)
{
    if (hit->part == BVH_AIR && branch_is_in(tracing, b, hit->object)) {
        const struct inclusions *inclusions = tracing->inclusions;
        const float cover = inclusions_air_cover(inclusions, &hit->surface, b->ray.dir);
        const vec3s light = glms_vec3_mul(b->weight, inclusions->air_light);
        b->air = glms_vec3_muladds(light, cover, b->air);
        b->met |= cover > COVER_MIN ? REFERENCE_MET_AIR : 0;
        b->weight = glms_vec3_scale(b->weight, 1.0f - cover);
    }
    b->ray.origin = hit->surface.position;
    b->ray.near = 0.0f;
    b->ray.from = BVH_NOWHERE;
}

/* Returns the cloud that a branch is in, or NULL. */
static const struct cloud *cloud_around(const struct tracing *tracing, const struct branch *b)
{
    for (uint32_t i = 0; i < tracing->cloud_count; i++) {
        if (branch_is_in(tracing, b, tracing->clouds[i].object))
            return &tracing->clouds[i];
    }
    return NULL;
}

bool branch_is_in_cloud(const struct tracing *tracing, const struct branch *b)
{
    return cloud_around(tracing, b) != NULL;
}

/* Returns the light of the sun that a cloud scatters at a point into a direction against it. The
 * sun's light has come straight, as if the ice's surface did not refract it. */
static vec3s sun_scattered(const struct tracing *tracing, const struct cloud *cloud, vec3s point,
                           vec3s dir)
{
    const struct globals *g = tracing->radiance->globals;
    if (!(glms_vec3_max(g->sun_light) > 0.0f))
        return glms_vec3_zero();
    const float passing = expf(-cloud_sun_depth(cloud, point, g->sun_dir));
    const float turned = 0.25f * cloud_phase(cloud, glms_vec3_dot(dir, g->sun_dir));
    return glms_vec3_scale(g->sun_light, passing * turned);
}

/* Lets clouds scatter a branch before it has gone so far. Returns whether they do. */
static bool scatter(const struct tracing *tracing, struct branch *b, float length)
{
    const struct cloud *cloud = cloud_around(tracing, b);
    const struct cloud_way way = { b->ray.origin, b->ray.dir, length };
    float distance;
    if (!cloud || !cloud_scatters(cloud, &way, tracing->sample, microfacet_hash(b->seed, PATH_SEED),
                                  &distance))
        return false;
    b->met |= REFERENCE_MET_AIR;
    if (b->is_straight)
        return false;
    const vec2s at = microfacet_point(tracing->sample, microfacet_hash(b->seed, TURN_SEED));
    const vec3s point = glms_vec3_muladds(b->ray.dir, distance, b->ray.origin);
    b->weight = absorbed(tracing, b, distance);
    b->air = glms_vec3_muladd(b->weight, sun_scattered(tracing, cloud, point, b->ray.dir), b->air);
    b->ray = (struct bvh_ray){
        .origin = point,
        .dir = cloud_turned(cloud, b->ray.dir, at),
        .from = BVH_NOWHERE,
    };
    b->seed = microfacet_hash(b->seed, AFTER_SEED);
    b->scatterings++;
    b->is_path = true;
    return true;
}

bool branch_is_spent(const struct tracing *tracing, const struct branch *b)
{
    const uint32_t most = tracing->params.roulette ? SURFACES_MAX : tracing->params.bounces;
    return b->bounces >= most || b->scatterings >= SCATTERINGS_MAX;
}

bool branch_goes_on(const struct tracing *tracing, struct branch *b)
{
    const float share = glms_vec3_max(b->weight) / tracing->params.cutoff;
    if (b->is_path)
        return true;
    b->is_path = share < 1.0f || b->bounces >= tracing->params.bounces;
    if (share >= 1.0f)
        return true;
    b->weight = glms_vec3_scale(b->weight, 1.0f / share);
    return microfacet_point(tracing->sample, microfacet_hash(b->seed, ROULETTE_SEED)).x < share;
}

const struct frame_medium *branch_surface(const struct tracing *tracing,
                                          const struct meeting *meeting)
{
    const bool is_gap = meeting->hit.part == BVH_CRACKS;
    return tracing_medium(tracing, is_gap ? tracing->media->bubble : meeting->hit.object);
}

/* Finds what the surface is at a point that light has met. */
static void dress(const struct tracing *tracing, const struct branch *b, struct meeting *meeting)
{
    const struct bvh_hit *hit = &meeting->hit;
    const struct frame_medium *surface = branch_surface(tracing, meeting);
    const struct model *model = &tracing->radiance->scene->model;
    meeting->dress = (struct dress){ surface->tint, surface->roughness, surface->shine };
    meeting->normal = hit->surface.normal;
    meeting->is_bent = false;
    if (hit->part != BVH_OBJECT || !surface->is_dressed)
        return;
    const struct material *material = &model->materials[model->objects[hit->object].material];
    const struct radiance_point point = {
        .vertex = &hit->surface,
        .extra = &hit->extra,
        .along_u = hit->along_u,
        .along_v = hit->along_v,
        .dir = b->ray.dir,
    };
    meeting->dress =
        radiance_dress(tracing->radiance, material, &point, meeting->dress, &meeting->normal);
    meeting->is_bent = material->textures[MATERIAL_NORMAL].layer > 0;
}

bool branch_advance(const struct tracing *tracing, struct branch *b, struct meeting *meeting)
{
    while (!branch_is_spent(tracing, b) && bvh_meet(tracing->bvh, &b->ray, &meeting->hit)) {
        const struct bvh_hit *hit = &meeting->hit;
        if (scatter(tracing, b, hit->distance))
            continue;
        b->weight = absorbed(tracing, b, hit->distance);
        if (hit->part == BVH_SURROUNDINGS)
            return true;
        meeting->seed = b->seed;
        if (hit->part == BVH_CRACKS && branch_is_in(tracing, b, hit->object)) {
            dress(tracing, b, meeting);
            return true;
        }
        if (hit->part == BVH_CRACKS || hit->part == BVH_AIR) {
            pass(tracing, b, hit);
            continue;
        }
        meeting->crossing = crossing_at(tracing, &b->inside, b->ray.dir, hit);
        if (tracing_medium(tracing, hit->object)->is_thin ||
            !media_are_alike(tracing->media, meeting->crossing.before, meeting->crossing.after)) {
            dress(tracing, b, meeting);
            return true;
        }
        const struct branch before = *b;
        *b = leave(tracing, b, meeting, b->ray.dir, true);
        b->weight = before.weight;
        b->air = before.air;
    }
    return false;
}

struct fork branch_fork(const struct tracing *tracing, const struct branch *b,
                        const struct meeting *meeting)
{
    const struct dress *surface = &meeting->dress;
    struct fork fork = { .parting = parting_at(tracing, b->ray.dir, meeting) };
    const struct parting *p = &fork.parting;
    fork.reflected = leave(tracing, b, meeting, p->reflected, false);
    fork.reflected.weight =
        glms_vec3_scale(glms_vec3_mul(b->weight, p->colors), p->reflected_share);
    fork.refracted = leave(tracing, b, meeting, p->refracted, true);
    fork.refracted.weight =
        glms_vec3_scale(glms_vec3_mul(glms_vec3_mul(b->weight, surface->tint),
                                      glms_vec3_sub(glms_vec3_one(), p->colors)),
                        p->refracted_share * (1.0f - surface->shine));
    return fork;
}

struct branch branch_choose(const struct tracing *tracing, const struct branch *b,
                            const struct fork *fork)
{
    const float share = fork->parting.fresnel;
    const float at = microfacet_point(tracing->sample, microfacet_hash(b->seed, CHOICE_SEED)).x;
    const bool is_reflected = at < share;
    struct branch chosen = is_reflected ? fork->reflected : fork->refracted;
    chosen.weight = glms_vec3_scale(chosen.weight, 1.0f / (is_reflected ? share : 1.0f - share));
    return chosen;
}

void branch_pass(const struct tracing *tracing, struct branch *b, const struct bvh_hit *hit,
                 float passing)
{
    b->ray = (struct bvh_ray){ .origin = hit->surface.position,
                               .dir = b->ray.dir,
                               .near = tracing->bvh->hair,
                               .from = BVH_NOWHERE };
    b->weight = glms_vec3_scale(b->weight, passing);
    b->air = glms_vec3_zero(); /* has been counted */
    b->bounces++;
}
