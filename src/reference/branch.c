/* branch.c: advances a ray through media to its next surface, splits it, applies Russian roulette.
 */
#include "src/reference/branch.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/reference/microfacet.h"

enum {
    SCATTERINGS_MAX = 65536, /* volume scattering events per ray */
    SURFACES_MAX = 4096,     /* surfaces per path with Russian roulette */
    /* The seed of a ray is hashed with one of these constants for each independent random number.
     */
    PATH_SEED = 5,
    DIRECTION_SEED,
    CONTINUE_SEED,
    CHOICE_SEED,
    ROULETTE_SEED,
};

/* Planes of air below this opacity are not recorded in the layer `met`. */
#define OPACITY_MIN 0.05f

static vec3s absorbed(const struct tracer *tracing, const struct ray_branch *b, float length)
{
    const vec3s absorption =
        tracing_medium(tracing, media_top(tracing->media, &b->inside, MEDIA_NOTHING))->absorption;
    vec3s throughput = b->throughput;
    for (int k = 0; k < 3; k++)
        throughput.raw[k] *= absorption.raw[k] > 0.0f ? expf(-absorption.raw[k] * length) : 1.0f;
    return throughput;
}

/* Returns the media on both sides of an object's surface. A thin wall has no interior medium, so
 * both sides are the surrounding medium. */
static struct media_crossing crossing_at(const struct tracer *tracing,
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

static uint32_t inclusion_bit(const struct bvh_hit *hit)
{
    return hit->part == BVH_BUBBLES  ? REFERENCE_MET_BUBBLES
           : hit->part == BVH_CRACKS ? REFERENCE_MET_CRACKS
                                     : 0;
}

/* Returns the ray that continues from a surface: refracted if `is_through`, else reflected. */
static struct ray_branch continue_ray(const struct tracer *tracing, const struct ray_branch *b,
                                      const struct meeting *meeting, vec3s dir, bool is_through)
{
    const struct bvh_hit *hit = &meeting->hit;
    const bool is_entering = meeting->crossing.is_entering;
    struct ray_branch next = {
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
        .met = b->met | inclusion_bit(hit),
        .ignores_scattering = b->ignores_scattering,
        .is_gather_ray = b->is_gather_ray,
        .is_single_path = b->is_single_path,
    };
    if (hit->part != BVH_CRACKS && !tracing_medium(tracing, hit->object)->is_thin)
        media_set_put(&next.inside, hit->object, next.ray.is_inside);
    return next;
}

bool branch_is_in(const struct tracer *tracing, const struct ray_branch *b, uint32_t object)
{
    return media_top(tracing->media, &b->inside, MEDIA_NOTHING) == object;
}

/* Passes a sheet that does not split a ray: a composited plane of air, or a crack outside the ice.
 */
static void pass_sheet(const struct tracer *tracing, struct ray_branch *b,
                       const struct bvh_hit *hit)
{
    if (hit->part == BVH_AIR && branch_is_in(tracing, b, hit->object)) {
        const struct inclusions *inclusions = tracing->inclusions;
        const float opacity = inclusions_air_cover(inclusions, &hit->surface, b->ray.dir);
        const vec3s light = glms_vec3_mul(b->throughput, inclusions->air_light);
        b->air = glms_vec3_muladds(light, opacity, b->air);
        b->met |= opacity > OPACITY_MIN ? REFERENCE_MET_AIR : 0;
        b->throughput = glms_vec3_scale(b->throughput, 1.0f - opacity);
    }
    b->ray.origin = hit->surface.position;
    b->ray.near = 0.0f;
    b->ray.from = BVH_NOWHERE;
}

/* Returns the scattering medium that contains a ray's origin, or NULL. */
static const struct cloud *medium_around(const struct tracer *tracing, const struct ray_branch *b)
{
    for (uint32_t i = 0; i < tracing->cloud_count; i++) {
        if (branch_is_in(tracing, b, tracing->clouds[i].object))
            return &tracing->clouds[i];
    }
    return NULL;
}

bool branch_is_in_cloud(const struct tracer *tracing, const struct ray_branch *b)
{
    return medium_around(tracing, b) != NULL;
}

/* Returns the sunlight that a medium scatters at a point along -dir (single-scattering next-event
 * estimation). The shadow ray is straight: refraction at the ice's surface is ignored. */
static vec3s single_scattering(const struct tracer *tracing, const struct cloud *cloud, vec3s point,
                               vec3s dir)
{
    const struct globals *g = tracing->radiance->globals;
    if (!(glms_vec3_max(g->sun_light) > 0.0f))
        return glms_vec3_zero();
    const float transmittance = expf(-cloud_sun_depth(cloud, point, g->sun_dir));
    const float phase = 0.25f * cloud_phase(cloud, glms_vec3_dot(dir, g->sun_dir));
    return glms_vec3_scale(g->sun_light, transmittance * phase);
}

/* Samples a scattering event within the next `length` metres. Returns true if the ray scatters. */
static bool scatter(const struct tracer *tracing, struct ray_branch *b, float length)
{
    const struct cloud *cloud = medium_around(tracing, b);
    const struct cloud_way segment = { b->ray.origin, b->ray.dir, length };
    float distance;
    if (!cloud || !cloud_scatters(cloud, &segment, tracing->sample,
                                  microfacet_hash(b->seed, PATH_SEED), &distance))
        return false;
    b->met |= REFERENCE_MET_AIR;
    if (b->ignores_scattering)
        return false;
    const vec2s at = microfacet_point(tracing->sample, microfacet_hash(b->seed, DIRECTION_SEED));
    const vec3s point = glms_vec3_muladds(b->ray.dir, distance, b->ray.origin);
    b->throughput = absorbed(tracing, b, distance);
    b->air = glms_vec3_muladd(b->throughput, single_scattering(tracing, cloud, point, b->ray.dir),
                              b->air);
    b->ray = (struct bvh_ray){
        .origin = point,
        .dir = cloud_turned(cloud, b->ray.dir, at),
        .from = BVH_NOWHERE,
    };
    b->seed = microfacet_hash(b->seed, CONTINUE_SEED);
    b->scatterings++;
    b->is_single_path = true;
    return true;
}

bool branch_is_spent(const struct tracer *tracing, const struct ray_branch *b)
{
    const uint32_t limit = tracing->params.roulette ? SURFACES_MAX : tracing->params.bounces;
    return b->bounces >= limit || b->scatterings >= SCATTERINGS_MAX;
}

bool branch_goes_on(const struct tracer *tracing, struct ray_branch *b)
{
    const float probability = glms_vec3_max(b->throughput) / tracing->params.cutoff;
    if (b->is_single_path)
        return true;
    b->is_single_path = probability < 1.0f || b->bounces >= tracing->params.bounces;
    if (probability >= 1.0f)
        return true;
    b->throughput = glms_vec3_scale(b->throughput, 1.0f / probability);
    return microfacet_point(tracing->sample, microfacet_hash(b->seed, ROULETTE_SEED)).x <
           probability;
}

const struct frame_medium *branch_surface(const struct tracer *tracing,
                                          const struct meeting *meeting)
{
    const bool is_crack = meeting->hit.part == BVH_CRACKS;
    return tracing_medium(tracing, is_crack ? tracing->media->bubble : meeting->hit.object);
}

/* Evaluates the surface material at an object's hit, with its textures. */
static void evaluate_material(const struct tracer *tracing, const struct ray_branch *b,
                              struct meeting *meeting)
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

bool branch_advance(const struct tracer *tracing, struct ray_branch *b, struct meeting *meeting)
{
    while (!branch_is_spent(tracing, b) && bvh_meet(tracing->bvh, &b->ray, &meeting->hit)) {
        const struct bvh_hit *hit = &meeting->hit;
        if (scatter(tracing, b, hit->distance))
            continue;
        b->throughput = absorbed(tracing, b, hit->distance);
        if (hit->part == BVH_SURROUNDINGS)
            return true;
        meeting->seed = b->seed;
        if (hit->part == BVH_CRACKS && branch_is_in(tracing, b, hit->object)) {
            evaluate_material(tracing, b, meeting);
            return true;
        }
        if (hit->part == BVH_CRACKS || hit->part == BVH_AIR) {
            pass_sheet(tracing, b, hit);
            continue;
        }
        meeting->crossing = crossing_at(tracing, &b->inside, b->ray.dir, hit);
        if (tracing_medium(tracing, hit->object)->is_thin ||
            !media_are_alike(tracing->media, meeting->crossing.before, meeting->crossing.after)) {
            evaluate_material(tracing, b, meeting);
            return true;
        }
        const struct ray_branch before = *b;
        *b = continue_ray(tracing, b, meeting, b->ray.dir, true);
        b->throughput = before.throughput;
        b->air = before.air;
    }
    return false;
}

struct fork branch_fork(const struct tracer *tracing, const struct ray_branch *b,
                        const struct meeting *meeting)
{
    const struct dress *surface = &meeting->dress;
    struct fork fork = { .split = parting_at(tracing, b->ray.dir, meeting) };
    const struct dielectric_split *p = &fork.split;
    fork.reflected = continue_ray(tracing, b, meeting, p->reflected, false);
    fork.reflected.throughput =
        glms_vec3_scale(glms_vec3_mul(b->throughput, p->colors), p->reflected_share);
    fork.refracted = continue_ray(tracing, b, meeting, p->refracted, true);
    fork.refracted.throughput =
        glms_vec3_scale(glms_vec3_mul(glms_vec3_mul(b->throughput, surface->tint),
                                      glms_vec3_sub(glms_vec3_one(), p->colors)),
                        p->refracted_share * (1.0f - surface->shine));
    return fork;
}

struct ray_branch branch_choose(const struct tracer *tracing, const struct ray_branch *b,
                                const struct fork *fork)
{
    const float probability = fork->split.fresnel;
    const float at = microfacet_point(tracing->sample, microfacet_hash(b->seed, CHOICE_SEED)).x;
    const bool is_reflected = at < probability;
    struct ray_branch chosen = is_reflected ? fork->reflected : fork->refracted;
    chosen.throughput = glms_vec3_scale(chosen.throughput,
                                        1.0f / (is_reflected ? probability : 1.0f - probability));
    return chosen;
}

void branch_pass(const struct tracer *tracing, struct ray_branch *b, const struct bvh_hit *hit,
                 float passing)
{
    b->ray = (struct bvh_ray){ .origin = hit->surface.position,
                               .dir = b->ray.dir,
                               .near = tracing->bvh->hair,
                               .from = BVH_NOWHERE };
    b->throughput = glms_vec3_scale(b->throughput, passing);
    b->air = glms_vec3_zero(); /* its caller has already accumulated it */
    b->bounces++;
}
