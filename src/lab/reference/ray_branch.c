/* ray_branch.c: ray propagation through media, branching at surfaces, Russian roulette. */
#include "src/lab/reference/ray_branch.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/microfacet.h"
#include "src/lab/reference/contact_hits.h"

enum {
    SCATTERINGS_MAX = 65536, /* volume scattering events per ray */
    SURFACES_MAX = 4096,     /* surfaces per path with Russian roulette */
    /* Constants that are hashed with a ray's seed, one per independent random number. */
    PATH_SEED = 5,
    DIRECTION_SEED,
    CONTINUE_SEED,
    CHOICE_SEED,
    ROULETTE_SEED,
};

/* Minimum opacity of planes of air that the layer `inclusions` records. */
#define OPACITY_MIN 0.05f

static vec3s absorbed(const struct tracer *tracing, const struct ray_branch *b, float length)
{
    const vec3s absorption =
        tracer_medium(tracing, nested_media_top(tracing->media, &b->inside, NESTED_MEDIA_NONE))
            ->absorption;
    vec3s throughput = b->throughput;
    for (int k = 0; k < 3; k++)
        throughput.raw[k] *= absorption.raw[k] > 0.0f ? expf(-absorption.raw[k] * length) : 1.0f;
    return throughput;
}

static uint32_t inclusion_bit(const struct embree_scene_hit *hit)
{
    return hit->kind == EMBREE_SCENE_BUBBLES  ? REFERENCE_INCLUSION_BUBBLES
           : hit->kind == EMBREE_SCENE_CRACKS ? REFERENCE_INCLUSION_CRACKS
                                              : 0;
}

/* Returns the continuing ray: refracted if `is_through`, else reflected. */
static struct ray_branch continue_ray(const struct ray_branch *b,
                                      const struct surface_hit *surface_hit, vec3s dir,
                                      bool is_through)
{
    const struct embree_scene_hit *hit = &surface_hit->hit;
    const bool is_entering = surface_hit->crossing.is_entering;
    struct ray_branch next = {
        .ray = {
            .origin = hit->surface.position,
            .dir = dir,
            .is_inside = is_through ? is_entering : !is_entering,
            .is_wrong_side = is_through == is_entering
                                 ? dielectric_split_dot(dir, hit->facet) >= 0.0
                                                   : dielectric_split_dot(dir, hit->facet) <= 0.0,
            .from = hit->triangle,
            .kind = hit->kind,
            .object = hit->object,
        },
        .inside = b->inside,
        .bounces = b->bounces + 1,
        .seed = microfacet_hash(b->seed, is_through),
        .scatterings = b->scatterings,
        .inclusion_bits = b->inclusion_bits | inclusion_bit(hit),
        .ignores_scattering = b->ignores_scattering,
        .is_gather_ray = b->is_gather_ray,
        .is_single_path = b->is_single_path,
        .shows_backdrop = b->shows_backdrop && is_through,
    };
    if (hit->kind != EMBREE_SCENE_CRACKS)
        nested_media_set_apply(&next.inside, &surface_hit->changes, is_through);
    return next;
}

bool ray_branch_is_in(const struct tracer *tracing, const struct ray_branch *b, uint32_t object)
{
    return nested_media_top(tracing->media, &b->inside, NESTED_MEDIA_NONE) == object;
}

/* Moves a ray past a crack outside the ice or past a plane of air. Adds the light of the plane. */
static void pass_sheet(const struct tracer *tracing, struct ray_branch *b,
                       const struct embree_scene_hit *hit)
{
    if (hit->kind == EMBREE_SCENE_AIR && ray_branch_is_in(tracing, b, hit->object)) {
        const struct inclusions *inclusions = tracing->inclusions;
        const float opacity = inclusions_air_cover(inclusions, &hit->surface, b->ray.dir);
        const vec3s light = glms_vec3_mul(b->throughput, inclusions->air_light);
        b->air = glms_vec3_muladds(light, opacity, b->air);
        b->inclusion_bits |= opacity > OPACITY_MIN ? REFERENCE_INCLUSION_AIR : 0;
        b->throughput = glms_vec3_scale(b->throughput, 1.0f - opacity);
    }
    b->ray.origin = hit->surface.position;
    b->ray.near = 0.0f;
    b->ray.from = EMBREE_SCENE_NO_ORIGIN;
}

/* Returns the scattering medium that contains a ray's origin, or NULL. */
static const struct volume_scattering *medium_around(const struct tracer *tracing,
                                                     const struct ray_branch *b)
{
    for (uint32_t i = 0; i < tracing->scattering_media_count; i++) {
        if (ray_branch_is_in(tracing, b, tracing->scattering_media[i].object))
            return &tracing->scattering_media[i];
    }
    return NULL;
}

bool ray_branch_is_in_scattering(const struct tracer *tracing, const struct ray_branch *b)
{
    return medium_around(tracing, b) != NULL;
}

/* Returns the single-scattered sunlight from a point in a medium, in direction -dir. The shadow ray
 * to the sun is not refracted at the surface. */
static vec3s single_scattering(const struct tracer *tracing,
                               const struct volume_scattering *volume_scattering, vec3s point,
                               vec3s dir)
{
    const struct globals *g = tracing->radiance->globals;
    if (!(glms_vec3_max(g->sun_light) > 0.0f))
        return glms_vec3_zero();
    const float transmittance =
        expf(-volume_scattering_sun_depth(volume_scattering, point, g->sun_dir));
    const float phase =
        0.25f * medium_phase(glms_vec3_dot(dir, g->sun_dir), volume_scattering->anisotropy);
    return glms_vec3_scale(g->sun_light, transmittance * phase);
}

/* Samples volume scattering within the next `length` metres. Returns true if the ray scatters. */
static bool scatter(const struct tracer *tracing, struct ray_branch *b, float length)
{
    const struct volume_scattering *volume_scattering = medium_around(tracing, b);
    const struct volume_scattering_segment segment = { b->ray.origin, b->ray.dir, length };
    float distance;
    if (!volume_scattering ||
        !volume_scattering_sample_distance(volume_scattering, &segment, tracing->sample,
                                           microfacet_hash(b->seed, PATH_SEED), &distance))
        return false;
    b->inclusion_bits |= REFERENCE_INCLUSION_AIR;
    if (b->ignores_scattering)
        return false;
    const vec2s at = microfacet_point(tracing->sample, microfacet_hash(b->seed, DIRECTION_SEED));
    const vec3s point = glms_vec3_muladds(b->ray.dir, distance, b->ray.origin);
    b->throughput = absorbed(tracing, b, distance);
    b->air = glms_vec3_muladd(
        b->throughput, single_scattering(tracing, volume_scattering, point, b->ray.dir), b->air);
    b->ray = (struct embree_scene_ray){
        .origin = point,
        .dir = volume_scattering_sample_direction(volume_scattering, b->ray.dir, at),
        .from = EMBREE_SCENE_NO_ORIGIN,
    };
    b->seed = microfacet_hash(b->seed, CONTINUE_SEED);
    b->scatterings++;
    b->is_single_path = true;
    b->shows_backdrop = false;
    return true;
}

bool ray_branch_is_exhausted(const struct tracer *tracing, const struct ray_branch *b)
{
    const uint32_t limit = tracing->params.roulette ? SURFACES_MAX : tracing->params.bounces;
    return b->bounces >= limit || b->scatterings >= SCATTERINGS_MAX;
}

float ray_branch_roulette(const struct tracer *tracing, struct ray_branch *b)
{
    const float probability = glms_vec3_max(b->throughput) / tracing->params.cutoff;
    b->is_single_path =
        b->is_single_path || probability < 1.0f || b->bounces >= tracing->params.bounces;
    if (probability >= 1.0f)
        return 1.0f;
    const float at = microfacet_point(tracing->sample, microfacet_hash(b->seed, ROULETTE_SEED)).x;
    const float weight = at < probability ? 1.0f / probability : 0.0f;
    b->throughput = glms_vec3_scale(b->throughput, weight);
    return weight;
}

const struct frame_medium *ray_branch_surface(const struct tracer *tracing,
                                              const struct surface_hit *surface_hit)
{
    const bool is_crack = surface_hit->hit.kind == EMBREE_SCENE_CRACKS;
    return tracer_medium(tracing, is_crack ? tracing->media->bubble : surface_hit->hit.object);
}

/* Evaluates the textured surface material at a hit on an object. */
static void evaluate_material(const struct tracer *tracing, const struct ray_branch *b,
                              struct surface_hit *surface_hit)
{
    const struct embree_scene_hit *hit = &surface_hit->hit;
    const struct frame_medium *surface = ray_branch_surface(tracing, surface_hit);
    const struct model *model = &tracing->radiance->scene->model;
    surface_hit->material =
        (struct object_material){ surface->tint, surface->roughness, surface->opacity };
    surface_hit->normal = hit->surface.normal;
    surface_hit->is_bent = false;
    if (hit->kind != EMBREE_SCENE_OBJECT || !surface->is_textured)
        return;
    const struct material *material = &model->materials[model->objects[hit->object].material];
    const uint32_t own = hit->surface.material >> MESH_SURFACE_SHIFT;
    if (material->flags & MATERIAL_IS_PARTIAL && own) {
        material = &model->materials[own - 1];
        surface_hit->material = (struct object_material){ material->base_color, material->roughness,
                                                          1.0f - material->transmission };
    }
    const struct radiance_point point = {
        .vertex = &hit->surface,
        .extra = &hit->extra,
        .dp_du = hit->dp_du,
        .dp_dv = hit->dp_dv,
        .dir = b->ray.dir,
    };
    surface_hit->material = radiance_material_at(tracing->radiance, material, &point,
                                                 surface_hit->material, &surface_hit->normal);
    surface_hit->is_bent = material->textures[MATERIAL_NORMAL].layer > 0;
}

static bool intersect(const struct tracer *tracing, const struct ray_branch *b,
                      struct embree_scene_hit *hit)
{
    struct embree_scene_ray ray = b->ray;
    ray.inside = &b->inside;
    return embree_scene_intersect(tracing->embree_scene, &ray, hit);
}

bool ray_branch_advance(const struct tracer *tracing, struct ray_branch *b,
                        struct surface_hit *surface_hit)
{
    while (!ray_branch_is_exhausted(tracing, b) && intersect(tracing, b, &surface_hit->hit)) {
        const struct embree_scene_hit *hit = &surface_hit->hit;
        if (scatter(tracing, b, hit->distance))
            continue;
        b->throughput = absorbed(tracing, b, hit->distance);
        if (hit->kind == EMBREE_SCENE_SURROUNDINGS)
            return true;
        surface_hit->seed = b->seed;
        if (hit->kind == EMBREE_SCENE_CRACKS && ray_branch_is_in(tracing, b, hit->object)) {
            evaluate_material(tracing, b, surface_hit);
            return true;
        }
        if (hit->kind == EMBREE_SCENE_CRACKS || hit->kind == EMBREE_SCENE_AIR) {
            pass_sheet(tracing, b, hit);
            continue;
        }
        contact_hits_cross(tracing, &b->ray, &b->inside, surface_hit);
        if (tracer_medium(tracing, hit->object)->is_thin ||
            !nested_media_are_equal(tracing->media, surface_hit->crossing.before,
                                    surface_hit->crossing.after)) {
            evaluate_material(tracing, b, surface_hit);
            return true;
        }
        const struct ray_branch before = *b;
        *b = continue_ray(b, surface_hit, b->ray.dir, true);
        b->throughput = before.throughput;
        b->air = before.air;
    }
    return false;
}

struct fork ray_branch_split(const struct tracer *tracing, const struct ray_branch *b,
                             const struct surface_hit *surface_hit)
{
    const struct object_material *surface = &surface_hit->material;
    struct fork fork = { .split = dielectric_split_at(tracing, b->ray.dir, surface_hit) };
    const struct dielectric_split *p = &fork.split;
    fork.reflected = continue_ray(b, surface_hit, p->reflected, false);
    fork.reflected.throughput =
        glms_vec3_scale(glms_vec3_mul(b->throughput, p->colors), p->reflected_masking);
    fork.refracted = continue_ray(b, surface_hit, p->refracted, true);
    fork.refracted.throughput =
        glms_vec3_scale(glms_vec3_mul(glms_vec3_mul(b->throughput, surface->tint),
                                      glms_vec3_sub(glms_vec3_one(), p->colors)),
                        p->refracted_masking * (1.0f - surface->opacity));
    return fork;
}

struct ray_branch ray_branch_choose(const struct tracer *tracing, const struct ray_branch *b,
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

void ray_branch_pass(const struct tracer *tracing, struct ray_branch *b,
                     const struct embree_scene_hit *hit, float passing)
{
    b->ray = (struct embree_scene_ray){ .origin = hit->surface.position,
                                        .dir = b->ray.dir,
                                        .near = tracing->embree_scene->epsilon,
                                        .from = EMBREE_SCENE_NO_ORIGIN };
    b->throughput = glms_vec3_scale(b->throughput, passing);
    b->air = glms_vec3_zero(); /* already accumulated by the caller */
    b->bounces++;
}
